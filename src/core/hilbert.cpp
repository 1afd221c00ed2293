// Least squares for real parts at places along the boundary, denser towards corners.
#include "core/hilbert.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>

#include "core/cauchy.h"
#include "core/cauchy_array.h"
#include "core/dense.h"

namespace holomorph {
namespace {

constexpr int kDegree = 3, kPlaces = 16;  ///< of each piece
constexpr int kCornerPlaces = 4;
constexpr int kMostRounds = 7, kRefinements = 3;
constexpr double kHighestPower = 3.2, kFlat = 8 * kPi / 180;
constexpr size_t kMostPowers = 6;

/// How far a ray runs before it meets the polygon again; infinite when it never does.
double free_length(const Points& polygon, Complex from, Complex direction) {
  double nearest = INFINITY;
  const double least = 1e-9 * box_of(polygon).diagonal();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Complex a = polygon[i] - from, b = polygon[(i + 1) % polygon.size()] - from;
    const double side_a = cross(direction, a), side_b = cross(direction, b);
    if ((side_a > 0) == (side_b > 0)) continue;
    const double along = dot(direction, a + side_a / (side_a - side_b) * (b - a));
    if (along > least) nearest = std::min(nearest, along);
  }
  return nearest;
}

double distance_to(const Points& polygon, Complex z) {
  double least = INFINITY;
  for (size_t i = 0; i < polygon.size(); ++i)
    least = std::min(least,
                     nearest_on_segment(polygon[i], polygon[(i + 1) % polygon.size()], z).distance);
  return least;
}

/// A point outside, on the bisector of a vertex and as far from it as the rest of the boundary
/// leaves room.
Complex tip_of(const Points& polygon, Complex at, Complex outwards, double angle) {
  const double opening = std::sin(std::min(kPi - angle / 2, kPi / 2));
  double length =
      0.7 * std::min(free_length(polygon, at, outwards), 2 * box_of(polygon).diagonal());
  for (int shorter = 0; shorter < 60; ++shorter, length *= 0.8)
    if (distance_to(polygon, at + length * outwards) >= 0.6 * length * opening) break;
  return at + length * outwards;
}

/// The exponents that harmonic functions with smooth values on the sides of a wedge have at its
/// corner, but for whole ones.
std::vector<double> powers_of(double angle) {
  std::vector<double> powers;
  if (std::abs(angle - kPi) <= kFlat) return powers;
  for (double base = kPi / angle; base < kHighestPower; base += kPi / angle)
    for (double power = base; power < kHighestPower; ++power)
      if (std::abs(power - std::round(power)) > 1e-3) powers.push_back(power);
  std::ranges::sort(powers);
  powers.erase(std::unique(powers.begin(), powers.end(),
                           [](double a, double b) { return std::abs(a - b) < 1e-6; }),
               powers.end());
  powers.resize(std::min(powers.size(), kMostPowers));
  return powers;
}

}  // namespace

HilbertCoordinates::HilbertCoordinates(Points polygon, std::vector<Index> corners, double tolerance)
    : HilbertCoordinates(std::move(polygon), corners,
                         MatrixXd::Identity(2 * static_cast<Index>(corners.size()),
                                            2 * static_cast<Index>(corners.size())),
                         tolerance) {}

HilbertCoordinates::HilbertCoordinates(Points polygon, std::vector<Index> corners, MatrixXd sums,
                                       double tolerance)
    : polygon_(std::move(polygon)), corners_(std::move(corners)), sums_(std::move(sums)) {
  if (corners_.size() < 3)
    throw Error(ErrorKind::bad_input, "angles need three corners of the cage at least");
  check(std::ranges::is_sorted(corners_) && corners_.front() >= 0 &&
            corners_.back() < static_cast<Index>(polygon_.size()),
        "Hilbert coordinates: corners are vertices, in order");
  check(sums_.rows() == 2 * static_cast<Index>(corners_.size()),
        "Hilbert coordinates: two values for each corner");
  take_vertices();
  take_linear();
  const auto bends = [&](size_t vertex) {
    return std::abs(vertices_[vertex % vertices_.size()].angle - kPi) > kFlat;
  };
  for (size_t e = 0; e < polygon_.size(); ++e) {
    const Index edge = static_cast<Index>(e);
    if (bends(e) || bends(e + 1))
      pieces_.insert(pieces_.end(), {{edge, 0, 0.5}, {edge, 0.5, 1}});
    else
      pieces_.push_back({edge, 0, 1});
  }
  std::vector<double> errors = solve();
  for (int round = 0; round < kMostRounds && error_ > tolerance; ++round) {
    cut(errors, tolerance);
    errors = solve();
  }
}

