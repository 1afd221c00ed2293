// Steps along the loop are halved until the change of the argument along each step is unambiguous.
#include "core/outline/inner_loop.h"

#include <cmath>

#include "core/geometry/polygon.h"

namespace holomorph {
namespace {

constexpr double kCertain = 0.5;  ///< radians between neighbors
constexpr int kRounds = 20;

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

/// Whether the argument may change by a full turn or more between the two values.
bool is_uncertain(Complex from, Complex to) {
  constexpr double kRatio = 4;
  const Complex ratio = to / from;
  return !(std::abs(std::arg(ratio)) <= kCertain) || !(std::norm(ratio) < kRatio * kRatio) ||
         !(std::norm(ratio) > 1 / (kRatio * kRatio));
}

struct EdgeSample {
  Complex from, to;  ///< positions
  Complex value_from, value_to;
};

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

int zeros_inside(const Points& loop, const VectorXc& values,
                 const std::function<VectorXc(const Points&)>& at) {
  std::vector<EdgeSample> steps;
  for (size_t i = 0; i < loop.size(); ++i) {
    const size_t next = (i + 1) % loop.size();
    steps.push_back(
        {loop[i], loop[next], values[static_cast<Index>(i)], values[static_cast<Index>(next)]});
  }
  double turned = 0;
  for (int round = 0; !steps.empty(); ++round) {
    std::vector<EdgeSample> unsure;
    Points middles;
    for (const EdgeSample& step : steps) {
      if (round < kRounds && is_uncertain(step.value_from, step.value_to)) {
        unsure.push_back(step);
        middles.push_back(0.5 * (step.from + step.to));
      } else {
        turned += std::arg(step.value_to / step.value_from);
      }
    }
    steps.clear();
    if (middles.empty()) break;
    const VectorXc between = at(middles);
    for (size_t i = 0; i < unsure.size(); ++i) {
      const Complex middle = middles[i], value = between[static_cast<Index>(i)];
      steps.push_back({unsure[i].from, middle, unsure[i].value_from, value});
      steps.push_back({middle, unsure[i].to, value, unsure[i].value_to});
    }
  }
  return static_cast<int>(std::lround(turned / (2 * kPi)));
}

}  // namespace holomorph
