// A picture counts as content if some of its corners are outside the cage and therefore stay at
// rest.
#include "edit/content.h"

#include "core/geometry/polyline.h"
#include "edit/edits/edits.h"

namespace holomorph {

std::optional<Cage> solved_cage(const Workspace& workspace) {
  const LiveMap& map = workspace.map();
  if (!map.has_map() || !map.posed()) return {};
  const std::optional<Deformation>& posed = map.timed() ? map.timed() : map.posed();
  if (map.timed() && key_at(*posed, workspace.shown.timeline.time) == posed->keyframes.size())
    return {};  // between keyframes, no single cage produces the map
  return map.prepared()->deformer->solved_cage(pose_of(*posed));
}

namespace {

/// The rectangle of a layer's picture if some of its corners are outside the cage, where they do
/// not move; else empty.
Box resting_box(const Cage& cage, const Image* image) {
  if (!image) return {};
  constexpr double kOnEdge = 1e-6;  // px
  const Polygon outline = outline_of(cage);
  Box box;
  bool stays = false;
  for (const Complex& corner : image->page().corners()) {
    box.include(corner);
    stays = stays || outline.points.empty() ||
            (!encloses(outline, corner) && nearest_on_polygon(outline, corner).distance > kOnEdge);
  }
  return stays ? box : Box{};
}

}  // namespace

Box content_box(const Workspace& workspace) {
  const Scene& scene = workspace.document.scene();
  const Deformation& deformation = workspace.shown.deformation();
  const bool at_rest = workspace.at_rest();
  Box box;
  // Each layer is measured in its own plane and added where it lies.
  Similarity placed;
  // Extreme maps take points anywhere. No view shows what is far beyond all handles.
  const auto include_point = [&](Complex z) {
    const Complex at = placed(z);
    if (std::abs(at.real()) <= kMaxCoordinate && std::abs(at.imag()) <= kMaxCoordinate)
      box.include(at);
  };
  const auto include = [&](const Box& part) {
    if (part.empty()) return;
    for (const double x : {part.left, part.right})
      for (const double y : {part.bottom, part.top}) include_point({x, y});
  };
  const auto include_map = [&](const LiveMap& map) {
    for (const Complex& z : map.map().f) include_point(z);
  };
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    if (i == scene.edited || !layer.visible || workspace.mode == EditMode::rest) continue;
    placed = at_rest ? Similarity{} : workspace.placement(i);
    include(resting_box(layer.deformation.rest, workspace.document.pictures().of(layer)));
    include_map(workspace.maps.of(layer.id));
  }
  placed = at_rest ? Similarity{} : workspace.placement(scene.edited);
  include(resting_box(at_rest ? Cage{} : scene.deformation().rest, workspace.document.image()));
  for (const Complex& z : outline_of(cage_of(deformation, workspace.mode))) include_point(z);
  if (!at_rest)
    for (const Complex& z : deformation.outline) include_point(z);
  if (method_named(deformation.method).uses_strokes)
    for (size_t i = 0; i < deformation.strokes.size(); ++i)
      for (const Complex& z : curve_of(deformation, static_cast<Index>(i), workspace.mode))
        include_point(z);
  if (!at_rest && workspace.map().has_map()) include_map(workspace.map());
  return box;
}

}  // namespace holomorph
