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

Similarity placing_motion(const Deformation& deformation, const Box& picture, const Mesh& mesh,
                          std::span<const Complex> positions) {
  if (!deformation.has_cage() || !is_box(deformation.rest, picture) ||
      positions.size() != mesh.vertices.size())
    return {};
  return similarity_between(mesh.vertices, positions);
}

Similarity original_placement(const Scene& scene, size_t layer, size_t lowest,
                              const std::function<Similarity(size_t layer)>& motion) {
  const auto moved = [&](size_t i) { return i == lowest ? Similarity{} : motion(i); };
  const Similarity placement = placement_of(
      scene, layer, [&](size_t child) { return moved(*parent_of(scene, *scene.layers[child])); });
  const Similarity own = moved(layer);
  return is_identity(own) ? placement : composed(placement, own);
}

}  // namespace holomorph
