// Placing a picture gives it a box as its cage, so that a box that only moves is a placement.
#include "scene/original.h"

#include <algorithm>

#include "core/geometry/polygon.h"
#include "core/geometry/similarity.h"
#include "core/mesh/mesh.h"
#include "scene/attachments.h"

namespace holomorph {
namespace {

constexpr double kExact = 1e-5;  // of the size; maps may be in single precision

/// Whether the rest of a cage is a box.
bool is_box(const Cage& cage, const Box& box) {
  const Polygon outline = outline_of(cage);
  const double size = box.diagonal();
  const auto is_near = [&](double a, double b) { return std::abs(a - b) <= kExact * size; };
  const Box around = box_of(outline.points);
  return PolygonView(outline).loops().count() == 1 && is_near(around.left, box.left) &&
         is_near(around.right, box.right) && is_near(around.bottom, box.bottom) &&
         is_near(around.top, box.top) &&
         std::abs(std::abs(signed_area(outline)) - box.width() * box.height()) <=
             kExact * size * size;
}

}  // namespace

std::optional<Similarity> placing_motion(const Deformation& deformation, const Box& picture,
                                         const Mesh& mesh, std::span<const Complex> positions) {
  if (!deformation.has_cage() || !is_box(deformation.rest, picture) ||
      positions.size() != mesh.vertices.size())
    return Similarity{};
  // Not all vertices: pins inside of a held frame do not move the picture.
  Points from, to;
  for (const int v : mesh.cage_vertices) {
    from.push_back(mesh.vertices[static_cast<size_t>(v)]);
    to.push_back(positions[static_cast<size_t>(v)]);
  }
  if (signed_area(from) * signed_area(to) < 0) return {};
  return similarity_between(from, to);
}

std::optional<Similarity> original_placement(const Scene& scene, size_t layer, size_t lowest,
                                             const PlacingMotion& motion) {
  bool is_mirrored = false;
  const auto moved = [&](size_t i) {
    const auto by = i == lowest ? Similarity{} : motion(i);
    is_mirrored |= !by;
    return by.value_or(Similarity{});
  };
  const Similarity own = moved(layer), placement = placement_of(scene, layer, [&](size_t child) {
                                         return moved(*parent_of(scene, *scene.layers[child]));
                                       });
  if (is_mirrored) return {};
  return is_identity(own) ? placement : composed(placement, own);
}

}  // namespace holomorph
