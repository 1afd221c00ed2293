// Draws marks, but skips points that are too far away for ImGui.
#pragma once

#include <span>
#include <string>

#include "app/look/text.h"

namespace holomorph {

/// Draws shapes in window px. ImGui may crash where a coordinate is infinite, and extreme maps take
/// handles anywhere. Therefore shapes at points that are not finite or farther away than 1e7 px are
/// left out, and so are the parts of lines that touch such points. Single lines outside of the clip
/// rectangle are left out, too. Widths and radii are in px.
class MarkList {
 public:
  explicit MarkList(ImDrawList& list) : list_(list) {}

  void line(ImVec2 from, ImVec2 to, ImU32 color, float width);
  void polyline(std::span<const ImVec2> points, bool closed, ImU32 color, float width);
  void rect(ImVec2 from, ImVec2 to, ImU32 color, float rounding, float width);
  void fill_rect(ImVec2 from, ImVec2 to, ImU32 color, float rounding = 0);
  void circle(ImVec2 center, float radius, ImU32 color, float width);
  void fill_circle(ImVec2 center, float radius, ImU32 color);
  /// The part of a disk between two angles, in radians, clockwise from the right.
  void fill_wedge(ImVec2 center, float radius, float from, float to, ImU32 color);
  void triangle(ImVec2 a, ImVec2 b, ImVec2 c, ImU32 color, float width);
  void fill_triangle(ImVec2 a, ImVec2 b, ImVec2 c, ImU32 color);
  void fill_quad(ImVec2 a, ImVec2 b, ImVec2 c, ImVec2 d, ImU32 color);
  void text(Type type, ImVec2 at, ImU32 color, const std::string& text);

 private:
  ImDrawList& list_;
};

/// Whether MarkList draws at a point.
bool can_draw_at(ImVec2 point);

}  // namespace holomorph
