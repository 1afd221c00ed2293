// Every mark has a dark edge, so that it is visible on any picture.
#include "app/canvas/marks.h"

#include <cmath>
#include <cstdio>

#include "app/look/text.h"
#include "edit/tools/tool.h"

namespace holomorph {

namespace {

/// A line of a color with a dark line under it that is 2 px wider.
void draw_edged(MarkList& list, const std::vector<ImVec2>& line, bool closed, ImU32 color,
                float width, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  list.polyline(line, closed, style.colors.outline, (width + 2) * s);
  list.polyline(line, closed, color, width * s);
}

}  // namespace

void draw_line(MarkList& list, const std::vector<ImVec2>& line, bool closed, ImU32 color,
               const OverlayStyle& style, float width) {
  draw_edged(list, line, closed, color, width, style);
}

void draw_faint_line(MarkList& list, const std::vector<ImVec2>& line, bool closed, ImU32 color,
                     const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  list.polyline(line, closed, IM_COL32(0, 0, 0, 50), 2.5f * s);
  list.polyline(line, closed, (color & 0x00ffffff) | 0x80000000, s);
}

void draw_dashes(MarkList& list, const std::vector<ImVec2>& line, bool closed, ImU32 color,
                 const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale), period = 12 * s, drawn = 8 * s;
  float at = 0;  // position within the period of the dashes
  const size_t count = closed ? line.size() : line.size() - 1;
  for (size_t i = 0; i < count; ++i) {
    const ImVec2 a = line[i], b = line[(i + 1) % line.size()];
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0) || length > 1e5f) continue;
    const auto place = [&](float t) {
      return ImVec2(a.x + (b.x - a.x) * t / length, a.y + (b.y - a.y) * t / length);
    };
    for (float t = -at; t < length; t += period) {
      const float from = std::max(t, 0.0f), to = std::min(t + drawn, length);
      if (to > from) list.line(place(from), place(to), color, 1.8f * s);
    }
    at = std::fmod(at + length, period);
  }
}

void draw_cage_handle(MarkList& list, ImVec2 at, bool vertex, bool selected, bool hovered,
                      ImU32 color, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale), r = (hovered ? 4.75f : 3.5f) * s;
  const ImU32 fill = selected ? style.colors.selected : style.colors.hover;
  const auto square = [&](float radius, ImU32 ink) {
    list.fill_rect({at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}, ink, s);
  };
  if (vertex) {
    square(r + 1.5f * s, IM_COL32(0, 0, 0, 140));
    square(r, fill);
    square(r - 1.25f * s, selected ? IM_COL32_WHITE : color);
    square(std::max(r - 2.25f * s, s), fill);
  } else {
    list.fill_circle(at, 0.9f * r + 1.5f * s, IM_COL32(0, 0, 0, 140));
    list.fill_circle(at, 0.9f * r, fill);
  }
}

void draw_smooth_mark(MarkList& list, ImVec2 at, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  list.circle(at, 7.5f * s, style.colors.outline, 2.6f * s);
  list.circle(at, 7.5f * s, style.colors.hover, 1.1f * s);
}

void draw_chip(MarkList& list, ImVec2 corner, const std::string& text) {
  const ThemeColors& c = theme_colors();
  const ImVec2 size = text_size(Type::caption, text),
               to(corner.x + size.x + holomorph::px(12), corner.y + size.y + holomorph::px(4));
  list.fill_rect(corner, to, c.raised, holomorph::px(4));
  list.rect(corner, to, c.edge, holomorph::px(4), 1);
  list.text(Type::caption, {corner.x + holomorph::px(6), corner.y + holomorph::px(2)}, c.text,
            text);
}

void draw_pin(MarkList& list, ImVec2 at, const Pin& pin, bool selected, bool hovered,
              const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  if (hovered) list.fill_circle(at, 10 * s, (style.colors.pin & 0x00ffffff) | 0x60000000);
  if (pin.angle && !selected) {
    const float angle = static_cast<float>(*pin.angle), reach = 13 * s;
    const ImVec2 end(at.x + reach * std::cos(angle), at.y - reach * std::sin(angle));
    list.line(at, end, style.colors.outline, 4 * s);
    list.line(at, end, style.colors.pin, 2 * s);
  }
  list.fill_circle(at, 7.5f * s, IM_COL32(0, 0, 0, 90));
  list.fill_circle(at, 6.5f * s, selected ? style.colors.pin : IM_COL32_WHITE);
  list.fill_circle(at, 4.75f * s, selected ? IM_COL32_WHITE : style.colors.pin);
  if (pin.depth != 0)
    draw_chip(list, {at.x + 8 * s, at.y + 4 * s},
              (pin.depth > 0 ? "+" : "") + std::to_string(pin.depth));
}