void HilbertCoordinates::take_vertices() {
  const size_t n = polygon_.size();
  for (size_t j = 0; j < n; ++j) {
    const Complex out = polygon_[(j + 1) % n] - polygon_[j],
                  in = polygon_[j] - polygon_[(j + n - 1) % n];
    Vertex vertex{polygon_[j], 0, std::arg(-in / out), {}};
    if (vertex.angle <= 0) vertex.angle += 2 * kPi;
    vertex.tip = tip_of(polygon_, vertex.at,
                        -out / std::abs(out) * std::polar(1.0, vertex.angle / 2), vertex.angle);
    vertex.powers = powers_of(vertex.angle);
    vertices_.push_back(std::move(vertex));
  }
}

void HilbertCoordinates::cut(const std::vector<double>& errors, double tolerance) {
  const double most = std::max(tolerance / 2, error_ / 4);
  std::vector<Piece> finer;
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const auto& [edge, from, to] = pieces_[i];
    const double middle = 0.5 * (from + to);
    if (errors[i] > most)
      finer.insert(finer.end(), {{edge, from, middle}, {edge, middle, to}});
    else
      finer.push_back(pieces_[i]);
  }
  pieces_ = std::move(finer);
}

/// Fits all coordinates; returns each piece's largest error.
std::vector<double> HilbertCoordinates::solve() {
  boundary_ = {};
  std::vector<BoundaryPoint> places, on_polygon;
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    const Complex a = polygon_[static_cast<size_t>(piece.edge)],
                  b = polygon_[static_cast<size_t>(piece.edge + 1) % polygon_.size()];
    Points& controls = boundary_.segments.emplace_back();
    for (int k = 0; k < kDegree; ++k)
      controls.push_back(a + (piece.from + (piece.to - piece.from) * k / kDegree) * (b - a));
    const auto add = [&](double t) {
      places.push_back({static_cast<Index>(i), t});
      on_polygon.push_back({piece.edge, piece.from + t * (piece.to - piece.from)});
    };
    for (int k = 0; k < kPlaces; ++k) add((k + 0.5) / kPlaces);
    for (int k = 1; k <= kCornerPlaces; ++k) {
      const double near = std::pow(10.0, -k) / 3;
      if (piece.from == 0) add(near);
      if (piece.to == 1) add(1 - near);
    }
  }
  Points points;
  for (const BoundaryPoint& place : places) points.push_back(position_of(boundary_, place));
  const MatrixXc basis = this->basis(points, 0);
  const MatrixXd wanted = boundary_values(on_polygon) - jumps(points, 0).real();

  MatrixXd rows(basis.rows(), 2 * basis.cols());
  rows << basis.real(), -basis.imag();
  const VectorXd norms = rows.colwise().norm().cwiseMax(1e-300);
  rows *= norms.cwiseInverse().asDiagonal();
  MatrixXd gram = MatrixXd::Zero(rows.cols(), rows.cols());
  add_gram(rows.transpose(), rows.rows(), 0, gram);
  gram.diagonal().array() += 1e-14 * static_cast<double>(gram.rows());
  Cholesky cholesky;
  check(cholesky.factor(gram), "Hilbert coordinates: the normal equations are definite");
  std::vector<double> errors(pieces_.size(), 0);
  coefficients_.resize(basis.cols(), wanted.cols());
  for (Index c = 0; c < wanted.cols(); ++c) {
    VectorXd x = cholesky.solve(transposed_product(rows, wanted.col(c)));
    for (int refined = 0; refined < kRefinements; ++refined)
      x += cholesky.solve(transposed_product(rows, wanted.col(c) - product(rows, x)));
    const VectorXd off = (product(rows, x) - wanted.col(c)).cwiseAbs();
    for (Index i = 0; i < off.size(); ++i) {
      double& error = errors[static_cast<size_t>(places[static_cast<size_t>(i)].segment)];
      error = std::max(error, off[i]);
    }
    x.array() /= norms.array();
    coefficients_.col(c) = x.head(basis.cols()) + kI * x.tail(basis.cols());
  }
  error_ = *std::ranges::max_element(errors);
  return errors;
}

Complex HilbertCoordinates::logarithm(const Vertex& vertex, Complex z) const {
  return std::log((z - vertex.at) / (z - vertex.tip));
}

Complex HilbertCoordinates::logarithmic_slope(const Vertex& vertex, Complex z) const {
  return 1.0 / (z - vertex.at) - 1.0 / (z - vertex.tip);
}

// Along the boundary the logarithm's imaginary part falls by the inner angle at its vertex.
MatrixXc HilbertCoordinates::jumps(std::span<const Complex> points, int order) const {
  MatrixXc values = MatrixXc::Zero(static_cast<Index>(points.size()), sums_.cols());
  for (size_t j = 0; j < corners_.size(); ++j) {
    const Vertex& vertex = vertices_[static_cast<size_t>(corners_[j])];
    const Index row = 2 * static_cast<Index>(j);
    const Eigen::RowVectorXd jump = (sums_.row(row + 1) - sums_.row(row)) / vertex.angle;
    if (jump.isZero(0)) continue;
    for (size_t i = 0; i < points.size(); ++i)
      values.row(static_cast<Index>(i)) +=
          kI * (order == 0 ? logarithm(vertex, points[i]) : logarithmic_slope(vertex, points[i])) *
          jump;
  }
  return values;
}

