// Between corners, samples are equally spaced in the integral of 1 / spacing.
#include "core/outline/outline_samples.h"

#include <algorithm>
#include <cmath>

namespace holomorph {
namespace {

constexpr Index kThicknessPoints = 600;
constexpr double kThicknessFraction =
    0.5;  ///< spacing over the radius of the largest touching disk

struct CornerSample {
  double length = 0, sharpness = 0;  ///< |pi / interior angle - 1|
  /// At distances from a convex corner below this fraction of the length, rounding hides the
  /// corner's power law.
  double least = 0;
};

std::vector<CornerSample> corners_from(const Polyline& outline, double start) {
  constexpr double kLeastTurn = kPi / 9, kSeen = 1e-13;
  std::vector<CornerSample> corners;
  for (Index i = 0; i < outline.segments(); ++i) {
    const double turn = turn_at(outline, i);
    if (std::abs(turn) < kLeastTurn) continue;
    double length = outline.length_at(i, 0);
    if (length < start) length += outline.length();
    const double sharpness = std::abs(turn) / std::max(kPi - turn, 0.05);
    corners.push_back({length, sharpness, turn > 0 ? std::pow(kSeen, 1 / (1 + sharpness)) : 0});
  }
  std::ranges::sort(corners, {}, &CornerSample::length);
  return corners;
}

/// The target distance between samples.
class Spacing {
 public:
  Spacing(const Polyline& outline, Index count, double least)
      : thickness_(outline),
        length_(outline.length()),
        most_(length_ / static_cast<double>(count)),
        least_(least * length_) {}

  /// The spacing at an arc length between two corners.
  double operator()(double length, const CornerSample& before, const CornerSample& after) const {
    double spacing = std::min(most_, kThicknessFraction * thickness_(length));
    spacing = std::min(spacing, spacing_ratio(before) * (length - before.length));
    spacing = std::min(spacing, spacing_ratio(after) * (after.length - length));
    constexpr double kEverywhere = 1e-5;  // rounding never coarsens the spacing beyond this
    const double lost = std::min(std::max(before.least, after.least), kEverywhere) * length_;
    return std::max({spacing, least_, lost});
  }

 private:
  /// The spacing as a fraction of the distance from a corner.
  static double spacing_ratio(const CornerSample& corner) {
    constexpr double kOfRightAngle = 0.3, kFinest = 0.12;
    if (corner.sharpness <= 0) return INFINITY;
    return std::max(kOfRightAngle / corner.sharpness, kFinest);
  }

  Thickness thickness_;
  double length_, most_, least_;
};

/// Appends the lengths from one corner, or from the start, to the next corner, which is excluded.
void append(const Spacing& spacing, const CornerSample& from, const CornerSample& to,
            std::vector<double>& lengths) {
  constexpr double kStep = 0.25;  // step of the integration, as a fraction of the spacing
  std::vector<double> at{from.length}, sum{0};
  while (at.back() < to.length) {
    const double h = spacing(at.back(), from, to),
                 step = std::min(kStep * h, to.length - at.back());
    sum.push_back(sum.back() + step / spacing(at.back() + 0.5 * step, from, to));
    at.push_back(step < kStep * h ? to.length : at.back() + step);
  }
  const int parts = std::max(1, static_cast<int>(std::ceil(sum.back())));
  size_t i = 0;
  for (int k = 0; k < parts; ++k) {
    const double wanted = sum.back() * k / parts;
    while (i + 2 < sum.size() && sum[i + 1] <= wanted) ++i;
    lengths.push_back(at[i] + (wanted - sum[i]) / (sum[i + 1] - sum[i]) * (at[i + 1] - at[i]));
  }
}

}  // namespace

std::vector<double> corners_of(const Polyline& curve) {
  std::vector<double> corners;
  for (Index i = 0; i < curve.segments(); ++i)
    if (std::abs(turn_at(curve, i)) > kCorner) corners.push_back(curve.length_at(i, 0));
  return corners;
}

Thickness::Thickness(const Polyline& outline) : length_(outline.length()) {
  const size_t n = kThicknessPoints;
  const Points points = at_equal_lengths(outline, kThicknessPoints);
  for (size_t i = 0; i < n; ++i) {
    const Complex chord = points[(i + 1) % n] - points[(i + n - 1) % n];
    const Complex normal = kI * chord / std::max(std::abs(chord), 1e-300);
    double least = INFINITY;
    for (const Complex& point : points) {
      const double across = std::abs(dot(normal, point - points[i])),
                   square = std::norm(point - points[i]);
      if (square < 2 * least * across) least = 0.5 * square / across;
    }
    radii_.push_back(least);
  }
}

double Thickness::operator()(double length) const {
  const double turn = length / length_, place = (turn - std::floor(turn)) * kThicknessPoints;
  const size_t i = static_cast<size_t>(place) % kThicknessPoints;
  return std::min(radii_[i], radii_[(i + 1) % kThicknessPoints]);
}

double turn_at(const Polyline& outline, Index vertex) {
  const Points& points = outline.points();
  const size_t n = points.size(), k = static_cast<size_t>(vertex);
  return std::arg((points[(k + 1) % n] - points[k]) / (points[k] - points[(k + n - 1) % n]));
}

std::vector<double> graded_lengths(const Polyline& outline, double start, Index count,
                                   double least) {
  const Spacing spacing(outline, count, least);
  std::vector<CornerSample> ends{{start, 0}};
  const double tiny = 0.1 * least * outline.length();
  for (const CornerSample& corner : corners_from(outline, start)) {
    if (corner.length - ends.back().length > tiny)
      ends.push_back(corner);
    else
      ends.back().sharpness = std::max(ends.back().sharpness, corner.sharpness);
  }
  ends.push_back(ends.front());
  ends.back().length += outline.length();
  if (ends.size() > 2 && ends.back().length - ends[ends.size() - 2].length <= tiny)
    ends.erase(ends.end() - 2);
  std::vector<double> lengths;
  for (size_t i = 0; i + 1 < ends.size(); ++i) append(spacing, ends[i], ends[i + 1], lengths);
  return lengths;
}

}  // namespace holomorph
