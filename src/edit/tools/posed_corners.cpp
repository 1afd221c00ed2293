// The boundary of the mesh subdivides the cage, so the image of a segment consists of consecutive
// boundary vertices.
#include "edit/tools/posed_corners.h"

#include <algorithm>

#include "core/geometry/orientation.h"

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
  const Loops loops = mesh.boundary_loops();
  const auto boundary_index = [&](Index vertex) -> Index {
    const int node = mesh.cage_vertices[static_cast<size_t>(vertex)];
    return std::ranges::find(mesh.boundary, node) - mesh.boundary.begin();
  };
  const Index from = boundary_index(segment), to = boundary_index(pose.next(segment));
  // The boundary always has the inside on its left, but the cage has the orientation in which it
  // was drawn.
  const bool forward = Orientation(workspace.shown.deformation().rest).is_oriented();
  const auto image = [&](Index at) {
    return workspace.map().map().f[mesh.boundary[static_cast<size_t>(at)]];
  };
  Points line{image(from)};
  for (Index at = from; at != to;) {
    at = forward ? loops.next(at) : loops.before(at);
    line.push_back(image(at));
  }
  return line;
}

CornerMark corner_mark(const Workspace& workspace, Index vertex) {
  const Viewport viewport = workspace.layer_view();
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
  Points before = posed_segment(workspace, workspace.shown.deformation().pose.before(vertex));
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
        std::abs(workspace.layer_view().px_at_plane(posed_vertex(workspace, v)) - px);
    if (here >= distance) continue;
    best = v;
    distance = here;
  }
  return best;
}

std::optional<Index> posed_segment_at(const Workspace& workspace, Complex px) {
  std::optional<Index> best;
  double distance = 0.8 * workspace.display.handle_px / workspace.layer_view().zoom;
  const Complex z = workspace.layer_view().plane_at_px(px);
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