void draw_ring(MarkList& list, ImVec2 at, float radius, const Pin& pin, bool hovered,
               const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  const ImU32 amber = style.colors.pin;
  const float angle = static_cast<float>(pin.angle.value_or(pin.turn.value_or(0)));
  const ImVec2 knob(at.x + radius * std::cos(angle), at.y - radius * std::sin(angle));
  if (pin.angle && std::abs(angle) > 1e-3f) {
    // The wedge shows the rotation without whole turns.
    const float shown = std::remainder(angle, 2 * static_cast<float>(kPi));
    list.fill_wedge(at, radius, 0, -shown, (amber & 0x00ffffff) | 0x50000000);
  }
  list.circle(at, radius, IM_COL32(0, 0, 0, 140), 3.5f * s);
  list.circle(at, radius, hovered ? amber : IM_COL32_WHITE, (hovered ? 2.5f : 1.5f) * s);
  if (!pin.angle) return;
  list.line(at, knob, IM_COL32_WHITE, 1.5f * s);
  list.fill_circle(knob, 6 * s, IM_COL32(0, 0, 0, 140));
  list.fill_circle(knob, 5 * s, IM_COL32_WHITE);
  char text[24];
  std::snprintf(text, sizeof text, "%.0f\u00b0", static_cast<double>(angle) * 180 / kPi);
  draw_chip(list, {at.x + radius + 8 * s, at.y - radius}, text);
}

void draw_held_disk(MarkList& list, ImVec2 at, float radius, const OverlayStyle& style) {
  constexpr int kPoints = 72;
  std::vector<ImVec2> circle;
  for (int k = 0; k < kPoints; ++k) {
    const float angle = 2 * static_cast<float>(kPi) * static_cast<float>(k) / kPoints;
    circle.emplace_back(at.x + radius * std::cos(angle), at.y + radius * std::sin(angle));
  }
  list.polyline(circle, true, style.colors.outline, 3 * static_cast<float>(style.scale));
  draw_dashes(list, circle, true, style.colors.pin, style);
}

void draw_miss(MarkList& list, ImVec2 pin, ImVec2 place, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  if (std::hypot(pin.x - place.x, pin.y - place.y) < 4 * s) return;
  list.line(pin, place, style.colors.outline, 3.5f * s);
  draw_dashes(list, {pin, place}, false, style.colors.unreached, style);
  list.fill_circle(place, 4.5f * s, style.colors.outline);
  list.fill_circle(place, 3 * s, style.colors.unreached);
}

void draw_zero(MarkList& list, ImVec2 at, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  const auto diamond = [&](float r, ImU32 color) {
    list.fill_quad({at.x - r, at.y}, {at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, color);
  };
  diamond(8.5f * s, style.colors.outline);
  diamond(6.5f * s, style.colors.accent);
  list.fill_circle(at, 2 * s, style.colors.outline);
}

void draw_box(MarkList& list, const BoxMark& mark, const OverlayStyle& style) {
  const float s = static_cast<float>(style.scale);
  const auto at = [](Complex z) {
    return ImVec2(static_cast<float>(z.real()), static_cast<float>(z.imag()));
  };
  std::vector<ImVec2> line;
  for (const Complex& corner : mark.corners) line.push_back(at(corner));
  draw_line(list, line, true, style.colors.accent, style);
  list.line(at(mark.grip(5)), at(mark.knob), style.colors.accent, 1.2f * s);
  for (int grip = 0; grip <= 8; ++grip) {
    const ImVec2 z = at(mark.grip(grip));
    const bool hovered = mark.hovered == grip;
    const float r = (hovered ? 5.5f : 4.5f) * s;
    const ImU32 fill = hovered ? style.colors.hover : style.colors.accent;
    if (grip == 8) {
      list.fill_circle(z, r + 1.2f * s, style.colors.outline);
      list.fill_circle(z, r, fill);
    } else {
      list.fill_rect({z.x - r - s, z.y - r - s}, {z.x + r + s, z.y + r + s}, style.colors.outline);
      list.fill_rect({z.x - r, z.y - r}, {z.x + r, z.y + r}, fill);
    }
  }
}

}  // namespace holomorph
