// A point whose coordinates are NaN counts as too far away, because comparisons with NaN are false.
#include "app/canvas/mark_list.h"

#include <algorithm>
#include <cmath>
#include <concepts>

namespace holomorph {
namespace {

constexpr float kFarthest = 1e7f;  // px

bool can_draw(float radius) {
  return radius > 0 && radius <= kFarthest;
}

bool can_draw_at_all(std::same_as<ImVec2> auto... points) {
  return (can_draw_at(points) && ...);
}

}  // namespace

bool can_draw_at(ImVec2 point) {
  return std::abs(point.x) <= kFarthest && std::abs(point.y) <= kFarthest;
}

void MarkList::line(ImVec2 from, ImVec2 to, ImU32 color, float width) {
  if (!can_draw_at_all(from, to)) return;
  const ImVec2 low = list_.GetClipRectMin(), high = list_.GetClipRectMax();
  const auto is_hidden = [&](float a, float b, float least, float most) {
    return std::max(a, b) + width < least || std::min(a, b) - width > most;
  };
  if (!is_hidden(from.x, to.x, low.x, high.x) && !is_hidden(from.y, to.y, low.y, high.y))
    list_.AddLine(from, to, color, width);
}

void MarkList::polyline(std::span<const ImVec2> points, bool closed, ImU32 color, float width) {
  if (std::ranges::all_of(points, can_draw_at)) {
    list_.AddPolyline(points.data(), static_cast<int>(points.size()), color,
                      closed ? ImDrawFlags_Closed : 0, width);
    return;
  }
  const size_t count = closed ? points.size() : points.size() - 1;
  for (size_t i = 0; i < count; ++i) line(points[i], points[(i + 1) % points.size()], color, width);
}

void MarkList::rect(ImVec2 from, ImVec2 to, ImU32 color, float rounding, float width) {
  if (can_draw_at_all(from, to)) list_.AddRect(from, to, color, rounding, 0, width);
}

void MarkList::fill_rect(ImVec2 from, ImVec2 to, ImU32 color, float rounding) {
  if (can_draw_at_all(from, to)) list_.AddRectFilled(from, to, color, rounding);
}

void MarkList::circle(ImVec2 center, float radius, ImU32 color, float width) {
  if (can_draw_at(center) && can_draw(radius)) list_.AddCircle(center, radius, color, 0, width);
}

void MarkList::fill_circle(ImVec2 center, float radius, ImU32 color) {
  if (can_draw_at(center) && can_draw(radius)) list_.AddCircleFilled(center, radius, color);
}

void MarkList::fill_wedge(ImVec2 center, float radius, float from, float to, ImU32 color) {
  if (!can_draw_at(center) || !can_draw(radius)) return;
  list_.PathLineTo(center);
  list_.PathArcTo(center, radius, from, to, 32);
  list_.PathFillConvex(color);
}

void MarkList::triangle(ImVec2 a, ImVec2 b, ImVec2 c, ImU32 color, float width) {
  if (can_draw_at_all(a, b, c)) list_.AddTriangle(a, b, c, color, width);
}

void MarkList::fill_triangle(ImVec2 a, ImVec2 b, ImVec2 c, ImU32 color) {
  if (can_draw_at_all(a, b, c)) list_.AddTriangleFilled(a, b, c, color);
}

void MarkList::fill_quad(ImVec2 a, ImVec2 b, ImVec2 c, ImVec2 d, ImU32 color) {
  if (can_draw_at_all(a, b, c, d)) list_.AddQuadFilled(a, b, c, d, color);
}

void MarkList::text(Type type, ImVec2 at, ImU32 color, const std::string& text) {
  if (can_draw_at(at)) draw_text(list_, type, at, color, text);
}

}  // namespace holomorph
