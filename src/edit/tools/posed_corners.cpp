// The boundary of the mesh subdivides the cage, so the image of a segment consists of consecutive
// boundary vertices.
#include "edit/tools/posed_corners.h"

#include <algorithm>

namespace holomorph {
namespace {

constexpr double kRing = 2.8, kArm = 4.6;  ///< in multiples of the picking distance

bool has_images(const Workspace& w) {
  return w.map().has_map() && static_cast<Index>(w.map().prepared()->mesh->cage_vertices.size()) ==
                                  w.shown.deformation().rest.size();
}

}  // namespace

Complex posed_vertex(const Workspace& workspace, Index vertex) {
  if (!has_images(workspace)) return workspace.shown.deformation().pose.vertex(vertex);
  return workspace.map()
      .map()
      .f[workspace.map().prepared()->mesh->cage_vertices[static_cast<size_t>(vertex)]];
}

Points posed_segment(const Workspace& workspace, Index segment) {
  const Cage& pose = workspace.shown.deformation().pose;
  if (!has_images(workspace)) {
    Points line;
    const Points controls = pose.controls(segment);
    for (int k = 0; k <= 24; ++k) line.push_back(bezier_point(controls, k / 24.0));
    return line;
  }
  const Mesh& mesh = *workspace.map().prepared()->mesh;
  const size_t n = mesh.boundary.size();
  const auto boundary_index = [&](Index vertex) {
    const int node = mesh.cage_vertices[static_cast<size_t>(vertex)];
    return static_cast<size_t>(std::ranges::find(mesh.boundary, node) - mesh.boundary.begin());
  };
  const size_t from = boundary_index(segment), to = boundary_index((segment + 1) % pose.size());
  // The boundary is always counter-clockwise, but the cage has the orientation in which it was
  // drawn.
  const size_t step = signed_area(outline_of(workspace.shown.deformation().rest)) > 0 ? 1 : n - 1;
  Points line{workspace.map().map().f[mesh.boundary[from]]};
  for (size_t at = from; at != to;) {
    at = (at + step) % n;
    line.push_back(workspace.map().map().f[mesh.boundary[at]]);
  }
  return line;
}

CornerMark corner_mark(const Workspace& workspace, Index vertex) {
  const Viewport& viewport = workspace.display.viewport;
  CornerMark mark{vertex, viewport.px_at_plane(posed_vertex(workspace, vertex))};
  mark.radius = kRing * workspace.display.handle_px;
  const double arm = kArm * workspace.display.handle_px;
  const auto end = [&](Points line) {
    Complex last = mark.center;
    for (const Complex& z : line) {
      last = viewport.px_at_plane(z);
      if (std::abs(last - mark.center) >= arm) break;
    }
    const Complex direction = last - mark.center;
    return mark.center +
           (std::abs(direction) > 0 ? arm * direction / std::abs(direction) : Complex(arm));
  };
  const Index n = workspace.shown.deformation().pose.size();
  Points before = posed_segment(workspace, (vertex + n - 1) % n);
  std::ranges::reverse(before);
  mark.before = end(std::move(before));
  mark.after = end(posed_segment(workspace, vertex));
  return mark;
}

CornerMark::Region region_at(const CornerMark& mark, Complex px, double handle_px) {
  const double before = std::abs(px - mark.before), after = std::abs(px - mark.after);
  if (std::min(before, after) <= handle_px)
    return before < after ? CornerMark::Region::before : CornerMark::Region::after;
  if (std::abs(std::abs(px - mark.center) - mark.radius) <= 0.6 * handle_px)
    return CornerMark::Region::ring;
  return CornerMark::Region::none;
}

std::optional<Index> posed_vertex_at(const Workspace& workspace, Complex px) {
  std::optional<Index> best;
  double distance = workspace.display.handle_px;
  for (Index v = 0; v < workspace.shown.deformation().pose.size(); ++v) {
    const double here =
        std::abs(workspace.display.viewport.px_at_plane(posed_vertex(workspace, v)) - px);
    if (here >= distance) continue;
    best = v;
    distance = here;
  }
  return best;
}

std::optional<Index> posed_segment_at(const Workspace& workspace, Complex px) {
  std::optional<Index> best;
  double distance = 0.8 * workspace.display.handle_px / workspace.display.viewport.zoom;
  const Complex z = workspace.display.viewport.plane_at_px(px);
  for (Index s = 0; s < workspace.shown.deformation().pose.size(); ++s) {
    const Points line = posed_segment(workspace, s);
    for (size_t i = 0; i + 1 < line.size(); ++i) {
      const double here = nearest_on_segment(line[i], line[i + 1], z).distance;
      if (here >= distance) continue;
      best = s;
      distance = here;
    }
  }
  return best;
}

}  // namespace holomorph
