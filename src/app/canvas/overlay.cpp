// Every line has a dark edge, so that it is visible on any picture.
#include "app/canvas/overlay.h"

#include "app/canvas/canvas.h"
#include "app/canvas/corner_overlay.h"
#include "edit/content.h"
#include "edit/edits/curve_edits.h"

namespace holomorph {

ImVec2 px(const Workspace& workspace, Complex z) {
  const Complex at = workspace.display.viewport.px_at_plane(z);
  return {static_cast<float>(at.real()), static_cast<float>(at.imag())};
}

namespace {

void stroke(ImDrawList& list, const std::vector<ImVec2>& line, bool closed, ImU32 color,
            const OverlayStyle& style) {
  const float width = static_cast<float>(style.scale);
  const ImDrawFlags flags = closed ? ImDrawFlags_Closed : 0;
  list.AddPolyline(line.data(), static_cast<int>(line.size()), style.colors.outline, flags,
                   3.5f * width);
  list.AddPolyline(line.data(), static_cast<int>(line.size()), color, flags, 1.8f * width);
}

/// Draws a dashed line. Rest shapes are dashed because not everyone can tell them from poses by
/// their color.
void dashes(ImDrawList& list, const std::vector<ImVec2>& line, ImU32 color,
            const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale), period = 12 * s, drawn = 8 * s;
  float at = 0;  // position within the period of the dashes
  for (size_t i = 0; i < line.size(); ++i) {
    const ImVec2 a = line[i], b = line[(i + 1) % line.size()];
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0) || length > 1e5f) continue;
    const auto place = [&](float t) {
      return ImVec2(a.x + (b.x - a.x) * t / length, a.y + (b.y - a.y) * t / length);
    };
    for (float t = -at; t < length; t += period) {
      const float from = std::max(t, 0.0f), to = std::min(t + drawn, length);
      if (to > from) list.AddLine(place(from), place(to), color, 1.8f * s);
    }
    at = std::fmod(at + length, period);
  }
}

void draw_cage(ImDrawList& list, const Workspace& workspace, const Cage& cage, ImU32 color,
               const OverlayStyle& style) {
  std::vector<ImVec2> line;
  for (const Complex& z : outline_of(cage, 24)) line.push_back(px(workspace, z));
  if (line.size() < 2) return;
  if (workspace.mode == EditMode::pose) return stroke(list, line, true, color, style);
  const float width = static_cast<float>(style.scale);
  list.AddPolyline(line.data(), static_cast<int>(line.size()), style.colors.outline,
                   ImDrawFlags_Closed, 3.5f * width);
  dashes(list, line, color, style);
}

/// Draws lines from each vertex to its tangent handles. For segments whose degree is not 3, draws
/// the whole control polygon.
void draw_tangents(ImDrawList& list, const Workspace& workspace, const Cage& cage, ImU32 color,
                   const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  for (Index e = 0; e < cage.size(); ++e) {
    const Points controls = cage.controls(e);
    for (size_t m = 0; controls.size() > 2 && m + 1 < controls.size(); ++m) {
      if (controls.size() == 4 && m == 1) continue;
      const ImVec2 a = px(workspace, controls[m]), b = px(workspace, controls[m + 1]);
      list.AddLine(a, b, style.colors.outline, 2.4f * s);
      list.AddLine(a, b, color, 1.1f * s);
    }
  }
}

void draw_cage_handle(ImDrawList& list, ImVec2 at, bool vertex, bool selected, bool hovered,
                      ImU32 color, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale), r = (hovered ? 6.5f : 5.0f) * s;
  const ImU32 fill = selected ? style.colors.selected : hovered ? style.colors.hover : color;
  if (vertex) {
    list.AddRectFilled({at.x - r, at.y - r}, {at.x + r, at.y + r}, style.colors.outline, 2 * s);
    list.AddRectFilled({at.x - r + 1.5f * s, at.y - r + 1.5f * s},
                       {at.x + r - 1.5f * s, at.y + r - 1.5f * s}, fill, 1.5f * s);
    if (selected)
      list.AddRectFilled({at.x - 1.8f * s, at.y - 1.8f * s}, {at.x + 1.8f * s, at.y + 1.8f * s},
                         color);
  } else {
    list.AddCircleFilled(at, 0.9f * r, style.colors.outline);
    list.AddCircleFilled(at, 0.9f * r - 1.3f * s, fill);
  }
}

