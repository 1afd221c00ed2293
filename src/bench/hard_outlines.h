// Shapes that are hard to map conformally onto each other, because of crowding: thin shapes, and
// shapes with limbs, notches and sharp corners.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/types.h"

namespace outlines {

using namespace holomorph;

inline Points circle(double radius, int n) {
  Points points;
  for (int i = 0; i < n; ++i) points.push_back(std::polar(radius, 2 * kPi * i / n));
  return points;
}

/// The shapes' names and polygons.
inline std::vector<std::pair<std::string, Points>> hard_shapes() {
  std::vector<std::pair<std::string, Points>> shapes;
  shapes.push_back({"disk", circle(100, 120)});
  shapes.push_back({"square", {{-100, -100}, {100, -100}, {100, 100}, {-100, 100}}});
  shapes.push_back({"bar", {{-300, -30}, {300, -30}, {300, 30}, {-300, 30}}});
  Points star;
  for (int i = 0; i < 10; ++i)
    star.push_back(std::polar(i % 2 ? 76.4 : 200.0, kPi / 2 + 2 * kPi * i / 10));
  shapes.push_back({"star", star});
  shapes.push_back({"E",
                    {{0, 0},
                     {200, 0},
                     {200, 60},
                     {60, 60},
                     {60, 130},
                     {170, 130},
                     {170, 190},
                     {60, 190},
                     {60, 260},
                     {200, 260},
                     {200, 320},
                     {0, 320}}});
  shapes.push_back({"H",
                    {{0, 0},
                     {60, 0},
                     {60, 130},
                     {160, 130},
                     {160, 0},
                     {220, 0},
                     {220, 320},
                     {160, 320},
                     {160, 190},
                     {60, 190},
                     {60, 320},
                     {0, 320}}});
  shapes.push_back(
      {"hourglass", {{-100, -150}, {100, -150}, {12, 0}, {100, 150}, {-100, 150}, {-12, 0}}});
  Points comb{{0, 0}, {360, 0}};
  for (int tooth = 4; tooth >= 0; --tooth) {
    const double left = 80.0 * tooth, right = left + 40;
    if (tooth < 4) comb.emplace_back(right, 50);
    comb.emplace_back(right, 200);
    comb.emplace_back(left, 200);
    if (tooth > 0) comb.emplace_back(left, 50);
  }
  shapes.push_back({"comb", comb});
  Points spiral;
  for (const int side : {0, 1})
    for (int i = 0; i <= 60; ++i) {
      const double t = (side == 0 ? i : 60 - i) / 60.0, angle = 2 * kPi * 1.25 * t;
      spiral.push_back(std::polar(60 + 130 * t + (side == 0 ? 35 : -35), angle));
    }
  shapes.push_back({"spiral", spiral});
  return shapes;
}

}  // namespace outlines
