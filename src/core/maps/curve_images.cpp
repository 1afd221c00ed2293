// The pieces are cubic Hermite interpolants. All pieces of all curves that are not close enough are
// halved together, because maps are fast for many points at once.
#include "core/maps/curve_images.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace holomorph {
namespace {

constexpr size_t kFewestParts = 8, kMostParts = 256;  // of a piece
constexpr size_t kMostAtOnce = size_t{1} << 20;       // samples of long pieces
constexpr double kSpacing = 100;                      // of samples, in tolerances
constexpr int kMostSplits = 20;

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

/// De Casteljau's algorithm. The last line is the tangent.
CurveSample sample_of(const Points& curve, double t) {
  constexpr size_t kMostPoints = 4;
  std::array<Complex, kMostPoints> points{};
  std::ranges::copy(curve, points.begin());
  const size_t degree = curve.size() - 1;
  for (size_t level = degree; level > 1; --level)
    for (size_t k = 0; k < level; ++k) points[k] += t * (points[k + 1] - points[k]);
  const Complex line = points[1] - points[0];
  return {points[0] + t * line, static_cast<double>(degree) * line};
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
/// together than `spacing` at rest, if that is possible with `most`.
size_t part_count(const Points& curve, const CurvePiece& piece, double spacing, size_t most) {
  double length = 0;
  for (size_t k = 0; k + 1 < curve.size(); ++k) length += std::abs(curve[k + 1] - curve[k]);
  length *= piece.to - piece.from;
  size_t parts = kFewestParts;
  while (2 * parts <= most && static_cast<double>(parts) * spacing < length) parts *= 2;
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

/// Asks for evenly spaced samples inside of all pieces. Returns how many each has.
std::vector<size_t> ask_inside(CurveSamples& samples, const std::vector<Points>& curves,
                               const std::vector<CurvePiece>& pieces, double spacing) {
  const size_t most = std::min(kMostParts, kMostAtOnce / pieces.size());
  std::vector<size_t> counts;
  for (const CurvePiece& piece : pieces) {
    const size_t parts = part_count(curves[piece.curve], piece, spacing, most);
    const double step = (piece.to - piece.from) / static_cast<double>(parts);
    for (size_t k = 1; k < parts; ++k)
      samples.ask(piece.curve, piece.from + step * static_cast<double>(k));
    counts.push_back(parts - 1);
  }
  return counts;
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
  size_t samples_left = kMostAtOnce + 40 * curves.size();
  for (int halvings = 0; !open.empty(); ++halvings) {
    const std::vector<size_t> counts = ask_inside(samples, curves, open, kSpacing * tolerance);
    const size_t asked = std::reduce(counts.begin(), counts.end());
    if (asked > samples_left) {
      finished.insert(finished.end(), open.begin(), open.end());
      break;
    }
    samples_left -= asked;
    const std::vector<CurveSample> inside = samples.answers();
    std::vector<CurvePiece> halves;
    std::span<const CurveSample> rest = inside;
    for (size_t i = 0; i < open.size(); ++i) {
      const CurvePiece& piece = open[i];
      const std::span its = rest.first(counts[i]);
      rest = rest.subspan(counts[i]);
      if (halvings == kMostSplits || largest_error(piece, its) <= tolerance) {
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