/// Draws the ring around a smooth vertex. Corners have none.
void draw_smooth_mark(ImDrawList& list, ImVec2 at, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  list.AddCircle(at, 8.5f * s, style.colors.outline, 0, 2.6f * s);
  list.AddCircle(at, 8.5f * s, style.colors.selected, 0, 1.2f * s);
}

void draw_pin(ImDrawList& list, ImVec2 at, const Pin& pin, bool selected, bool hovered,
              const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale), r = (hovered ? 8.5f : 7.0f) * s;
  list.AddCircleFilled(at, r, style.colors.outline);
  list.AddCircleFilled(at, r - 1.5f * s,
                       selected  ? style.colors.selected
                       : hovered ? style.colors.hover
                                 : style.colors.pin);
  list.AddCircleFilled(at, 2.4f * s, selected ? style.colors.pin : IM_COL32(60, 40, 0, 255));
  if (pin.depth != 0) {
    const std::string text = (pin.depth > 0 ? "+" : "") + std::to_string(pin.depth);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str()),
                 corner(at.x + (selected ? 4.2f : 1) * r, at.y + 0.4f * r);
    list.AddRectFilled(corner, {corner.x + size.x + 6 * s, corner.y + size.y + 2 * s},
                       style.colors.panel, 3 * s);
    list.AddText({corner.x + 3 * s, corner.y + s}, style.colors.text, text.c_str());
  }
  if (pin.angle) {
    const float angle = static_cast<float>(*pin.angle);
    list.AddLine(at, {at.x + 1.9f * r * std::cos(angle), at.y - 1.9f * r * std::sin(angle)},
                 style.colors.outline, 4 * s);
    list.AddLine(at, {at.x + 1.9f * r * std::cos(angle), at.y - 1.9f * r * std::sin(angle)},
                 style.colors.pin, 2 * s);
  }
}

/// Draws a line from a pin's target to the point where the map takes the pin, if the gap is
/// visible.
void draw_miss(ImDrawList& list, ImVec2 pin, ImVec2 place, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  if (std::hypot(pin.x - place.x, pin.y - place.y) < 4 * s) return;
  list.AddLine(pin, place, style.colors.outline, 3.5f * s);
  list.AddLine(pin, place, style.colors.warning, 1.8f * s);
  list.AddCircleFilled(place, 4.5f * s, style.colors.outline);
  list.AddCircleFilled(place, 3 * s, style.colors.warning);
}

/// Marks a zero of the derivative with a diamond and a dot. Only maps that are kept from folding
/// report such zeros.
void draw_zero(ImDrawList& list, ImVec2 at, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  const auto diamond = [&](float r, ImU32 color) {
    list.AddQuadFilled({at.x - r, at.y}, {at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r},
                       color);
  };
  diamond(8.5f * s, style.colors.outline);
  diamond(6.5f * s, style.colors.accent);
  list.AddCircleFilled(at, 2 * s, style.colors.outline);
}

