// Coordinates are those of a box of 72 x 56 units whose top is at -3.
#include "app/look/method_picture.h"

#include <cmath>
#include <initializer_list>
#include <vector>

#include "app/look/theme.h"
#include "core/types.h"

namespace holomorph {
namespace {

class Sketch {
 public:
  Sketch(ImDrawList& list, ImVec2 center, float scale, ImU32 ink, ImU32 surface)
      : list_(list), center_(center), unit_(scale * px(100) / 100), ink_(ink), surface_(surface) {}

  void turn(double degrees) {
    cos_ = static_cast<float>(std::cos(degrees * kPi / 180));
    sin_ = static_cast<float>(std::sin(degrees * kPi / 180));
  }
  ImVec2 at(float x, float y) const {
    const float dx = x - 36, dy = y - 25;
    return {center_.x + unit_ * (cos_ * dx - sin_ * dy),
            center_.y + unit_ * (sin_ * dx + cos_ * dy)};
  }
  void disk(float x, float y, float radius) {
    list_.AddCircleFilled(at(x, y), radius * unit_, faded(ink_), 32);
  }
  /// A thick line through points with round ends.
  void limb(std::initializer_list<ImVec2> points, float width) {
    std::vector<ImVec2> line;
    for (const ImVec2& point : points) line.push_back(at(point.x, point.y));
    list_.AddPolyline(line.data(), static_cast<int>(line.size()), faded(ink_), 0, width * unit_);
    for (const ImVec2& point : line)
      list_.AddCircleFilled(point, width * unit_ / 2, faded(ink_), 24);
  }
  /// A limb along a cubic curve.
  void bent(ImVec2 a, ImVec2 b, ImVec2 c, ImVec2 d, float width, float end_width = 0) {
    if (end_width == 0) end_width = width;
    constexpr int kSteps = 24;
    for (int i = 0; i <= kSteps; ++i) {
      const float t = static_cast<float>(i) / kSteps, u = 1 - t;
      const ImVec2 z(u * u * u * a.x + 3 * u * u * t * b.x + 3 * u * t * t * c.x + t * t * t * d.x,
                     u * u * u * a.y + 3 * u * u * t * b.y + 3 * u * t * t * c.y + t * t * t * d.y);
      list_.AddCircleFilled(at(z.x, z.y), (width + t * (end_width - width)) * unit_ / 2,
                            faded(ink_), 16);
    }
  }
  void dot(float x, float y) {
    list_.AddCircleFilled(at(x, y), 3.2f * unit_, faded(surface_), 20);
    list_.AddCircleFilled(at(x, y), 2.3f * unit_, faded(theme_colors().accent), 20);
  }
  void square(float x, float y) {
    const float r = 1.75f * unit_;
    const ImVec2 z = at(x, y);
    list_.AddRectFilled({z.x - r, z.y - r}, {z.x + r, z.y + r}, faded(surface_));
    list_.AddRect({z.x - r, z.y - r}, {z.x + r, z.y + r}, faded(theme_colors().accent), 0, 0,
                  1.2f * unit_);
  }
  void line(std::initializer_list<ImVec2> points, bool closed, float width = 1.25f) {
    std::vector<ImVec2> drawn;
    for (const ImVec2& point : points) drawn.push_back(at(point.x, point.y));
    list_.AddPolyline(drawn.data(), static_cast<int>(drawn.size()), faded(theme_colors().accent),
                      closed ? ImDrawFlags_Closed : 0, width * unit_);
  }

  void body() {
    limb({{36, 20}, {36, 30}}, 13);
    limb({{33.5f, 32}, {28.5f, 45}}, 7);
    limb({{38.5f, 32}, {43.5f, 45}}, 7);
  }
  void left_arm() { bent({32, 19}, {26, 24}, {22, 25}, {17, 30}, 7); }

