// The line is resampled at equal steps before it is smoothed, which makes the result independent of
// the speed of the hand.
#include "edit/tools/freehand.h"

#include <algorithm>
#include <utility>

#include "core/geometry/polyline.h"

namespace holomorph {
namespace {

constexpr double kStepPx = 3;  ///< smallest distance between recorded points
constexpr int kFewest = 8, kFewestAround = 24, kMost = 400, kSmoothings = 3;

}  // namespace

bool Freehand::follow(const Input& input) {
  const bool ends = input.released || !input.down;
  if (std::abs(input.px - last_px_) >= (ends ? 1e-9 : kStepPx)) {
    line_.push_back(input.position);
    last_px_ = input.px;
  }
  return ends;
}

Points Freehand::finish(bool closed, double step_px, double shortest_px, const Viewport& view) {
  Points line = without_repeats(std::exchange(line_, {}));
  if (closed && line.size() > 1 && line.front() == line.back()) line.pop_back();
  double length = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) length += std::abs(line[i + 1] - line[i]);
  if (line.size() < (closed ? 4 : 2) || length * view.zoom < shortest_px) return {};
  const Polyline drawn(line, closed);
  const double count = drawn.length() * view.zoom / step_px;
  Points points = at_equal_lengths(drawn, static_cast<Index>(std::clamp<double>(
                                              count, closed ? kFewestAround : kFewest, kMost)));
  for (int pass = 0; pass < kSmoothings; ++pass) {
    const Points before = points;
    const size_t n = points.size();
    for (size_t i = closed ? 0 : 1; i < (closed ? n : n - 1); ++i)
      points[i] = 0.25 * (before[(i + n - 1) % n] + 2.0 * before[i] + before[(i + 1) % n]);
  }
  return points;
}

}  // namespace holomorph
