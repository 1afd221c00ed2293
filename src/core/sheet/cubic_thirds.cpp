#include "core/sheet/cubic_thirds.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/arithmetic.h"

namespace holomorph {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// A quadratic's Bezier points: at (i, j, k) with i + j + k = 2, in the order (2, 0, 0), (0, 2, 0),
/// (0, 0, 2), (1, 1, 0), (0, 1, 1), (1, 0, 1).
using Quadratic = std::array<Complex, 6>;
constexpr std::array<std::array<int, 2>, 6> kQuadratic{
    {{2, 0}, {0, 2}, {0, 0}, {1, 1}, {0, 1}, {1, 0}}};

Complex value_at(const Quadratic& q, double u, double v, double w) {
  return u * u * q[0] + v * v * q[1] + w * w * q[2] +
         2.0 * (u * v * q[3] + v * w * q[4] + w * u * q[5]);
}

/// The halves of a quadratic at the middle of its edge between the first two corners. Corners are
/// in turn, so that repeated halving cuts all edges.
std::array<Quadratic, 2> halves(const Quadratic& q) {
  const Complex a = 0.5 * (q[0] + q[3]), b = 0.5 * (q[1] + q[3]), middle = 0.5 * (a + b),
                inner = 0.5 * (q[5] + q[4]);
  // Corners (third, first, middle) and (second, third, middle).
  return {Quadratic{q[2], q[0], middle, q[5], a, inner}, {q[1], q[2], middle, q[4], inner, b}};
}

/// The derivatives of a map in a triangle: both are quadratics.
struct Slopes2 {
  Quadratic fz, fzbar;
};

/// The derivatives of a cubic on a triangle.
Slopes2 slopes_of(const TriangleCubic& cubic, const std::array<Complex, 3>& corners) {
  const auto [a, b, c] = corners;
  const double area = 0.5 * cross(b - a, c - a);
  const std::array<Complex, 3> weights{-kI * std::conj(c - b) / (4 * area),
                                       -kI * std::conj(a - c) / (4 * area),
                                       -kI * std::conj(b - a) / (4 * area)};
  Slopes2 slopes;
  for (size_t k = 0; k < 6; ++k) {
    const auto [i, j] = kQuadratic[k];
    const Complex u = cubic(i + 1, j), v = cubic(i, j + 1), w = cubic(i, j);
    slopes.fz[k] = 3.0 * (times(weights[0], u) + times(weights[1], v) + times(weights[2], w));
    slopes.fzbar[k] = 3.0 * (times(std::conj(weights[0]), u) + times(std::conj(weights[1]), v) +
                             times(std::conj(weights[2]), w));
  }
  return slopes;
}

/// The Bernstein coefficients, of degree four, of |q|^2: by pairs of the coefficients of q.
std::array<double, 15> squared(const Quadratic& q) {
  const auto at = [&](size_t i, size_t j) { return dot(q[i], q[j]); };
  const auto norm = [&](size_t i) { return std::norm(q[i]); };
  return {norm(0),
          norm(1),
          norm(2),
          at(0, 3),
          at(1, 3),
          at(1, 4),
          at(2, 4),
          at(2, 5),
          at(0, 5),
          (at(0, 1) + 2 * norm(3)) / 3,
          (at(1, 2) + 2 * norm(4)) / 3,
          (at(2, 0) + 2 * norm(5)) / 3,
          (at(0, 4) + 2 * at(3, 5)) / 3,
          (at(1, 5) + 2 * at(3, 4)) / 3,
          (at(2, 3) + 2 * at(4, 5)) / 3};
}

/// The smaller stretch is determinant over larger stretch.
StretchBounds stretch_bounds_of(const Slopes2& slopes) {
  const auto a = squared(slopes.fz), b = squared(slopes.fzbar);
  const auto [least_a, most_a] = std::ranges::minmax(a);
  const double most_b = std::ranges::max(b);
  StretchBounds bounds;
  bounds.least_determinant = a[0] - b[0];
  for (size_t k = 1; k < a.size(); ++k)
    bounds.least_determinant = std::min(bounds.least_determinant, a[k] - b[k]);
  bounds.largest = std::sqrt(std::max(0.0, most_a)) + std::sqrt(std::max(0.0, most_b));
  bounds.shear = least_a > 0 ? std::sqrt(std::max(0.0, most_b) / least_a) : kUnbounded;
  bounds.smallest = std::max(bounds.least_determinant / bounds.largest,
                             std::sqrt(std::max(0.0, least_a)) - std::sqrt(std::max(0.0, most_b)));
  return bounds;
}

/// What is attained at a piece's corners, where the coefficients are the derivatives.
StretchBounds at_corners(const Slopes2& piece) {
  StretchBounds attained;
  for (size_t k = 0; k < 3; ++k) {
    const double a = std::abs(piece.fz[k]), b = std::abs(piece.fzbar[k]);
    attained.smallest = std::min(attained.smallest, a - b);
    attained.largest = std::max(attained.largest, a + b);
    attained.shear = std::max(attained.shear, b / a);
    attained.least_determinant = std::min(attained.least_determinant, a * a - b * b);
  }
  return attained;
}

/// Which of a triangle's thirds contains a point with these barycentric coordinates, and its
/// coordinates there.
struct InThird {
  size_t third;
  double u, v, w;
};
InThird third_at(const std::array<double, 3>& weights) {
  const size_t k = static_cast<size_t>(std::ranges::min_element(weights) - weights.begin());
  return {k, weights[(k + 1) % 3] - weights[k], weights[(k + 2) % 3] - weights[k], 3 * weights[k]};
}

/// Whether |f_z| > |f_zbar| is proved in a piece, where both are known up to `error`.
bool is_positive(const Slopes2& slopes, double error, int depth) {
  const auto a = squared(slopes.fz), b = squared(slopes.fzbar);
  const double size = std::sqrt(std::max(0.0, std::ranges::max(a))),
               slack = 4 * error * (size + error);
  double least = a[0] - b[0];
  for (size_t k = 1; k < a.size(); ++k) least = std::min(least, a[k] - b[k]);
  if (least > slack) return true;
  for (size_t k = 0; k < 3; ++k)
    if (a[k] - b[k] <= slack) return false;  // at a corner, where the coefficient is attained
  if (depth == 0) return false;
  const auto fz = halves(slopes.fz), fzbar = halves(slopes.fzbar);
  return is_positive({fz[0], fzbar[0]}, error, depth - 1) &&
         is_positive({fz[1], fzbar[1]}, error, depth - 1);
}

}  // namespace