 private:
  ImDrawList& list_;
  ImVec2 center_;
  float unit_, cos_ = 1, sin_ = 0;
  ImU32 ink_, surface_;
};

void draw_puppet(Sketch& sketch, bool stiff) {
  sketch.disk(36, 9, 6.5f);
  sketch.body();
  sketch.left_arm();
  if (stiff)
    sketch.limb({{40, 19}, {48, 20}, {53, 8}}, 7);
  else
    sketch.bent({40, 19}, {47, 22}, {51, 17}, {53, 8}, 7);
  for (const auto& [x, y] : {std::pair(36.0f, 22.0f), {53, 8}, {17, 30}, {28.5f, 45}, {43.5f, 45}})
    sketch.dot(x, y);
}

void draw_elastic(Sketch& sketch) {
  sketch.disk(36.5f, 9, 7);
  sketch.body();
  sketch.left_arm();
  sketch.bent({40, 19.5f}, {47, 21}, {49, 15}, {54, 7.5f}, 7, 12);
  for (const auto& [x, y] : {std::pair(36.0f, 22.0f), {54, 7.5f}, {17, 30}}) sketch.dot(x, y);
}

void draw_straight_figure(Sketch& sketch) {
  sketch.disk(36, 10.5f, 6);
  sketch.body();
  sketch.limb({{32, 19}, {19, 26}}, 7);
  sketch.limb({{40, 19}, {53, 26}}, 7);
}

void draw_cage(Sketch& sketch, bool straight) {
  draw_straight_figure(sketch);
  if (straight) {
    sketch.line({{14, -1}, {58, -1}, {62, 50}, {10, 50}}, true);
    for (const auto& [x, y] : {std::pair(14.0f, -1.0f), {58, -1}, {62, 50}, {10, 50}})
      sketch.square(x, y);
    return;
  }
  sketch.line(
      {{36, -1.5f}, {61, 17.5f}, {57.5f, 32}, {50, 50.5f}, {22, 50.5f}, {14.5f, 32}, {11, 17.5f}},
      true);
  for (const auto& [x, y] : {std::pair(36.0f, -1.5f),
                             {61, 17.5f},
                             {57.5f, 32},
                             {50, 50.5f},
                             {22, 50.5f},
                             {14.5f, 32},
                             {11, 17.5f}})
    sketch.square(x, y);
}

void draw_strokes(Sketch& sketch) {
  draw_straight_figure(sketch);
  sketch.line({{19, 26}, {28, 21}, {36, 19}, {44, 21}, {53, 26}}, false, 2);
  sketch.line({{49, 20.5f}, {53.5f, 26.2f}, {46.5f, 27.5f}}, false, 2);
}

void draw_angle(Sketch& sketch) {
  draw_straight_figure(sketch);
  sketch.line({{10, 50}, {20, 2}, {62, 40}}, false, 1.6f);
  sketch.line({{17.5f, 14}, {22, 14.5f}, {26, 12}, {28.4f, 9.6f}}, false, 1.6f);
  sketch.square(20, 2);
}

void draw_place(Sketch& sketch) {
  sketch.turn(-9);
  sketch.disk(36, 14, 5);
  sketch.limb({{36, 22.5f}, {36, 30}}, 10);
  sketch.limb({{34, 32}, {30.5f, 41}}, 5.5f);
  sketch.limb({{38, 32}, {41.5f, 41}}, 5.5f);
  sketch.limb({{33, 22}, {24, 28}}, 5.5f);
  sketch.limb({{39, 22}, {48, 28}}, 5.5f);
  sketch.line({{17, 7}, {55, 7}, {55, 47}, {17, 47}}, true);
  sketch.line({{36, 7}, {36, 1.5f}}, false);
  sketch.dot(36, 0);
  for (const float x : {17.0f, 55.0f})
    for (const float y : {7.0f, 47.0f}) sketch.square(x, y);
}

}  // namespace

void draw_method_picture(ImDrawList& list, const std::string& method, ImVec2 center, float scale,
                         ImU32 ink, ImU32 surface) {
  Sketch sketch(list, center, scale, ink, surface);
  if (method == "sheet" || method == "puppet" || method == "arap")
    draw_puppet(sketch, method == "arap");
  else if (method == "pins" || method == "har_arap")
    draw_elastic(sketch);
  else if (method == "strokes")
    draw_strokes(sketch);
  else if (method == "angles")
    draw_angle(sketch);
  else if (method == "place")
    draw_place(sketch);
  else
    draw_cage(sketch, method == "harmonic" || method == "mean_value");
}

}  // namespace holomorph
