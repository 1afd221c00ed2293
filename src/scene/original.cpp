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

Similarity resting_placement(const Scene& scene, size_t layer) {
  return placement_of(scene, layer, [](size_t) { return Similarity{}; });
}

bool moves_as_whole(const Deformation& deformation, const Box& picture, const Mesh& mesh,
                    std::span<const Complex> positions) {
  if (!deformation.has_cage() || !is_box(deformation.rest, picture) ||
      positions.size() != mesh.vertices.size())
    return false;
  const Similarity similarity = similarity_between(mesh.vertices, positions);
  const double near = kExact * std::abs(similarity.factor) * picture.diagonal();
  for (size_t v = 0; v < positions.size(); ++v)
    if (std::abs(similarity(mesh.vertices[v]) - positions[v]) > near) return false;
  return true;
}

}  // namespace holomorph
