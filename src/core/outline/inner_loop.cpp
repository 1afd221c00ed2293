// The miter of a corner is at the same distance from both sides.
#include "core/outline/inner_loop.h"

#include <cmath>

#include "core/geometry/polygon.h"

namespace holomorph {
namespace {

Points offset_inwards(const Points& polygon, double distance) {
  constexpr double kArcStep = 0.3;
  // Where the polygon is straight up to rounding errors, the ends of an arc would coincide.
  constexpr double kStraight = 0.01;
  Points loop;
  const size_t n = polygon.size();
  for (size_t i = 0; i < n; ++i) {
    const Complex before = polygon[i] - polygon[(i + n - 1) % n],
                  after = polygon[(i + 1) % n] - polygon[i];
    const Complex in = before / std::abs(before), out = after / std::abs(after);
    const double turn = std::arg(out / in);
    if (turn >= -kStraight) {
      loop.push_back(polygon[i] + distance * kI * (in + out) / std::max(1 + std::cos(turn), 1e-9));
      continue;
    }
    const int parts = 1 + static_cast<int>(-turn / kArcStep);
    for (int k = 0; k <= parts; ++k)
      loop.push_back(polygon[i] + distance * kI * in * std::polar(1.0, turn * k / parts));
  }
  return loop;
}

Points in_steps(const Points& loop, double longest) {
  Points points;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Complex from = loop[i], edge = loop[(i + 1) % loop.size()] - from;
    const int parts = 1 + static_cast<int>(std::abs(edge) / longest);
    for (int k = 0; k < parts; ++k) points.push_back(from + edge * (1.0 * k / parts));
  }
  return points;
}

}  // namespace

Points inner_loop(const Points& polygon, double distance) {
  constexpr int kHalvings = 20;
  const double longest = 3 * distance;
  Points loop = offset_inwards(polygon, distance);
  for (int halving = 0; halving < kHalvings && self_crossing(loop); ++halving) {
    distance /= 2;
    loop = offset_inwards(polygon, distance);
  }
  return in_steps(loop, longest);
}

int zeros_inside(const Points& loop, const VectorXc& values, const FunctionValues& at) {
  std::vector<Step> steps;
  for (size_t i = 0; i < loop.size(); ++i) {
    const size_t next = (i + 1) % loop.size();
    steps.push_back(
        {loop[i], loop[next], values[static_cast<Index>(i)], values[static_cast<Index>(next)]});
  }
  return static_cast<int>(std::lround(argument_changes(steps, at).sum() / (2 * kPi)));
}

}  // namespace holomorph
