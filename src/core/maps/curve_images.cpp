// The pieces are cubic Hermite interpolants. All pieces of all curves that are not close enough are
// halved together, because maps are fast for many points at once.
#include "core/maps/curve_images.h"

#include <algorithm>

#include "core/geometry/curve.h"

namespace holomorph {
namespace {

/// A point of an image, and the derivative with respect to the curve's parameter.
struct CurveSample {
  Complex at, speed;
};

struct CurvePiece {
  size_t curve;
  double from, to;
  CurveSample start, end;

  double middle() const { return 0.5 * (from + to); }
  Points cubic() const {
    const double arm = (to - from) / 3;
    return {start.at, start.at + arm * start.speed, end.at - arm * end.speed, end.at};
  }
};

Complex speed_of(const Points& curve, double t) {
  Points differences;
  for (size_t k = 0; k + 1 < curve.size(); ++k)
    differences.push_back(static_cast<double>(curve.size() - 1) * (curve[k + 1] - curve[k]));
  return bezier_point(differences, t);
}

/// The images of many points of curves.
class CurveSamples {
 public:
  CurveSamples(const std::vector<Points>& curves, const PointValues& map)
      : curves_(curves), map_(map) {}

  void ask(size_t curve, double t) {
    points_.push_back(bezier_point(curves_[curve], t));
    speeds_.push_back(speed_of(curves_[curve], t));
  }
  /// What was asked for since the last call.
  std::vector<CurveSample> answers() {
    const std::vector<PointMap::Value> values =
        points_.empty() ? std::vector<PointMap::Value>() : map_(points_);
    std::vector<CurveSample> samples;
    for (size_t i = 0; i < values.size(); ++i)
      samples.push_back(
          {values[i].f, values[i].fz * speeds_[i] + values[i].fzbar * std::conj(speeds_[i])});
    points_.clear();
    speeds_.clear();
    return samples;
  }

 private:
  const std::vector<Points>& curves_;
  const PointValues& map_;
  Points points_, speeds_;
};

}  // namespace

std::vector<std::vector<Points>> curve_images(const std::vector<Points>& curves,
                                              const PointValues& map, double tolerance) {
  CurveSamples samples(curves, map);
  std::vector<CurvePiece> open, finished;
  for (size_t c = 0; c < curves.size(); ++c)
    for (const double t : {0.0, 1.0}) samples.ask(c, t);
  const std::vector<CurveSample> ends = samples.answers();
  for (size_t c = 0; c < curves.size(); ++c)
    open.push_back({c, 0, 1, ends[2 * c], ends[2 * c + 1]});
  // The error of a cubic Hermite interpolant of a smooth curve is largest near 1/2. That of a curve
  // with kinks, which maps that are linear in triangles have, may be largest anywhere.
  constexpr double kInside[] = {0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875};
  constexpr size_t kCount = std::size(kInside);
  constexpr int kMostHalvings = 12;
  for (int halvings = 0; !open.empty(); ++halvings) {
    for (const CurvePiece& piece : open)
      for (const double t : kInside)
        samples.ask(piece.curve, piece.from + t * (piece.to - piece.from));
    const std::vector<CurveSample> inside = samples.answers();
    std::vector<CurvePiece> halves;
    for (size_t i = 0; i < open.size(); ++i) {
      const CurvePiece& piece = open[i];
      const Points cubic = piece.cubic();
      double off = 0;
      for (size_t k = 0; k < kCount; ++k)
        off = std::max(off, std::abs(bezier_point(cubic, kInside[k]) - inside[kCount * i + k].at));
      if (off <= tolerance || halvings == kMostHalvings) {
        finished.push_back(piece);
        continue;
      }
      const CurveSample& middle = inside[kCount * i + kCount / 2];
      halves.push_back({piece.curve, piece.from, piece.middle(), piece.start, middle});
      halves.push_back({piece.curve, piece.middle(), piece.to, middle, piece.end});
    }
    open = std::move(halves);
  }
  std::ranges::sort(finished, {},
                    [](const CurvePiece& piece) { return std::pair(piece.curve, piece.from); });
  std::vector<std::vector<Points>> images(curves.size());
  for (const CurvePiece& piece : finished) images[piece.curve].push_back(piece.cubic());
  return images;
}

}  // namespace holomorph
