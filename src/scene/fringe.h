// The faint surroundings of a cut-out: shadows, glows and soft edges outside its cage.
#pragma once

#include <functional>
#include <memory>

#include "core/mesh/mesh.h"
#include "scene/formats/image.h"

namespace holomorph {

/// A mesh around a cut-out. Its vertices follow the nearest edge of the cage's boundary.
struct Fringe {
  /// A vertex a + t (b - a), where a and b are vertices of the cut-out's mesh.
  struct Follower {
    int a = 0, b = 0;
    Complex t = 0;
  };

  Mesh mesh;  ///< without a boundary
  std::vector<Follower> followers;

  /// The positions of the vertices when those of the cut-out's mesh are at `f`.
  Points positions(std::span<const Complex> f) const;
};

/// Whether solid parts of a picture lie outside the cage with this mesh: pixels with at least half
/// the opacity of the most opaque one, unless the cage is only imprecise there. What is outside
/// then stays where it is.
bool has_solid_surroundings(const Mesh& mesh, const Image& picture);

/// The fringe of a picture around the mesh of its cage. Null if it has solid
/// surroundings, or if there is nothing outside. Cost: about 1 ns per
/// pixel; with a fringe, that of a mesh. `keep_going` is called from time to time; if it returns
/// false, the result is null.
std::shared_ptr<const Fringe> fringe_of(
    const Mesh& mesh, const Image& picture,
    const std::function<bool()>& keep_going = [] { return true; });

}  // namespace holomorph