/// Draws the box around the selection, with its grips and its knob.
void draw_box(ImDrawList& list, const BoxMark& mark, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  const auto at = [](Complex z) {
    return ImVec2(static_cast<float>(z.real()), static_cast<float>(z.imag()));
  };
  std::vector<ImVec2> line;
  for (const Complex& corner : mark.corners) line.push_back(at(corner));
  stroke(list, line, true, style.colors.accent, style);
  list.AddLine(at(mark.grip(5)), at(mark.knob), style.colors.accent, 1.2f * s);
  for (int grip = 0; grip <= 8; ++grip) {
    const ImVec2 z = at(mark.grip(grip));
    const bool hovered = mark.hovered == grip;
    const float r = (hovered ? 5.5f : 4.5f) * s;
    const ImU32 fill = hovered ? style.colors.hover : style.colors.accent;
    if (grip == 8) {
      list.AddCircleFilled(z, r + 1.2f * s, style.colors.outline);
      list.AddCircleFilled(z, r, fill);
    } else {
      list.AddRectFilled({z.x - r - s, z.y - r - s}, {z.x + r + s, z.y + r + s},
                         style.colors.outline);
      list.AddRectFilled({z.x - r, z.y - r}, {z.x + r, z.y + r}, fill);
    }
  }
}

void draw_gesture(ImDrawList& list, const Workspace& workspace, const ToolOverlay& gesture,
                  const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  if (!gesture.line.empty()) {
    std::vector<ImVec2> line;
    for (const Complex& z : gesture.line) line.push_back(px(workspace, z));
    if (gesture.line_end)
      line.push_back(gesture.closes ? line[0] : px(workspace, *gesture.line_end));
    stroke(list, line, false, style.colors.rest, style);
    for (size_t i = 0; i < gesture.line_points.size(); ++i)
      draw_cage_handle(list, px(workspace, gesture.line_points[i]), true, false,
                       i == 0 && gesture.closes, style.colors.rest, style);
  }
  if (gesture.insertion) {
    const ImVec2 at = px(workspace, *gesture.insertion);
    list.AddCircleFilled(at, 7 * s, style.colors.outline);
    list.AddCircleFilled(at, 5.5f * s, style.colors.hover);
    list.AddLine({at.x - 3 * s, at.y}, {at.x + 3 * s, at.y}, IM_COL32_BLACK, 1.5f * s);
    list.AddLine({at.x, at.y - 3 * s}, {at.x, at.y + 3 * s}, IM_COL32_BLACK, 1.5f * s);
  }
  for (const Guide& guide : gesture.guides) {
    const ImVec2 from = px(workspace, guide.from), to = px(workspace, guide.to);
    list.AddLine(from, to, style.colors.outline, 2.6f * s);
    list.AddLine(from, to, style.colors.hover, 1.2f * s);
    list.AddCircle(from, 4 * s, style.colors.hover, 0, 1.2f * s);
  }
  if (gesture.box) draw_box(list, *gesture.box, style);
  if (gesture.marquee) {
    const ImVec2 a(static_cast<float>(gesture.marquee->left),
                   static_cast<float>(gesture.marquee->bottom));
    const ImVec2 b(static_cast<float>(gesture.marquee->right),
                   static_cast<float>(gesture.marquee->top));
    list.AddRectFilled(a, b, (style.colors.accent & 0x00ffffff) | 0x30000000);
    list.AddRect(a, b, style.colors.accent, 0, 0, 1.2f * s);
  }
  if (gesture.ring &&
      *gesture.ring < static_cast<Index>(workspace.shown.deformation().pins.size())) {
    const ImVec2 at = px(workspace, workspace.shown.deformation().pins[*gesture.ring].pose);
    const float radius = static_cast<float>(kRingRadius * workspace.display.handle_px);
    list.AddCircle(at, radius, style.colors.outline, 0, 4.5f * s);
    list.AddCircle(at, radius, gesture.ring_hovered ? style.colors.hover : style.colors.pin, 0,
                   (gesture.ring_hovered ? 3.2f : 2.2f) * s);
  }
}

