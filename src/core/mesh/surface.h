// A surface in space, and a test of whether it is a disk.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>

#include "core/types.h"

namespace holomorph {

/// A triangle mesh in space. All triangles must have the same orientation. Value type.
struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// The boundary as one closed loop of vertex indices, in the direction of the triangles. If the
/// surface is not a disk, throws an Error with the reason: the surface is closed, has several
/// parts, has holes or handles, has an edge with more than two triangles, or mixes triangles of
/// both orientations. Cost: O(n log n).
std::vector<int> disk_boundary(const Surface& surface);

/// The loops of the boundary of triangles over the vertices 0 to count - 1, in the direction of the
/// triangles. Throws the same errors, except that holes are allowed, and that there must be this
/// number of parts. Error messages call the triangles `what`.
std::vector<std::vector<int>> boundary_loops(int count,
                                             std::span<const std::array<int, 3>> triangles,
                                             const std::string& what, int parts = 1);

}  // namespace holomorph
