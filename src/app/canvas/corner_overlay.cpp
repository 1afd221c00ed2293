// Corners are drawn as squares, other vertices of the cage as small dots.
#include "app/canvas/corner_overlay.h"

#include "edit/edits/corner_edits.h"

namespace holomorph {
namespace {

void draw_line(MarkList& list, const std::vector<ImVec2>& line, ImU32 color, float width,
               const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  list.polyline(line, false, style.colors.outline, (width + 1.8f) * s);
  list.polyline(line, false, color, width * s);
}

void draw_mark(MarkList& list, const CornerMark& mark, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale), radius = static_cast<float>(mark.radius);
  const auto color = [&](CornerMark::Region part) {
    return mark.hovered == part ? style.colors.hover : style.colors.pin;
  };
  for (const auto part : {CornerMark::Region::before, CornerMark::Region::after}) {
    const ImVec2 end = vec(part == CornerMark::Region::before ? mark.before : mark.after);
    draw_line(list, {vec(mark.center), end}, color(part), 2.2f, style);
    list.fill_circle(end, 6.5f * s, style.colors.outline);
    list.fill_circle(end, 5 * s, color(part));
  }
  const bool on_ring = mark.hovered == CornerMark::Region::ring;
  list.circle(vec(mark.center), radius, style.colors.outline, 4.5f * s);
  list.circle(vec(mark.center), radius, color(CornerMark::Region::ring),
              (on_ring ? 3.2f : 2.2f) * s);
}

}  // namespace

void draw_corners(MarkList& list, const Workspace& workspace, const ToolOverlay& gesture,
                  const OverlayStyle& style) {
  const Deformation& deformation = workspace.shown.deformation();
  const float s = static_cast<float>(style.scale);
  for (Index e = 0; e < deformation.rest.size(); ++e) {
    std::vector<ImVec2> line;
    for (const Complex& z : posed_segment(workspace, e))
      line.push_back(vec(workspace.layer_view().px_at_plane(z)));
    const bool hovered =
        gesture.edge && corner_before(deformation, *gesture.edge) == corner_before(deformation, e);
    draw_line(list, line, hovered ? style.colors.hover : style.colors.pose, hovered ? 3 : 1.8f,
              style);
  }
  if (gesture.corner) draw_mark(list, *gesture.corner, style);
  for (Index v = 0; v < deformation.rest.size(); ++v) {
    const ImVec2 at = vec(workspace.layer_view().px_at_plane(posed_vertex(workspace, v)));
    const bool hovered = gesture.hover == Handle{Handle::Kind::cage, v, 0},
               chosen = workspace.selection.contains({Handle::Kind::cage, v, 0});
    const ImU32 color = chosen    ? style.colors.selected
                        : hovered ? style.colors.hover
                                  : style.colors.pose;
    const float r = (hovered ? 6.5f : 5) * s;
    if (is_corner(deformation, v)) {
      list.fill_rect({at.x - r, at.y - r}, {at.x + r, at.y + r}, style.colors.outline, 2 * s);
      list.fill_rect({at.x - r + 1.5f * s, at.y - r + 1.5f * s},
                     {at.x + r - 1.5f * s, at.y + r - 1.5f * s}, color, 1.5f * s);
    } else {
      list.fill_circle(at, 0.8f * r, style.colors.outline);
      list.fill_circle(at, 0.8f * r - 1.5f * s, hovered ? color : style.colors.panel);
    }
  }
}

void draw_limited_corners(MarkList& list, const Workspace& workspace, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale), r = 11 * s;
  for (const Index v : workspace.map().map().limited_corners) {
    if (v >= workspace.shown.deformation().rest.size()) continue;
    const ImVec2 at = vec(workspace.layer_view().px_at_plane(posed_vertex(workspace, v)));
    const ImVec2 a(at.x, at.y - r), b(at.x - 0.9f * r, at.y + 0.6f * r),
        c(at.x + 0.9f * r, at.y + 0.6f * r);
    list.triangle(a, b, c, style.colors.outline, 4.5f * s);
    list.triangle(a, b, c, style.colors.warning, 2.2f * s);
  }
}

}  // namespace holomorph