/// Draws a stroke. Its start is a dot, its end a ring.
void draw_stroke(ImDrawList& list, const Workspace& workspace, Handle handle, bool hovered,
                 const OverlayStyle& style) {
  const EditMode mode = workspace.mode;
  const Deformation& deformation = workspace.shown.deformation();
  const bool selected = workspace.selection.contains(handle);
  const ImU32 color = selected  ? style.colors.selected
                      : hovered ? style.colors.hover
                                : (mode == EditMode::rest ? style.colors.rest : style.colors.pose);
  std::vector<ImVec2> line;
  for (const Complex& z : curve_of(deformation, handle.index, mode))
    line.push_back(px(workspace, z));
  stroke(list, line, false, color, style);
  const float s = static_cast<float>(style.scale);
  list.AddCircleFilled(line.front(), 5.5f * s, style.colors.outline);
  list.AddCircleFilled(line.front(), 4 * s, color);
  list.AddCircle(line.back(), 4.5f * s, style.colors.outline, 0, 3.4f * s);
  list.AddCircle(line.back(), 4.5f * s, color, 0, 1.8f * s);
}

/// Draws the radius of a soft drag, and marks the handles that symmetry will move as well.
void draw_influence(ImDrawList& list, const Workspace& workspace, const ToolOverlay& gesture,
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
      const float r =
          static_cast<float>(workspace.tools.drag.reach * workspace.display.viewport.zoom);
      list.AddCircle(at, r, IM_COL32(0, 0, 0, 80), 96, 2.4f * s);
      list.AddCircle(at, r, style.colors.hover, 96, 1 * s);
    }
    const auto other = counterparts.find(handle);
    if (other != counterparts.end() && exists(deformation, other->second, workspace.mode)) {
      const ImVec2 at = px(workspace, position_of(deformation, other->second, workspace.mode));
      list.AddCircle(at, 9 * s, style.colors.outline, 0, 3.4f * s);
      list.AddCircle(at, 9 * s, style.colors.selected, 0, 1.8f * s);
    }
  }
}

/// Draws the painted stiffness and the brush. Plus signs mark stiff parts, and rings mark soft
/// ones; they are larger where the paint is stronger.
void draw_stiffness(ImDrawList& list, const Workspace& workspace, const ToolOverlay& gesture,
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
        list.AddRectFilled({at.x - r - s, at.y - 1.6f * s}, {at.x + r + s, at.y + 1.6f * s},
                           style.colors.outline);
        list.AddRectFilled({at.x - 1.6f * s, at.y - r - s}, {at.x + 1.6f * s, at.y + r + s},
                           style.colors.outline);
        list.AddLine({at.x - r, at.y}, {at.x + r, at.y}, style.colors.selected, 1.4f * s);
        list.AddLine({at.x, at.y - r}, {at.x, at.y + r}, style.colors.selected, 1.4f * s);
      } else {
        list.AddCircle(at, r, style.colors.outline, 0, 3 * s);
        list.AddCircle(at, r, style.colors.pin, 0, 1.4f * s);
      }
    }
  }
  if (!gesture.brush) return;
  const float radius =
      static_cast<float>(workspace.tools.brush_radius * workspace.display.viewport.zoom);
  list.AddCircle(px(workspace, *gesture.brush), radius, style.colors.outline, 64, 3 * s);
  list.AddCircle(px(workspace, *gesture.brush), radius, style.colors.hover, 64, 1.4f * s);
}

/// Draws the outlines of the keyframes before and after the current time, in the tints of their
/// onion skins.
void draw_onion(ImDrawList& list, const Workspace& workspace, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  for (const OnionSkin& skin : workspace.onion_skins()) {
    std::vector<ImVec2> line;
    for (const int v : workspace.map().prepared()->mesh->boundary)
      line.push_back(px(workspace, skin.f[v]));
    const int count = static_cast<int>(line.size());
    const Color tint = onion_color(skin.later);
    list.AddPolyline(line.data(), count, IM_COL32(0, 0, 0, 110), ImDrawFlags_Closed, 3 * s);
    list.AddPolyline(line.data(), count, ImGui::GetColorU32({tint[0], tint[1], tint[2], 0.9f}),
                     ImDrawFlags_Closed, 1.6f * s);
  }
}

