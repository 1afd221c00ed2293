// Every mark has a dark edge, so that it is visible on any picture.
#include "app/canvas/marks.h"

#include "edit/tools/tool.h"

namespace holomorph {

void draw_line(ImDrawList& list, const std::vector<ImVec2>& line, bool closed, ImU32 color,
               const OverlayStyle& style) {
  const float width = static_cast<float>(style.scale);
  const ImDrawFlags flags = closed ? ImDrawFlags_Closed : 0;
  list.AddPolyline(line.data(), static_cast<int>(line.size()), style.colors.outline, flags,
                   3.5f * width);
  list.AddPolyline(line.data(), static_cast<int>(line.size()), color, flags, 1.8f * width);
}

void draw_dashes(ImDrawList& list, const std::vector<ImVec2>& line, ImU32 color,
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

void draw_miss(ImDrawList& list, ImVec2 pin, ImVec2 place, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  if (std::hypot(pin.x - place.x, pin.y - place.y) < 4 * s) return;
  list.AddLine(pin, place, style.colors.outline, 3.5f * s);
  list.AddLine(pin, place, style.colors.warning, 1.8f * s);
  list.AddCircleFilled(place, 4.5f * s, style.colors.outline);
  list.AddCircleFilled(place, 3 * s, style.colors.warning);
}

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

void draw_box(ImDrawList& list, const BoxMark& mark, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  const auto at = [](Complex z) {
    return ImVec2(static_cast<float>(z.real()), static_cast<float>(z.imag()));
  };
  std::vector<ImVec2> line;
  for (const Complex& corner : mark.corners) line.push_back(at(corner));
  draw_line(list, line, true, style.colors.accent, style);
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

}  // namespace holomorph
