#include "core/sheet/smooth_map.h"

#include <algorithm>
#include <limits>
#include <map>

namespace holomorph {
namespace {

/// What determines the cubics of a triangle.
struct Corner {
  Complex z, f, fz, fzbar;
  Complex along(Complex d) const { return fz * d + fzbar * std::conj(d); }
};

/// The Bezier points of the thirds. Continuity determines those that are not on an edge.
CubicThirds cubics_of(const std::array<Corner, 3>& corners) {
  const Complex center = (corners[0].z + corners[1].z + corners[2].z) / 3.0;
  std::array<Complex, 3> to_center, across, near_center;
  for (size_t k = 0; k < 3; ++k)
    to_center[k] = corners[k].f + corners[k].along((center - corners[k].z) / 3.0);
  CubicThirds thirds;
  for (size_t k = 0; k < 3; ++k) {
    const Corner &a = corners[(k + 1) % 3], &b = corners[(k + 2) % 3];
    const Complex ab = a.f + a.along((b.z - a.z) / 3.0), ba = b.f + b.along((a.z - b.z) / 3.0);
    // The foot of the center on the edge is s a + t b.
    const double t = dot(center - a.z, b.z - a.z) / std::norm(b.z - a.z), s = 1 - t;
    const Complex at_a = to_center[(k + 1) % 3] - s * a.f - t * ab,
                  at_b = to_center[(k + 2) % 3] - s * ba - t * b.f;
    across[k] = s * ab + t * ba + 0.5 * (at_a + at_b);
    thirds[k](3, 0) = a.f;
    thirds[k](2, 1) = ab;
    thirds[k](1, 2) = ba;
    thirds[k](0, 3) = b.f;
    thirds[k](2, 0) = to_center[(k + 1) % 3];
    thirds[k](0, 2) = to_center[(k + 2) % 3];
    thirds[k](1, 1) = across[k];
  }
  for (size_t k = 0; k < 3; ++k)
    near_center[k] = (to_center[k] + across[(k + 1) % 3] + across[(k + 2) % 3]) / 3.0;
  const Complex middle = (near_center[0] + near_center[1] + near_center[2]) / 3.0;
  for (size_t k = 0; k < 3; ++k) {
    thirds[k](1, 0) = near_center[(k + 1) % 3];
    thirds[k](0, 1) = near_center[(k + 2) % 3];
    thirds[k](0, 0) = middle;
  }
  return thirds;
}

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

/// The derivatives of a cubic on a triangle with corners a, b and c.
Slopes2 slopes_of(const TriangleCubic& cubic, Complex a, Complex b, Complex c) {
  const double area = 0.5 * cross(b - a, c - a);
  const std::array<Complex, 3> weights{-kI * std::conj(c - b) / (4 * area),
                                       -kI * std::conj(a - c) / (4 * area),
                                       -kI * std::conj(b - a) / (4 * area)};
  Slopes2 slopes;
  for (size_t k = 0; k < 6; ++k) {
    const auto [i, j] = kQuadratic[k];
    const Complex u = cubic(i + 1, j), v = cubic(i, j + 1), w = cubic(i, j);
    slopes.fz[k] = 3.0 * (weights[0] * u + weights[1] * v + weights[2] * w);
    slopes.fzbar[k] =
        3.0 * (std::conj(weights[0]) * u + std::conj(weights[1]) * v + std::conj(weights[2]) * w);
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
StretchBounds bounds_of(const Slopes2& slopes) {
  const auto a = squared(slopes.fz), b = squared(slopes.fzbar);
  const auto [least_a, most_a] = std::ranges::minmax(a);
  const double most_b = std::ranges::max(b);
  StretchBounds bounds;
  bounds.least_determinant = a[0] - b[0];
  for (size_t k = 1; k < a.size(); ++k)
    bounds.least_determinant = std::min(bounds.least_determinant, a[k] - b[k]);
  bounds.largest = std::sqrt(std::max(0.0, most_a)) + std::sqrt(std::max(0.0, most_b));
  bounds.smallest = std::max(bounds.least_determinant / bounds.largest,
                             std::sqrt(std::max(0.0, least_a)) - std::sqrt(std::max(0.0, most_b)));
  return bounds;
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

}  // namespace

std::vector<std::pair<int, double>> smooth_row(const Mesh& mesh, const VertexGradients& gradients,
                                               const Location& location) {
  const Triangle& t = mesh.triangles[static_cast<size_t>(location.triangle)];
  const auto [third, u, v, w] = third_at(location.weights);
  std::array<Corner, 3> corners{};
  for (size_t k = 0; k < 3; ++k) corners[k].z = mesh.vertices[static_cast<size_t>(t[k])];
  const auto value = [&] { return cubics_of(corners)[third].at(u, v, w); };
  std::map<int, double> row;
  for (size_t k = 0; k < 3; ++k) {
    Corner& corner = corners[k];
    corner.f = 1;
    row[t[k]] += value().real();
    corner.f = 0;
    // The value is linear in f_x and f_y, with real weights.
    corner.fz = 0.5, corner.fzbar = 0.5;
    const double by_x = value().real();
    corner.fz = -0.5 * kI, corner.fzbar = 0.5 * kI;
    const double by_y = value().real();
    corner.fz = corner.fzbar = 0;
    using Weights = Eigen::SparseMatrix<Complex, Eigen::RowMajor>;
    for (Weights::InnerIterator at(gradients.weights(), t[k]); at; ++at)
      row[static_cast<int>(at.col())] += 2 * (by_x * at.value().real() - by_y * at.value().imag());
  }
  return {row.begin(), row.end()};
}

SmoothMap::SmoothMap(std::shared_ptr<const Mesh> mesh, const VectorXc& f, const VectorXc& fz,
                     const VectorXc& fzbar)
    : mesh_(std::move(mesh)), locator_(*mesh_) {
  for (const Triangle& t : mesh_->triangles) {
    std::array<Corner, 3> corners;
    for (size_t k = 0; k < 3; ++k)
      corners[k] = {mesh_->vertices[static_cast<size_t>(t[k])], f[t[k]], fz[t[k]], fzbar[t[k]]};
    cubics_.push_back(cubics_of(corners));
  }
}

PointMap::Value SmoothMap::at(Complex z) const {
  return at(locator_.near(z));
}

PointMap::Value SmoothMap::at(const Location& location) const {
  const Triangle& t = mesh_->triangles[static_cast<size_t>(location.triangle)];
  const auto [third, u, v, w] = third_at(location.weights);
  const auto corner = [&](size_t k) { return mesh_->vertices[static_cast<size_t>(t[k % 3])]; };
  const Complex center = (corner(0) + corner(1) + corner(2)) / 3.0;
  const TriangleCubic& cubic = cubics_[static_cast<size_t>(location.triangle)][third];
  const Slopes2 slopes = slopes_of(cubic, corner(third + 1), corner(third + 2), center);
  return {cubic.at(u, v, w), value_at(slopes.fz, u, v, w), value_at(slopes.fzbar, u, v, w)};
}

StretchBounds SmoothMap::bounds(size_t triangle, int depth) const {
  const Triangle& t = mesh_->triangles[triangle];
  const auto corner = [&](size_t k) { return mesh_->vertices[static_cast<size_t>(t[k % 3])]; };
  const Complex center = (corner(0) + corner(1) + corner(2)) / 3.0;
  std::vector<Slopes2> pieces;
  for (size_t k = 0; k < 3; ++k)
    pieces.push_back(slopes_of(cubics_[triangle][k], corner(k + 1), corner(k + 2), center));
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  StretchBounds bounds{kInfinite, 0, kInfinite};
  const auto include = [&](const StretchBounds& own) {
    bounds.smallest = std::min(bounds.smallest, own.smallest);
    bounds.largest = std::max(bounds.largest, own.largest);
    bounds.least_determinant = std::min(bounds.least_determinant, own.least_determinant);
  };
  // A piece need not be divided where its corners attain its bounds within a tolerance.
  constexpr double kTolerance = 0.01;
  for (int level = 0; !pieces.empty(); ++level) {
    std::vector<Slopes2> finer;
    for (const Slopes2& piece : pieces) {
      const StretchBounds own = bounds_of(piece);
      double smallest = kInfinite, largest = 0;
      for (size_t k = 0; k < 3; ++k) {
        const double a = std::abs(piece.fz[k]), b = std::abs(piece.fzbar[k]);
        smallest = std::min(smallest, a - b);
        largest = std::max(largest, a + b);
      }
      const bool is_tight = own.least_determinant > 0 &&
                            own.smallest >= (1 - kTolerance) * smallest &&
                            own.largest <= (1 + kTolerance) * largest;
      if (is_tight || level == depth) {
        include(own);
        continue;
      }
      const auto fz = halves(piece.fz), fzbar = halves(piece.fzbar);
      for (size_t half = 0; half < 2; ++half) finer.push_back({fz[half], fzbar[half]});
    }
    pieces = std::move(finer);
  }
  return bounds;
}

}  // namespace holomorph