/// Draws the line between before and after, on top of the rest of the overlay.
void draw_split(const Workspace& workspace, const OverlayStyle& style) {
  if (!workspace.display.split) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Viewport& view = workspace.display.viewport;
  const float s = static_cast<float>(style.scale), top = static_cast<float>(view.top),
              bottom = static_cast<float>(view.top + view.height),
              x = static_cast<float>(view.left + *workspace.display.split * view.width);
  list.AddLine({x, top}, {x, bottom}, style.colors.outline, 4 * s);
  list.AddLine({x, top}, {x, bottom}, style.colors.selected, 2 * s);
  const float middle = (top + bottom) / 2;
  list.AddRectFilled({x - 5 * s, middle - 18 * s}, {x + 5 * s, middle + 18 * s},
                     style.colors.outline, 5 * s);
  list.AddRectFilled({x - 3.5f * s, middle - 16.5f * s}, {x + 3.5f * s, middle + 16.5f * s},
                     style.colors.selected, 3.5f * s);
  const float height = ImGui::GetTextLineHeight();
  for (const auto& [text, left] : {std::pair("Before", true), {"After", false}}) {
    const float width = ImGui::CalcTextSize(text).x, pad = 8 * s,
                at = left ? x - width - 3 * pad : x + pad;
    list.AddRectFilled({at, bottom - height - 3 * pad}, {at + width + 2 * pad, bottom - pad},
                       style.colors.panel, 4 * s);
    list.AddText({at + pad, bottom - height - 2 * pad}, style.colors.text, text);
  }
}