/// Continuity determines the Bezier points that are not on an edge.
CubicThirds::CubicThirds(const std::array<SmoothCorner, 3>& corners)
    : z_{corners[0].z, corners[1].z, corners[2].z}, center_((z_[0] + z_[1] + z_[2]) / 3.0) {
  std::array<Complex, 3> to_center, across, near_center;
  for (size_t k = 0; k < 3; ++k)
    to_center[k] = corners[k].f + corners[k].along((center_ - corners[k].z) / 3.0);
  for (size_t k = 0; k < 3; ++k) {
    const SmoothCorner &a = corners[(k + 1) % 3], &b = corners[(k + 2) % 3];
    const Complex ab = a.f + a.along((b.z - a.z) / 3.0), ba = b.f + b.along((a.z - b.z) / 3.0);
    // The foot of the center on the edge is s a + t b.
    const double t = dot(center_ - a.z, b.z - a.z) / std::norm(b.z - a.z), s = 1 - t;
    const Complex at_a = to_center[(k + 1) % 3] - s * a.f - t * ab,
                  at_b = to_center[(k + 2) % 3] - s * ba - t * b.f;
    across[k] = s * ab + t * ba + 0.5 * (at_a + at_b);
    thirds_[k](3, 0) = a.f;
    thirds_[k](2, 1) = ab;
    thirds_[k](1, 2) = ba;
    thirds_[k](0, 3) = b.f;
    thirds_[k](2, 0) = to_center[(k + 1) % 3];
    thirds_[k](0, 2) = to_center[(k + 2) % 3];
    thirds_[k](1, 1) = across[k];
  }
  for (size_t k = 0; k < 3; ++k)
    near_center[k] = (to_center[k] + across[(k + 1) % 3] + across[(k + 2) % 3]) / 3.0;
  const Complex middle = (near_center[0] + near_center[1] + near_center[2]) / 3.0;
  for (size_t k = 0; k < 3; ++k) {
    thirds_[k](1, 0) = near_center[(k + 1) % 3];
    thirds_[k](0, 1) = near_center[(k + 2) % 3];
    thirds_[k](0, 0) = middle;
  }
}

