// The pieces are cubic Hermite interpolants. All pieces of all curves that are not close enough are
// halved together, because maps are fast for many points at once.
#include "core/maps/curve_images.h"

#include <algorithm>
#include <numeric>

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

CurveSample sample_of(const Points& curve, double t) {
  Points differences;
  for (size_t k = 0; k + 1 < curve.size(); ++k)
    differences.push_back(static_cast<double>(curve.size() - 1) * (curve[k + 1] - curve[k]));
  return {bezier_point(curve, t), bezier_point(differences, t)};
}

/// The images of many points of curves.
class CurveSamples {
 public:
  CurveSamples(const std::vector<Points>& curves, const PointValues& map)
      : curves_(curves), map_(map) {}

  void ask(size_t curve, double t) {
    const CurveSample sample = sample_of(curves_[curve], t);
    points_.push_back(sample.at);
    speeds_.push_back(sample.speed);
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

/// How many parts a piece has between its samples: at least 8, and as many as keep samples nearer
/// together than `spacing`.
size_t part_count(const CurvePiece& piece, double spacing) {
  constexpr size_t kFewest = 8, kMost = 256;
  const Points cubic = piece.cubic();
  double length = 0;
  for (size_t k = 0; k + 1 < cubic.size(); ++k) length += std::abs(cubic[k + 1] - cubic[k]);
  size_t parts = kFewest;
  while (parts < kMost && static_cast<double>(parts) * spacing < length) parts *= 2;
  return parts;
}

/// How far the errors are from 0 between two samples that lie `step` apart. A curve with a kink,
/// which maps that are linear in triangles have, may be farthest off at the kink, where the lines
/// that continue the errors from both sides meet. Smooth errors between samples are below that.
double largest_error(const CurveSample& a, const CurveSample& b, double step) {
  const Complex chord = (b.at - a.at) / step;
  const double rise = std::abs(a.speed - chord), fall = std::abs(b.speed - chord);
  const double peak = rise + fall > 0 ? step * rise * fall / (rise + fall) : 0;
  return std::max(std::abs(a.at), std::abs(b.at)) + peak;
}

/// How far the piece's cubic is from the image, of which `inside` are evenly spaced samples.
double largest_error(const CurvePiece& piece, std::span<const CurveSample> inside) {
  const Points cubic = piece.cubic();
  const double step = 1 / static_cast<double>(inside.size() + 1);
  CurveSample before{0, 0};
  double largest = 0;
  for (size_t k = 0; k <= inside.size(); ++k) {
    CurveSample error{0, 0};
    if (k < inside.size()) {
      const CurveSample ours = sample_of(cubic, step * static_cast<double>(k + 1));
      error = {ours.at - inside[k].at, ours.speed - (piece.to - piece.from) * inside[k].speed};
    }
    largest = std::max(largest, largest_error(before, error, step));
    before = error;
  }
  return largest;
}

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
  constexpr int kMostHalvings = 20;
  constexpr double kSpacing = 100;  // in tolerances
  size_t left = (size_t{1} << 20) + 512 * curves.size();
  for (int halvings = 0; !open.empty(); ++halvings) {
    std::vector<size_t> counts;
    for (const CurvePiece& piece : open)
      counts.push_back(part_count(piece, kSpacing * tolerance) - 1);
    const size_t needed = std::reduce(counts.begin(), counts.end());
    if (needed > left) {
      finished.insert(finished.end(), open.begin(), open.end());
      break;
    }
    left -= needed;
    for (size_t i = 0; i < open.size(); ++i)
      for (size_t k = 1; k <= counts[i]; ++k)
        samples.ask(open[i].curve, open[i].from + (open[i].to - open[i].from) *
                                                      static_cast<double>(k) /
                                                      static_cast<double>(counts[i] + 1));
    const std::vector<CurveSample> inside = samples.answers();
    std::vector<CurvePiece> halves;
    std::span<const CurveSample> rest = inside;
    for (size_t i = 0; i < open.size(); ++i) {
      const CurvePiece& piece = open[i];
      const std::span its = rest.first(counts[i]);
      rest = rest.subspan(counts[i]);
      if (halvings == kMostHalvings || largest_error(piece, its) <= tolerance) {
        finished.push_back(piece);
        continue;
      }
      const CurveSample& middle = its[its.size() / 2];
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
