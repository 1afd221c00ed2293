// The map is that of full precision, not that of the picture's mesh.
#include "raster/layer_drawing.h"

#include "core/maps/continued_map.h"
#include "scene/formats/bent_drawing.h"
#include "scene/formats/svg_document.h"
#include "scene/fringe.h"
#include "scene/keyframes.h"
#include "scene/timed_map.h"
#include "system/text.h"

namespace holomorph {
namespace {

std::string group_of(const SourceDrawing& drawing, const PointValues& map,
                     const DrawingPlace& place, std::vector<std::string>& losses) {
  BendingOptions options;
  options.upper_left = Complex(0, place.height);
  options.prefix = place.prefix;
  BentDrawing bent = bent_drawing(drawing.text, drawing.name, map, options);
  losses.insert(losses.end(), bent.losses.begin(), bent.losses.end());
  return bent.group;
}

/// Path data of closed loops in the layer's plane.
std::string path_of(const Points& points, const Loops& loops, const DrawingPlace& place) {
  std::string path;
  for (Index loop = 0; loop < loops.count(); ++loop) {
    for (Index i = loops.first(loop); i < loops.end(loop); ++i) {
      const Complex at = place.to_canvas(points[static_cast<size_t>(i)]);
      path += i == loops.first(loop) ? 'M' : 'L';
      path += decimal(at.real(), 3) + " " + decimal(place.height - at.imag(), 3);
    }
    path += 'Z';
  }
  return path;
}

/// The boundary of a mesh, moved inwards a little, so that what is drawn outside of it overlaps
/// with what is drawn inside.
Points narrowed_boundary(const Mesh& mesh, double by) {
  const Loops loops = mesh.boundary_loops();
  Points points;
  const auto at = [&](Index i) {
    return mesh.vertices[static_cast<size_t>(mesh.boundary[static_cast<size_t>(i)])];
  };
  for (Index i = 0; i < static_cast<Index>(mesh.boundary.size()); ++i) {
    const Complex along = at(loops.next(i)) - at(loops.before(i));
    points.push_back(at(i) + by * kI * along / std::abs(along));
  }
  return points;
}

std::string clipped(const std::string& group, const std::string& id, const std::string& rule,
                    const std::string& path) {
  return "<clipPath id=\"" + id + "\"><path clip-rule=\"" + rule + "\" d=\"" + path +
         "\"/></clipPath><g clip-path=\"url(#" + id + ")\">" + group + "</g>";
}

}  // namespace

double pixel_size_of(const SourceDrawing& drawing) {
  const SvgDocument document = svg_document_of(drawing.text, drawing.name);
  return document.width / document.columns;
}

std::string placed_drawing(const SourceDrawing& drawing, const DrawingPlace& place,
                           std::vector<std::string>& losses) {
  const auto map = [&](std::span<const Complex> points) {
    std::vector<PointMap::Value> values;
    for (const Complex& z : points)
      values.push_back({place.to_canvas(z), place.to_canvas.factor, 0});
    return values;
  };
  return group_of(drawing, map, place, losses);
}

std::string layer_drawing(const SourceDrawing& drawing, const Deformation& deformation,
                          bool linear_blend, const std::optional<double>& time,
                          const DrawingPlace& place, std::vector<std::string>& losses,
                          const std::function<void()>& keep_going) {
  if (!deformation.has_cage()) return placed_drawing(drawing, place, losses);
  TimedMap timed(deformation, linear_blend);
  const bool plays = time && !playing_keys(deformation).empty();
  const TimedFrame frame = timed.frame(plays ? time : std::nullopt);
  const std::shared_ptr<const Mesh>& mesh = timed.prepared().mesh;
  const VectorXc f = timed.on_mesh(frame).f;
  std::unique_ptr<PointMap> inside = timed.point_map(frame);
  if (!inside) inside = std::make_unique<MeshPointMap>(mesh, f);
  const ContinuedMap continued(mesh, f, *inside);
  const auto map = [&](std::span<const Complex> points) {
    std::vector<PointMap::Value> values = values_on_all_cores(continued, points, keep_going);
    const Complex factor = place.to_canvas.factor;
    for (PointMap::Value& value : values)
      value = {place.to_canvas(value.f), factor * value.fz, factor * value.fzbar};
    return values;
  };
  const std::string group = group_of(drawing, map, place, losses);
  if (!has_solid_surroundings(*mesh, drawing.image)) return group;
  constexpr double kOverlap = 0.75, kFar = 1e5;  // in pixels of the canvas
  const Loops loops = mesh->boundary_loops();
  Points posed;
  for (const int v : mesh->boundary) posed.push_back(f[v]);
  DrawingPlace rest = place;
  rest.prefix = "rest-" + place.prefix;
  std::vector<std::string> same_losses;
  const std::string everywhere = "M-" + decimal(kFar, 0) + " -" + decimal(kFar, 0) + "h" +
                                 decimal(2 * kFar, 0) + "v" + decimal(2 * kFar, 0) + "h-" +
                                 decimal(2 * kFar, 0) + "Z";
  const Points hole = narrowed_boundary(*mesh, kOverlap / std::abs(place.to_canvas.factor));
  return "<g>" +
         clipped(placed_drawing(drawing, rest, same_losses), "outside-" + place.prefix, "evenodd",
                 everywhere + path_of(hole, loops, place)) +
         clipped(group, "cage-" + place.prefix, "nonzero", path_of(posed, loops, place)) + "</g>";
}

}  // namespace holomorph