MatrixXc HilbertCoordinates::basis(std::span<const Complex> points, int order) const {
  MatrixXc cauchy = as_complex(planar_coordinates<double>(boundary_, points, order));
  if (order > 0) {  // where pieces join, from just inside
    constexpr double kInside = 1e-7;
    for (Index e = 0; e < boundary_.size(); ++e)
      for (size_t i = 0; i < points.size(); ++i) {
        if (points[i] != boundary_.vertex(e)) continue;
        const Complex way = boundary_.vertex(e + 1) - boundary_.vertex(e),
                      beside = points[i] + kInside * kI * way;
        cauchy.row(static_cast<Index>(i)) =
            cauchy_coordinates(boundary_, std::span<const Complex>(&beside, 1), order);
      }
  }
  Index column = cauchy.cols(), powers = 0;
  for (const Vertex& vertex : vertices_) powers += static_cast<Index>(vertex.powers.size());
  MatrixXc basis(cauchy.rows(), cauchy.cols() + powers);
  basis.leftCols(cauchy.cols()) = cauchy;
  for (const Vertex& vertex : vertices_) {
    for (size_t i = 0; i < points.size() && !vertex.powers.empty(); ++i) {
      const Complex log = logarithm(vertex, points[i]),
                    slope = logarithmic_slope(vertex, points[i]);
      for (size_t k = 0; k < vertex.powers.size(); ++k) {
        const double power = vertex.powers[k];
        const Complex value = std::exp(power * log);
        basis(static_cast<Index>(i), column + static_cast<Index>(k)) =
            order == 0 ? value : power * slope * value;
      }
    }
    column += static_cast<Index>(vertex.powers.size());
  }
  return basis;
}

MatrixXc HilbertCoordinates::at(std::span<const Complex> points, int order) const {
  check(order == 0 || order == 1, "Hilbert coordinates: order 0 or 1");
  MatrixXc values = jumps(points, order) + basis(points, order) * coefficients_;
  if (linear_.size() == 0) return values;
  Eigen::MatrixX3cd missing(values.rows(), 3);
  for (Index i = 0; i < values.rows(); ++i) {
    const Complex z = points[static_cast<size_t>(i)];
    if (order == 0)
      missing.row(i) << 1, z, -kI * z;
    else
      missing.row(i) << 0, 1, -kI;
  }
  missing -= values * linear_;
  return values + missing * shares_;
}

// 1, x and y are linear along straight edges: they are the real parts of 1, z and -i z.
void HilbertCoordinates::take_linear() {
  if (corners_.size() < polygon_.size()) return;
  MatrixXd at_corners(sums_.rows(), 3);
  for (Index i = 0; i < at_corners.rows(); ++i) {
    const Complex z = polygon_[static_cast<size_t>(i / 2)];
    at_corners.row(i) << 1, z.real(), z.imag();
  }
  const MatrixXd columns = sums_.colPivHouseholderQr().solve(at_corners);
  const double rounding = 1e-10 * at_corners.cwiseAbs().maxCoeff();
  if (!((sums_ * columns - at_corners).cwiseAbs().maxCoeff() <= rounding)) return;
  linear_ = columns;
  shares_ = (columns.transpose() * columns).ldlt().solve(columns.transpose());
}

MatrixXd HilbertCoordinates::boundary_values(std::span<const BoundaryPoint> places) const {
  std::vector<double> lengths{0};
  for (size_t i = 0; i < polygon_.size(); ++i)
    lengths.push_back(lengths.back() + std::abs(polygon_[(i + 1) % polygon_.size()] - polygon_[i]));
  const size_t p = corners_.size();
  const auto length_at = [&](size_t corner) {
    return lengths[static_cast<size_t>(corners_[corner])];
  };
  MatrixXd values = MatrixXd::Zero(static_cast<Index>(places.size()), static_cast<Index>(2 * p));
  for (size_t i = 0; i < places.size(); ++i) {
    const auto& [edge, t] = places[i];
    const size_t e = static_cast<size_t>(edge);
    double here = lengths[e] + t * (lengths[e + 1] - lengths[e]);
    // The last corner at or before the edge.
    const auto after = std::ranges::upper_bound(corners_, edge);
    const size_t from =
                     static_cast<size_t>(after - corners_.begin() + static_cast<long>(p) - 1) % p,
                 to = (from + 1) % p;
    if (here < length_at(from)) here += lengths.back();
    const double whole = length_at(to) + (to <= from ? lengths.back() : 0) - length_at(from);
    const double share = (here - length_at(from)) / whole;
    values(static_cast<Index>(i), static_cast<Index>(2 * from + 1)) = 1 - share;
    values(static_cast<Index>(i), static_cast<Index>(2 * to)) = share;
  }
  return values * sums_;
}

}  // namespace holomorph