PointMap::Value CubicThirds::at(const std::array<double, 3>& weights) const {
  const auto [third, u, v, w] = third_at(weights);
  const Slopes2 slopes = slopes_of(thirds_[third], corners_of(third));
  return {thirds_[third].at(u, v, w), value_at(slopes.fz, u, v, w),
          value_at(slopes.fzbar, u, v, w)};
}

void StretchBounds::include(const StretchBounds& other) {
  smallest = std::min(smallest, other.smallest);
  largest = std::max(largest, other.largest);
  shear = std::max(shear, other.shear);
  least_determinant = std::min(least_determinant, other.least_determinant);
}

StretchBounds CubicThirds::attained() const {
  StretchBounds attained;
  for (size_t k = 0; k < 3; ++k) attained.include(at_corners(slopes_of(thirds_[k], corners_of(k))));
  return attained;
}

StretchBounds CubicThirds::bounds(int depth, const StretchBounds& elsewhere) const {
  std::vector<Slopes2> pieces;
  for (size_t k = 0; k < 3; ++k) pieces.push_back(slopes_of(thirds_[k], corners_of(k)));
  StretchBounds bounds;
  constexpr double kTolerance = 0.01;
  for (int level = 0; !pieces.empty(); ++level) {
    std::vector<Slopes2> finer;
    for (const Slopes2& piece : pieces) {
      const StretchBounds own = stretch_bounds_of(piece);
      StretchBounds known = elsewhere;
      known.include(at_corners(piece));
      const bool is_tight =
          own.least_determinant > 0 && own.smallest >= (1 - kTolerance) * known.smallest &&
          own.largest <= (1 + kTolerance) * known.largest && own.shear <= known.shear + kTolerance;
      if (is_tight || level == depth) {
        bounds.include(own);
        continue;
      }
      const auto fz = halves(piece.fz), fzbar = halves(piece.fzbar);
      for (size_t half = 0; half < 2; ++half) finer.push_back({fz[half], fzbar[half]});
    }
    pieces = std::move(finer);
  }
  return bounds;
}

bool CubicThirds::is_positive() const {
  constexpr int kDepth = 8;
  constexpr double kRounding = 1e-14;
  double coordinate = 0, side = kUnbounded;
  for (size_t k = 0; k < 3; ++k) {
    coordinate = std::max({coordinate, std::abs(z_[k]), std::abs(thirds_[k](3, 0))});
    side = std::min(side, std::abs(z_[(k + 1) % 3] - z_[k]));
  }
  for (size_t k = 0; k < 3; ++k)
    if (!holomorph::is_positive(slopes_of(thirds_[k], corners_of(k)), kRounding * coordinate / side,
                                kDepth))
      return false;
  return true;
}

void CubicThirds::straighten(const std::array<double, 3>& edges, double inside) {
  const std::array<Complex, 3> f{thirds_[2](3, 0), thirds_[0](3, 0), thirds_[1](3, 0)};
  const Complex middle = (f[0] + f[1] + f[2]) / 3.0;
  for (size_t k = 0; k < 3; ++k) {
    const Complex a = f[(k + 1) % 3], b = f[(k + 2) % 3];
    for (int i = 0; i <= 3; ++i)
      for (int j = 0; i + j <= 3; ++j) {
        const Complex linear = (static_cast<double>(i) * a + static_cast<double>(j) * b +
                                static_cast<double>(3 - i - j) * middle) /
                               3.0;
        const double by = i + j == 3 ? edges[k] : inside;
        thirds_[k](i, j) += by * (linear - thirds_[k](i, j));
      }
  }
}

std::array<Complex, 3> CubicThirds::directions(size_t corner) const {
  const TriangleCubic &next = thirds_[(corner + 2) % 3], &before = thirds_[(corner + 1) % 3];
  const Complex f = next(3, 0);
  return {next(2, 1) - f, next(2, 0) - f, before(1, 2) - f};
}

}  // namespace holomorph
