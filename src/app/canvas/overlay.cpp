// Decides what the overlay shows and in which order. marks.h draws the individual marks.
#include "app/canvas/overlay.h"

#include <algorithm>
#include <cmath>

#include "app/canvas/canvas.h"
#include "app/canvas/corner_overlay.h"
#include "app/canvas/marks.h"
#include "edit/content.h"
#include "edit/edits/curve_edits.h"
#include "edit/frame.h"

namespace holomorph {

ImVec2 px(const Workspace& workspace, Complex z) {
  return vec(workspace.layer_view().px_at_plane(z));
}

namespace {

/// The points of a line in window px.
std::vector<ImVec2> window_line(const Workspace& workspace, std::span<const Complex> points) {
  const Viewport view = workspace.layer_view();
  std::vector<ImVec2> line;
  for (const Complex& z : points) line.push_back(vec(view.px_at_plane(z)));
  return line;
}

/// Calls draw with each loop of a polygon, in window px.
template <class Draw>
void draw_loops(const Workspace& workspace, PolygonView polygon, Draw draw) {
  for (Index l = 0; l < polygon.loops().count(); ++l) draw(window_line(workspace, polygon.loop(l)));
}

void draw_cage(MarkList& list, const Workspace& workspace, const Cage& cage, ImU32 color,
               const OverlayStyle& style) {
  draw_loops(workspace, outline_of(cage, 24), [&](const std::vector<ImVec2>& line) {
    if (line.size() < 2) return;
    if (workspace.mode == EditMode::pose) return draw_line(list, line, true, color, style);
    const float width = static_cast<float>(style.scale);
    list.polyline(line, true, style.colors.outline, 3.5f * width);
    draw_dashes(list, line, line.size() > 2, color, style);
  });
}

/// Draws lines from each vertex to its tangent handles. For segments whose degree is not 3, draws
/// the whole control polygon.
void draw_tangents(MarkList& list, const Workspace& workspace, const Cage& cage, ImU32 color,
                   const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  for (Index e = 0; e < cage.size(); ++e) {
    const Points controls = cage.controls(e);
    for (size_t m = 0; controls.size() > 2 && m + 1 < controls.size(); ++m) {
      if (controls.size() == 4 && m == 1) continue;
      const ImVec2 a = px(workspace, controls[m]), b = px(workspace, controls[m + 1]);
      list.line(a, b, style.colors.outline, 2.4f * s);
      list.line(a, b, color, 1.1f * s);
    }
  }
}

void draw_gesture(MarkList& list, const Workspace& workspace, const ToolOverlay& gesture,
                  const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  if (!gesture.line.empty()) {
    std::vector<ImVec2> line = window_line(workspace, gesture.line);
    if (gesture.line_end)
      line.push_back(gesture.closes ? line[0] : px(workspace, *gesture.line_end));
    draw_line(list, line, false, style.colors.rest, style);
    for (size_t i = 0; i < gesture.line_points.size(); ++i)
      draw_cage_handle(list, px(workspace, gesture.line_points[i]), true, false,
                       i == 0 && gesture.closes, style.colors.rest, style);
  }
  if (gesture.insertion) {
    const ImVec2 at = px(workspace, *gesture.insertion);
    list.fill_circle(at, 7 * s, style.colors.outline);
    list.fill_circle(at, 5.5f * s, style.colors.hover);
    list.line({at.x - 3 * s, at.y}, {at.x + 3 * s, at.y}, IM_COL32_BLACK, 1.5f * s);
    list.line({at.x, at.y - 3 * s}, {at.x, at.y + 3 * s}, IM_COL32_BLACK, 1.5f * s);
  }
  for (const Guide& guide : gesture.guides) {
    const ImVec2 from = px(workspace, guide.from), to = px(workspace, guide.to);
    list.line(from, to, style.colors.outline, 2.6f * s);
    list.line(from, to, style.colors.hover, 1.2f * s);
    list.circle(from, 4 * s, style.colors.hover, 1.2f * s);
  }
  if (gesture.box) draw_box(list, *gesture.box, style);
  if (gesture.marquee) {
    const ImVec2 a(static_cast<float>(gesture.marquee->left),
                   static_cast<float>(gesture.marquee->bottom));
    const ImVec2 b(static_cast<float>(gesture.marquee->right),
                   static_cast<float>(gesture.marquee->top));
    list.fill_rect(a, b, (style.colors.accent & 0x00ffffff) | 0x30000000);
    list.rect(a, b, style.colors.accent, 0, 1.2f * s);
  }
  if (gesture.ring &&
      *gesture.ring < static_cast<Index>(workspace.shown.deformation().pins.size())) {
    const ImVec2 at = px(workspace, workspace.shown.deformation().pins[*gesture.ring].pose);
    const float radius = static_cast<float>(kRingRadius * workspace.display.handle_px);
    const Pin& pin = workspace.shown.deformation().pins[*gesture.ring];
    if (const auto held =
            held_radius(workspace.shown.deformation(), *gesture.ring, workspace.map().prepared()))
      draw_held_disk(list, at, static_cast<float>(*held * pin.scale * workspace.layer_view().zoom),
                     style);
    draw_ring(list, at, radius, pin, gesture.ring_hovered, style);
  }
}

/// Draws the edge of what pins may move: arcs around them.
void draw_held_region(MarkList& list, const Workspace& workspace, const OverlayStyle& style) {
  const Deformation& deformation = workspace.shown.deformation();
  if (!deformation.held_beyond || !can_choose_frame(workspace) ||
      workspace.tools.active != ToolId::pin)
    return;
  constexpr int kPoints = 96;
  const double radius = *deformation.held_beyond;
  for (const Pin& pin : deformation.pins) {
    std::vector<ImVec2> arc;
    const auto end_arc = [&] {
      if (arc.size() > 1) {
        list.polyline(arc, false, style.colors.outline, 3 * static_cast<float>(style.scale));
        draw_dashes(list, arc, false, style.colors.pin, style);
      }
      arc.clear();
    };
    for (int k = 0; k <= kPoints; ++k) {
      const Complex z = pin.rest + std::polar(radius, 2 * kPi * k / kPoints);
      const bool inside_another = std::ranges::any_of(deformation.pins, [&](const Pin& other) {
        return std::abs(other.rest - z) < 0.999 * radius;
      });
      if (inside_another)
        end_arc();
      else
        arc.push_back(px(workspace, z));
    }
    end_arc();
  }
}

/// Draws a stroke. Its start is a dot, its end an arrow.
void draw_stroke(MarkList& list, const Workspace& workspace, Handle handle, bool hovered,
                 const OverlayStyle& style) {
  const EditMode mode = workspace.mode;
  const Deformation& deformation = workspace.shown.deformation();
  const bool selected = workspace.selection.contains(handle);
  const ImU32 color = selected                 ? style.colors.selected
                      : hovered                ? style.colors.hover
                      : mode == EditMode::rest ? style.colors.rest
                                               : style.colors.stroke;
  const std::vector<ImVec2> line =
      window_line(workspace, curve_of(deformation, handle.index, mode));
  draw_line(list, line, false, color, style, 2.25f);
  const float s = static_cast<float>(style.scale);
  list.fill_circle(line.front(), 5.5f * s, style.colors.outline);
  list.fill_circle(line.front(), 4 * s, color);
  if (line.size() < 2) return;
  const ImVec2 end = line.back();
  ImVec2 from = line[line.size() - 2];
  for (size_t i = line.size() - 1; i-- > 0;) {  // a direction over some px is steadier
    from = line[i];
    if (std::hypot(end.x - from.x, end.y - from.y) > 8 * s) break;
  }
  const float angle = std::atan2(end.y - from.y, end.x - from.x);
  for (const float turn : {2.6f, -2.6f})
    draw_line(
        list,
        {end, {end.x + 9 * s * std::cos(angle + turn), end.y + 9 * s * std::sin(angle + turn)}},
        false, color, style, 2.25f);
}

/// Draws the radius of a soft drag, and marks the handles that symmetry will move as well.
void draw_influence(MarkList& list, const Workspace& workspace, const ToolOverlay& gesture,
                    const OverlayStyle& style) {
  Selection dragged = workspace.selection;
  if (gesture.hover) dragged.insert(*gesture.hover);
  const Deformation& deformation = workspace.shown.deformation();
  const float s = static_cast<float>(style.scale);
  std::map<Handle, Handle> counterparts;
  if (workspace.tools.drag.symmetric && !dragged.empty())
    counterparts = counterparts_of(deformation);
  for (const Handle& handle : dragged) {
    if (!exists(deformation, handle, workspace.mode)) continue;
    if (workspace.tools.drag.soft && (gesture.hover == handle || dragged.size() == 1)) {
      const ImVec2 at = px(workspace, position_of(deformation, handle, workspace.mode));
      const float r = static_cast<float>(workspace.tools.drag.reach * workspace.layer_view().zoom);
      list.circle(at, r, IM_COL32(0, 0, 0, 80), 2.4f * s);
      list.circle(at, r, style.colors.hover, 1 * s);
    }
    const auto other = counterparts.find(handle);
    if (other != counterparts.end() && exists(deformation, other->second, workspace.mode)) {
      const ImVec2 at = px(workspace, position_of(deformation, other->second, workspace.mode));
      list.circle(at, 9 * s, style.colors.outline, 3.4f * s);
      list.circle(at, 9 * s, style.colors.selected, 1.8f * s);
    }
  }
}

/// Draws the painted stiffness and the brush. Plus signs mark stiff parts, and rings mark soft
/// ones; they are larger where the paint is stronger.
void draw_stiffness(MarkList& list, const Workspace& workspace, const ToolOverlay& gesture,
                    const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  const std::vector<BrushDab>& dabs =
      gesture.dabs ? *gesture.dabs : workspace.shown.deformation().stiffness;
  if (workspace.map().has_map() && !dabs.empty()) {
    constexpr size_t kMarks = 1500;
    const Points& rest = workspace.map().drawn()->vertices;
    const size_t step = rest.size() / kMarks + 1;
    for (size_t i = 0; i < rest.size(); i += step) {
      const double level = stiffness_level(dabs, rest[i]);
      if (std::abs(level) < 0.05) continue;
      const ImVec2 at =
          px(workspace,
             workspace.at_rest() ? rest[i] : workspace.map().map().f[static_cast<Index>(i)]);
      const float r = static_cast<float>(level > 0 ? 2 + 2 * level / kMaxStiffness
                                                   : 2 + 2 * level / kMinStiffness) *
                      s;
      if (level > 0) {
        list.fill_rect({at.x - r - s, at.y - 1.6f * s}, {at.x + r + s, at.y + 1.6f * s},
                       style.colors.outline);
        list.fill_rect({at.x - 1.6f * s, at.y - r - s}, {at.x + 1.6f * s, at.y + r + s},
                       style.colors.outline);
        list.line({at.x - r, at.y}, {at.x + r, at.y}, style.colors.selected, 1.4f * s);
        list.line({at.x, at.y - r}, {at.x, at.y + r}, style.colors.selected, 1.4f * s);
      } else {
        list.circle(at, r, style.colors.outline, 3 * s);
        list.circle(at, r, style.colors.pin, 1.4f * s);
      }
    }
  }
  if (!gesture.brush) return;
  const float radius =
      static_cast<float>(workspace.tools.brush_radius * workspace.layer_view().zoom);
  list.circle(px(workspace, *gesture.brush), radius, style.colors.outline, 3 * s);
  list.circle(px(workspace, *gesture.brush), radius, style.colors.hover, 1.4f * s);
}

/// Draws the outlines of the keyframes before and after the current time, in the tints of their
/// onion skins.
void draw_onion(MarkList& list, const Workspace& workspace, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  for (const OnionSkin& skin : workspace.onion_skins()) {
    std::vector<ImVec2> line;
    for (const int v : workspace.map().prepared()->mesh->boundary)
      line.push_back(px(workspace, skin.f[v]));
    const Color tint = onion_color(skin.later);
    list.polyline(line, true, IM_COL32(0, 0, 0, 110), 3 * s);
    list.polyline(line, true, ImGui::GetColorU32({tint[0], tint[1], tint[2], 0.9f}), 1.6f * s);
  }
}

/// Whether the posed cage is only the map's starting point. It is then drawn faintly, because pins,
/// strokes or angles determine the map.
bool is_start_only(const Workspace& workspace) {
  if (workspace.mode == EditMode::rest) return false;
  const Pose used = pose_of(workspace.shown.deformation());
  const bool turned = std::ranges::any_of(used.corners, [](const PoseCorner& corner) {
    return corner.before != 0 || corner.after != 0;
  });
  return !used.pins.empty() || !used.strokes.empty() || workspace.shows_outline() || turned ||
         workspace.tools.active == ToolId::angle;
}

/// How the cage is drawn.
struct CageLook {
  ImU32 color;
  bool faint;   ///< a thin line at half strength
  bool points;  ///< with its points
  bool hidden;  ///< not at all
};

/// Whether the pointer is on the canvas, or near the cage.
bool is_pointer_near_cage(const Workspace& workspace, bool anywhere) {
  const ImGuiIO& io = ImGui::GetIO();
  const Complex pointer(io.MousePos.x, io.MousePos.y);
  if (io.WantCaptureMouse || !workspace.layer_view().contains_px(pointer)) return false;
  constexpr double kNear = 3;  // in picking distances
  return anywhere || nearest_on_cage(cage_of(workspace.shown.deformation(), workspace.mode),
                                     workspace.layer_view().plane_at_px(pointer))
                                 .distance *
                             workspace.layer_view().zoom <
                         kNear * workspace.display.handle_px;
}

CageLook cage_look(const Workspace& workspace, const OverlayStyle& style) {
  const Deformation& deformation = workspace.shown.deformation();
  const bool rest = workspace.mode == EditMode::rest,
             draws =
                 workspace.tools.active == ToolId::pen || workspace.tools.active == ToolId::angle,
             acts = has_cage_handles(deformation, workspace.mode),
             start_only = is_start_only(workspace);
  CageLook look{rest ? style.colors.rest : style.colors.pose, start_only, true, false};
  const bool selected = std::ranges::any_of(
      workspace.selection, [](const Handle& handle) { return handle.kind == Handle::Kind::cage; });
  if (rest || draws || selected || !deformation.has_cage()) return look;
  look.points = acts && is_pointer_near_cage(workspace, !start_only);
  look.faint = !look.points;
  look.hidden = !look.points && !workspace.at_rest() &&
                whole_pose_of(deformation) != whole_pose_of(at_rest(deformation)) && !acts;
  return look;
}

/// The edge of the posed picture; empty before the first map.
Polygon edge_of(const Workspace& workspace) {
  const LiveMap& map = workspace.map();
  if (!map.has_map()) return {};
  const Mesh& mesh = *map.prepared()->mesh;
  Polygon edge{{}, mesh.starts};
  for (const int v : mesh.boundary) edge.points.push_back(map.map().f[v]);
  return edge;
}

void draw_faint_cage(MarkList& list, const Workspace& workspace, PolygonView cage, ImU32 color,
                     const OverlayStyle& style) {
  draw_loops(workspace, cage, [&](const std::vector<ImVec2>& line) {
    draw_faint_line(list, line, true, color, style);
  });
}

/// Draws the cage with its tangents, the cage that the map really has, and the outline.
void draw_curves(MarkList& list, const Workspace& workspace, CageLook look,
                 const OverlayStyle& style) {
  const Deformation& deformation = workspace.shown.deformation();
  const bool acts = has_cage_handles(deformation, workspace.mode);
  if (deformation.has_cage() && look.faint && !look.hidden)
    draw_faint_cage(list, workspace, acts ? outline_of(deformation.pose, 24) : edge_of(workspace),
                    look.color, style);
  else if (deformation.has_cage() && !look.hidden)
    draw_cage(list, workspace, cage_of(deformation, workspace.mode), look.color, style);
  if (const auto solved = is_start_only(workspace) ? solved_cage(workspace) : std::nullopt) {
    draw_loops(workspace, outline_of(*solved, 24), [&](const std::vector<ImVec2>& line) {
      draw_line(list, line, true, style.colors.pin, style);
    });
    for (const Complex& z : controls_of(*solved))
      list.fill_circle(px(workspace, z), 3 * static_cast<float>(style.scale), style.colors.pin);
  }
  if (deformation.has_cage() && acts && look.points)
    draw_tangents(list, workspace, cage_of(deformation, workspace.mode), look.color, style);
  if (workspace.shows_outline())
    draw_line(list, window_line(workspace, deformation.outline), true, style.colors.curve, style,
              1.75f);
}

/// Marks pins that the map misses, zeros of its derivative, and corners at their limit.
void draw_map_marks(MarkList& list, const Workspace& workspace, const OverlayStyle& style) {
  const Deformation& deformation = workspace.shown.deformation();
  const auto& posed = workspace.map().posed();
  if (!posed || !same_rest(*posed, deformation)) return;
  const bool at_rest = workspace.mode == EditMode::rest;
  for (size_t i = 0; i < deformation.pins.size() && !at_rest; ++i)
    if (const auto reached = workspace.map().pin_image(i))
      draw_miss(list, px(workspace, deformation.pins[i].pose), px(workspace, *reached), style);
  for (const Complex& zero : at_rest ? workspace.map().map().zeros : workspace.map().zero_images())
    draw_zero(list, px(workspace, zero), style);
  if (!at_rest) draw_limited_corners(list, workspace, style);
}

void draw_cage_point(MarkList& list, const Workspace& workspace, Handle handle, bool hovered,
                     CageLook look, const OverlayStyle& style) {
  const Deformation& deformation = workspace.shown.deformation();
  const ImVec2 at = px(workspace, position_of(deformation, handle, workspace.mode));
  const bool selected = workspace.selection.contains(handle);
  if (!look.points && !selected && !hovered) return;
  draw_cage_handle(list, at, handle.control == 0, selected, hovered, look.color, style);
  if (handle.control == 0 && is_smooth(deformation, handle.index, workspace.mode))
    draw_smooth_mark(list, at, style);
}

void draw_handles(MarkList& list, const Workspace& workspace, const ToolOverlay& gesture,
                  CageLook look, const OverlayStyle& style) {
  const Deformation& deformation = workspace.shown.deformation();
  const bool by_angles =
      workspace.mode == EditMode::pose && workspace.tools.active == ToolId::angle;
  if (by_angles && deformation.has_cage()) draw_corners(list, workspace, gesture, style);
  for (const Handle& handle : handles_of(deformation, workspace.mode)) {
    const bool hovered = gesture.hover == handle;
    if (handle.kind == Handle::Kind::stroke)
      draw_stroke(list, workspace, handle, hovered, style);
    else if (handle.kind == Handle::Kind::pin)
      draw_pin(list, px(workspace, position_of(deformation, handle, workspace.mode)),
               deformation.pins[handle.index], workspace.selection.contains(handle), hovered,
               style);
    else if (!by_angles)
      draw_cage_point(list, workspace, handle, hovered, look, style);
  }
}

/// Fills the visible folds and puts a ring around each.
void draw_folds(MarkList& list, const Workspace& workspace, const OverlayStyle& style) {
  if (workspace.at_rest() || !workspace.map().has_map()) return;
  const Mesh& mesh = *workspace.map().prepared()->mesh;
  const VectorXc& f = workspace.map().map().f;
  const float s = static_cast<float>(style.scale);
  constexpr double kMostMarked = 20;  // a picture that folds everywhere is not marked everywhere
  if (static_cast<double>(workspace.folds().size()) > kMostMarked) return;
  for (const Fold& fold : workspace.folds()) {
    for (const int t : fold.triangles) {
      const auto [i, j, k] = mesh.triangles[static_cast<size_t>(t)];
      list.fill_triangle(px(workspace, f[i]), px(workspace, f[j]), px(workspace, f[k]),
                         (style.colors.fold & 0x00ffffff) | 0x70000000);
    }
    const float radius = std::clamp(
        static_cast<float>(fold.radius * workspace.layer_view().zoom) + 6 * s, 10 * s, 400 * s);
    list.circle(px(workspace, fold.at), radius, style.colors.outline, 3.5f * s);
    list.circle(px(workspace, fold.at), radius, style.colors.fold, 1.5f * s);
  }
}

void draw_structure(MarkList& list, const Workspace& workspace, const ToolOverlay& gesture,
                    const OverlayStyle& style) {
  draw_onion(list, workspace, style);
  if (workspace.display.show_cage && gesture.line.empty()) {
    const CageLook look = cage_look(workspace, style);
    draw_curves(list, workspace, look, style);
    draw_folds(list, workspace, style);
    draw_map_marks(list, workspace, style);
    draw_held_region(list, workspace, style);
    draw_handles(list, workspace, gesture, look, style);
  } else if (workspace.display.show_cage && gesture.in_cage) {
    const Deformation& deformation = workspace.shown.deformation();
    draw_faint_cage(list, workspace, outline_of(cage_of(deformation, workspace.mode), 24),
                    style.colors.rest, style);
  }
  if (gesture.shows_dabs) draw_stiffness(list, workspace, gesture, style);
  if (workspace.display.show_cage) draw_influence(list, workspace, gesture, style);
  draw_gesture(list, workspace, gesture, style);
  for (const Complex& at : gesture.coming_pins) draw_pin(list, vec(at), Pin{}, false, false, style);
}

/// Draws what a layer can be attached to.
void draw_targets(MarkList& list, const std::vector<TargetMark>& targets,
                  const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  for (const TargetMark& target : targets) {
    const ImVec2 at = vec(target.line[0]);
    if (target.line.size() > 1) {
      std::vector<ImVec2> line;
      for (const Complex& px : target.line) line.push_back(vec(px));
      draw_line(list, line, false, target.hovered ? style.colors.hover : style.colors.stroke,
                style);
    } else if (target.is_pin) {
      draw_pin(list, at, Pin{}, false, target.hovered, style);
    } else {
      const float r = 9 * s;
      for (const auto& [color, width] :
           {std::pair(style.colors.outline, 4 * s), {style.colors.hover, 2 * s}}) {
        list.circle(at, r, color, width);
        for (const ImVec2 way : {ImVec2{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
          list.line({at.x + r * way.x, at.y + r * way.y},
                    {at.x + 1.7f * r * way.x, at.y + 1.7f * r * way.y}, color, width);
      }
    }
  }
}

}  // namespace

void draw_overlay(const Workspace& workspace, const ToolOverlay& gesture,
                  const OverlayStyle& style) {
  ImDrawList& background = *ImGui::GetBackgroundDrawList();
  MarkList list(background);
  if (!workspace.display.hide_overlays && !workspace.display.show_original &&
      workspace.document.scene().layer().visible) {
    // The overlay is drawn only in the "after" part, which shows the pose.
    const Viewport view = workspace.layer_view();
    const double from = view.left + workspace.display.split.value_or(0) * view.width;
    background.PushClipRect(
        {static_cast<float>(from), static_cast<float>(view.top)},
        {static_cast<float>(view.left + view.width), static_cast<float>(view.top + view.height)});
    draw_structure(list, workspace, gesture, style);
    draw_targets(list, gesture.targets, style);
    background.PopClipRect();
  }
}

void draw_proposed_cage(const Workspace& workspace, const Cage& cage, const OverlayStyle& style) {
  MarkList list(*ImGui::GetBackgroundDrawList());
  draw_loops(workspace, outline_of(cage), [&](const std::vector<ImVec2>& line) {
    draw_line(list, line, true, style.colors.pose, style);
  });
}

void draw_marker(const Workspace& workspace, Complex where, const OverlayStyle& style) {
  MarkList list(*ImGui::GetBackgroundDrawList());
  const ImVec2 at = px(workspace, where);
  const float s = static_cast<float>(style.scale), r = 16 * s;
  list.circle(at, r, style.colors.outline, 6 * s);
  list.circle(at, r, style.colors.warning, 3 * s);
  list.line({at.x - 6 * s, at.y - 6 * s}, {at.x + 6 * s, at.y + 6 * s}, style.colors.warning,
            3 * s);
  list.line({at.x - 6 * s, at.y + 6 * s}, {at.x + 6 * s, at.y - 6 * s}, style.colors.warning,
            3 * s);
}

}  // namespace holomorph