void draw_structure(ImDrawList& list, const Workspace& workspace, const ToolOverlay& gesture,
                    const OverlayStyle& style) {
  const Deformation& deformation = workspace.shown.deformation();
  const EditMode mode = workspace.mode;
  draw_onion(list, workspace, style);
  if (workspace.display.show_cage && gesture.line.empty()) {
    const ImU32 color = mode == EditMode::rest ? style.colors.rest : style.colors.pose;
    // With pins or strokes, the posed cage is only the map's starting point, so it is drawn
    // faintly.
    const Pose used = pose_of(deformation);
    const bool turned = std::ranges::any_of(used.corners, [](const PoseCorner& corner) {
      return corner.before != 0 || corner.after != 0;
    });
    const bool by_angles = mode == EditMode::pose && workspace.tools.active == ToolId::angle;
    const bool faint = mode == EditMode::pose && (!used.pins.empty() || !used.strokes.empty() ||
                                                  workspace.shows_outline() || turned || by_angles);
    if (deformation.has_cage() && faint) {
      std::vector<ImVec2> line;
      for (const Complex& z : outline_of(deformation.pose, 24)) line.push_back(px(workspace, z));
      const float width = static_cast<float>(style.scale);
      list.AddPolyline(line.data(), static_cast<int>(line.size()), IM_COL32(0, 0, 0, 70),
                       ImDrawFlags_Closed, 2.6f * width);
      list.AddPolyline(line.data(), static_cast<int>(line.size()),
                       (color & 0x00ffffff) | 0xb0000000, ImDrawFlags_Closed, 1.3f * width);
    } else if (deformation.has_cage())
      draw_cage(list, workspace, cage_of(deformation, mode), color, style);
    if (const auto solved = faint ? solved_cage(workspace) : std::nullopt) {
      std::vector<ImVec2> line;
      for (const Complex& z : outline_of(*solved, 24)) line.push_back(px(workspace, z));
      stroke(list, line, true, style.colors.pin, style);
      for (const Complex& z : controls_of(*solved))
        list.AddCircleFilled(px(workspace, z), 3 * static_cast<float>(style.scale),
                             style.colors.pin);
    }
    if (deformation.has_cage())
      draw_tangents(list, workspace, cage_of(deformation, mode), color, style);
    if (workspace.shows_outline()) {
      std::vector<ImVec2> line;
      for (const Complex& z : deformation.outline) line.push_back(px(workspace, z));
      stroke(list, line, true, style.colors.accent, style);
    }
    const auto& posed = workspace.map().posed();
    if (posed && same_rest(*posed, deformation)) {
      const bool at_rest = mode == EditMode::rest;
      for (size_t i = 0; i < deformation.pins.size() && !at_rest; ++i)
        if (const auto place = workspace.map().pin_image(i))
          draw_miss(list, px(workspace, deformation.pins[i].pose), px(workspace, *place), style);
      for (const Complex& zero :
           at_rest ? workspace.map().map().zeros : workspace.map().zero_images())
        draw_zero(list, px(workspace, zero), style);
      if (!at_rest) draw_limited_corners(list, workspace, style);
    }
    if (by_angles && deformation.has_cage()) draw_corners(list, workspace, gesture, style);
    for (const Handle& handle : handles_of(deformation, mode)) {
      if (handle.kind == Handle::Kind::stroke) {
        draw_stroke(list, workspace, handle, gesture.hover == handle, style);
        continue;
      }
      const ImVec2 at = px(workspace, position_of(deformation, handle, mode));
      if (by_angles && handle.kind == Handle::Kind::cage) continue;
      const bool selected = workspace.selection.contains(handle), hovered = gesture.hover == handle;
      if (faint && handle.kind == Handle::Kind::cage && !selected && !hovered) {
        const float r = 2.6f * static_cast<float>(style.scale);
        list.AddRectFilled({at.x - r, at.y - r}, {at.x + r, at.y + r}, IM_COL32(0, 0, 0, 90));
        list.AddRectFilled({at.x - r + 1, at.y - r + 1}, {at.x + r - 1, at.y + r - 1},
                           (color & 0x00ffffff) | 0xb0000000);
        continue;
      }
      if (handle.kind == Handle::Kind::pin)
        draw_pin(list, at, deformation.pins[handle.index], selected, hovered, style);
      else
        draw_cage_handle(list, at, handle.control == 0, selected, hovered, color, style);
      if (handle.kind == Handle::Kind::cage && handle.control == 0 &&
          is_smooth(deformation, handle.index, mode))
        draw_smooth_mark(list, at, style);
    }
  }
  if (gesture.shows_dabs) draw_stiffness(list, workspace, gesture, style);
  if (workspace.display.show_cage) draw_influence(list, workspace, gesture, style);
  draw_gesture(list, workspace, gesture, style);
}

}  // namespace

void draw_overlay(const Workspace& workspace, const ToolOverlay& gesture,
                  const OverlayStyle& style) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  if (!workspace.display.hide_overlays && !workspace.display.show_original &&
      workspace.document.scene().layer().visible) {
    // The overlay is drawn only in the "after" part, which shows the pose.
    const Viewport& view = workspace.display.viewport;
    const double from = view.left + workspace.display.split.value_or(0) * view.width;
    list.PushClipRect(
        {static_cast<float>(from), static_cast<float>(view.top)},
        {static_cast<float>(view.left + view.width), static_cast<float>(view.top + view.height)});
    draw_structure(list, workspace, gesture, style);
    list.PopClipRect();
  }
  draw_split(workspace, style);
}

void draw_marker(const Workspace& workspace, Complex where, const OverlayStyle& style) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 at = px(workspace, where);
  const float s = static_cast<float>(style.scale), r = 16 * s;
  list.AddCircle(at, r, style.colors.outline, 0, 6 * s);
  list.AddCircle(at, r, style.colors.warning, 0, 3 * s);
  list.AddLine({at.x - 6 * s, at.y - 6 * s}, {at.x + 6 * s, at.y + 6 * s}, style.colors.warning,
               3 * s);
  list.AddLine({at.x - 6 * s, at.y + 6 * s}, {at.x + 6 * s, at.y - 6 * s}, style.colors.warning,
               3 * s);
}

}  // namespace holomorph
