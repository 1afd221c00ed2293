// A surface in space, and the test whether it is a disk.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>

#include "core/types.h"

namespace holomorph {

/// Triangles over vertices in space, all of the same orientation. Value type.
struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// The boundary as one closed loop of vertex indices, in the direction of the triangles. Throws
/// Error that says why if the surface is not a disk: closed, in several parts, with holes or
/// handles, with edges of more than two triangles, or with triangles of both orientations. Cost:
/// O(n log n).
std::vector<int> disk_boundary(const Surface& surface);

/// The same for triangles over the vertices 0 to count - 1; error messages call them `what`.
std::vector<int> disk_boundary(int count, std::span<const std::array<int, 3>> triangles,
                               const std::string& what);

}  // namespace holomorph
