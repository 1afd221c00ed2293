// The real parts are fitted by least squares at points along the boundary, which are denser near
// corners.
#include "core/angles/hilbert.h"

#include <Eigen/SparseCore>
#include <algorithm>

#include "core/cauchy/quadrature.h"
#include "core/error.h"
#include "core/geometry/deepest_point.h"
#include "core/parallel.h"
#include "core/solvers/dense.h"
#include "core/solvers/factors.h"

namespace holomorph {
namespace {

/// With half as many samples, the three complex unknowns of a piece would nearly interpolate them,
/// and errors between the samples would be fifty times larger.
constexpr int kDegree = 3, kSamplesPerPiece = 16;
constexpr int kCornerSamples = 4;
constexpr int kMaxRounds = 7, kRefinements = 3;
constexpr double kHighestPower = 3.2, kFlatTurn = 8 * kPi / 180;

/// The length of a ray up to its next intersection with the polygon, or infinity if there is none.
double free_length(PolygonView polygon, Complex from, Complex direction) {
  double nearest = INFINITY;
  const double least = 1e-9 * box_of(polygon.points()).diagonal();
  polygon.for_each_edge([&](Index, Complex start, Complex end) {
    const Complex a = start - from, b = end - from;
    const double side_a = cross(direction, a), side_b = cross(direction, b);
    if ((side_a > 0) == (side_b > 0)) return;
    const double along = dot(direction, a + side_a / (side_a - side_b) * (b - a));
    if (along > least) nearest = std::min(nearest, along);
  });
  return nearest;
}

/// A point outside the polygon on the bisector at a vertex, as far from the vertex as the rest of
/// the boundary allows.
Complex tip_of(PolygonView polygon, Complex at, Complex outwards, double angle) {
  const double opening = std::sin(std::min(kPi - angle / 2, kPi / 2));
  double length =
      0.7 * std::min(free_length(polygon, at, outwards), 2 * box_of(polygon.points()).diagonal());
  for (int shorter = 0; shorter < 60; ++shorter, length *= 0.8)
    if (nearest_on_polygon(polygon, at + length * outwards).distance >= 0.6 * length * opening)
      break;
  return at + length * outwards;
}

/// The non-integer exponents of a harmonic function at the corner of a wedge, if its values on both
/// sides of the wedge are smooth.
std::vector<double> powers_of(double angle) {
  std::vector<double> powers;
  if (std::abs(angle - kPi) <= kFlatTurn) return powers;
  for (double base = kPi / angle; base < kHighestPower; base += kPi / angle)
    for (double power = base; power < kHighestPower; ++power)
      if (std::abs(power - std::round(power)) > 1e-3) powers.push_back(power);
  std::ranges::sort(powers);
  powers.erase(std::unique(powers.begin(), powers.end(),
                           [](double a, double b) { return std::abs(a - b) < 1e-6; }),
               powers.end());
  return powers;
}

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The arc length of a segment from its start to the parameter t.
double length_to(const Points& controls, double t) {
  constexpr int kNodes = 24;
  if (controls.size() == 2) return t * std::abs(controls[1] - controls[0]);
  const double degree = static_cast<double>(controls.size() - 1);
  Points differences;
  for (size_t i = 0; i + 1 < controls.size(); ++i)
    differences.push_back(controls[i + 1] - controls[i]);
  const GaussRule& rule = gauss_rule(kNodes);
  double length = 0;
  for (size_t k = 0; k < kNodes; ++k)
    length += rule.weights[k] * std::abs(bezier_point(differences, t * rule.nodes[k]));
  return t * degree * length;
}

/// The part of a curve between two parameters.
Points part_of(const Points& controls, double from, double to) {
  const Points start = from > 0 ? split(controls, from).after : controls;
  return to < 1 ? split(start, (to - from) / (1 - from)).before : start;
}

}  // namespace

RealParts corner_values(const Cage& cage, const std::vector<Index>& corners) {
  if (corners.size() < 3)
    throw Error(ErrorKind::bad_input,
                "this method needs at least three corners; turn more cage vertices into corners");
  check(std::ranges::is_sorted(corners) && corners.front() >= 0 && corners.back() < cage.size(),
        "corner values: corners are vertices, in order");
  const Index p = static_cast<Index>(corners.size());
  std::vector<double> lengths{0};  // arc length up to each vertex
  for (Index e = 0; e < cage.size(); ++e)
    lengths.push_back(lengths.back() + length_to(cage.controls(e), 1));
  RealParts parts;
  parts.values = [cage, corners, lengths, p](std::span<const BoundaryPoint> samples) {
    MatrixXd values = MatrixXd::Zero(static_cast<Index>(samples.size()), 2 * p);
    const auto length_at = [&](Index corner) {
      return lengths[static_cast<size_t>(corners[static_cast<size_t>(corner)])];
    };
    for (size_t i = 0; i < samples.size(); ++i) {
      const auto& [segment, t] = samples[i];
      double here = lengths[static_cast<size_t>(segment)] + length_to(cage.controls(segment), t);
      // `from` is the last corner at or before the start of the segment.
      const Index after = std::ranges::upper_bound(corners, segment) - corners.begin(),
                  from = (after + p - 1) % p, to = (from + 1) % p;
      if (here < length_at(from)) here += lengths.back();
      const double whole = length_at(to) + (to <= from ? lengths.back() : 0) - length_at(from);
      const double fraction = (here - length_at(from)) / whole;
      values(static_cast<Index>(i), 2 * from + 1) = 1 - fraction;
      values(static_cast<Index>(i), 2 * to) = fraction;
    }
    return values;
  };
  parts.jumps = MatrixXd::Zero(cage.size(), 2 * p);
  parts.linear = MatrixXd::Ones(2 * p, p == cage.size() && is_straight(cage) ? 3 : 1);
  for (Index j = 0; j < p; ++j) {
    const Index vertex = corners[static_cast<size_t>(j)];
    parts.jumps(vertex, 2 * j) = -1;
    parts.jumps(vertex, 2 * j + 1) = 1;
    if (parts.linear.cols() == 1) continue;
    const Complex z = cage.vertex(vertex);
    for (const Index row : {2 * j, 2 * j + 1}) parts.linear.row(row) << 1, z.real(), z.imag();
  }
  return parts;
}

HilbertCoordinates::HilbertCoordinates(Cage cage, RealParts parts, double tolerance)
    : cage_(std::move(cage)), parts_(std::move(parts)) {
  set_up_vertices();
  linear_weights_ =
      solve_symmetric_all(parts_.linear.transpose() * parts_.linear, parts_.linear.transpose());
  for (Index e = 0; e < cage_.size(); ++e) {
    if (bends(e) || bends(cage_.next(e)) || cage_.degree(e) > 1)
      pieces_.insert(pieces_.end(), {{e, 0, 0.5}, {e, 0.5, 1}});
    else
      pieces_.push_back({e, 0, 1});
  }
  std::vector<double> errors = solve(tolerance);
  for (int round = 0; round < kMaxRounds && error_ > tolerance; ++round) {
    refine(errors, tolerance);
    errors = solve(tolerance);
  }
  // What is missing from the linear functions is added to all coordinates.
  coefficients_ -= (coefficients_ * parts_.linear) * linear_weights_;
}

bool HilbertCoordinates::bends(Index vertex) const {
  return std::abs(angle(vertex) - kPi) > kFlatTurn;
}

void HilbertCoordinates::set_up_vertices() {
  const Index n = cage_.size();
  const FlatCage outline = flattened(cage_);
  const PolygonView loops = outline;
  for (Index l = 1; l < loops.loops().count(); ++l) {
    const auto hole = loops.loop(l);
    hole_centers_.push_back(deepest_point(Polyline({hole.begin(), hole.end()}, true)));
  }
  size_ = box_of(outline).diagonal();
  std::vector<Index> jumping;
  for (Index j = 0; j < n; ++j) {
    const Points before = cage_.controls(cage_.before(j)), after = cage_.controls(j);
    const Complex out = after[1] - after[0], in = before.back() - before[before.size() - 2];
    Vertex vertex{after[0], 0, std::arg(-in / out), false, {}, {}};
    if (vertex.angle <= 0) vertex.angle += 2 * kPi;
    vertex.tip = tip_of(outline, vertex.at,
                        -out / std::abs(out) * std::polar(1.0, vertex.angle / 2), vertex.angle);
    vertex.powers = powers_of(vertex.angle);
    vertex.powers.resize(std::min(vertex.powers.size(), HilbertFunctions::kMostPowers));
    for (const double power : vertex.powers) {
      const auto lower = std::ranges::find_if(
          vertex.powers, [power](double other) { return std::abs(other + 1 - power) < 1e-6; });
      vertex.lower.push_back(
          lower == vertex.powers.end() ? -1 : static_cast<int>(lower - vertex.powers.begin()));
    }
    vertex.jumps = !parts_.jumps.row(j).isZero(0);
    if (vertex.jumps) jumping.push_back(j);
    vertices_.push_back(std::move(vertex));
  }
  // A logarithm's imaginary part decreases by the inner angle as the boundary passes the vertex.
  slopes_ = parts_.jumps(jumping, kAll);
  for (size_t k = 0; k < jumping.size(); ++k)
    slopes_.row(static_cast<Index>(k)) /= angle(jumping[k]);
}

void HilbertCoordinates::refine(const std::vector<double>& errors, double tolerance) {
  const double most = std::max(tolerance / 2, error_ / 4);
  std::vector<Piece> finer;
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const auto& [segment, from, to] = pieces_[i];
    const double middle = 0.5 * (from + to);
    if (errors[i] > most)
      finer.insert(finer.end(), {{segment, from, middle}, {segment, middle, to}});
    else
      finer.push_back(pieces_[i]);
  }
  pieces_ = std::move(finer);
}

/// Where the real parts are fitted.
struct HilbertCoordinates::Samples {
  std::vector<BoundaryPoint> on_pieces;  ///< the piece, and the parameter on it
  std::vector<BoundaryPoint> on_cage;
};

HilbertCoordinates::Samples HilbertCoordinates::samples() const {
  Samples samples;
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    const auto add = [&](double t) {
      samples.on_pieces.push_back({static_cast<Index>(i), t});
      samples.on_cage.push_back({piece.segment, piece.from + t * (piece.to - piece.from)});
    };
    for (int k = 0; k < kSamplesPerPiece; ++k) add((k + 0.5) / kSamplesPerPiece);
    for (int k = 1; k <= kCornerSamples; ++k) {
      const double near = std::pow(10.0, -k) / 3;
      if (piece.from == 0 && bends(piece.segment)) add(near);
      if (piece.to == 1 && bends(cage_.next(piece.segment))) add(1 - near);
    }
  }
  return samples;
}

Cage HilbertCoordinates::divided() const {
  Cage boundary;
  for (const auto& [segment, from, to] : pieces_) {
    if (from == 0 && std::ranges::binary_search(cage_.starts, segment))
      boundary.starts.push_back(boundary.size());
    Points controls = part_of(cage_.controls(segment), from, to);
    controls = elevated(controls, std::max(kDegree, static_cast<int>(controls.size()) - 1));
    controls.pop_back();
    boundary.segments.push_back(std::move(controls));
  }
  return boundary;
}

/// The functions at the samples, one column per sample.
struct HilbertCoordinates::Rows {
  MatrixXd unknowns;    ///< real parts, and below them, negative imaginary parts
  MatrixXd logarithms;  ///< imaginary parts of the logarithms at vertices, as many as there are
};

HilbertCoordinates::Rows HilbertCoordinates::rows_at(const Points& points) const {
  const Index count = static_cast<Index>(points.size()), unknowns = this->unknowns(),
              holes = static_cast<Index>(hole_centers_.size());
  Rows rows{MatrixXd(2 * unknowns, count), MatrixXd(static_cast<Index>(logarithms_.size()), count)};
  constexpr Index kBlock = 256;
  parallel_for(static_cast<int>((count + kBlock - 1) / kBlock), [&](int block) {
    const Index first = block * kBlock, size = std::min(kBlock, count - first);
    const MatrixXc values = functions_.values(
        std::span(points).subspan(static_cast<size_t>(first), static_cast<size_t>(size)), 0);
    rows.unknowns.block(0, first, unknowns, size) = values(kAll, unknowns_).real().transpose();
    rows.unknowns.block(unknowns, first, unknowns, size) =
        -values(kAll, unknowns_).imag().transpose();
    rows.logarithms.middleCols(first, size) = values(kAll, logarithms_).imag().transpose();
  });
  rows.unknowns.bottomRows(holes).setZero();  // not single-valued
  return rows;
}

/// Fits all coordinates; returns each piece's largest error.
std::vector<double> HilbertCoordinates::solve(double tolerance) {
  const Cage boundary = divided();
  functions_ = HilbertFunctions(boundary, vertices_, hole_centers_, size_);
  const Samples samples = this->samples();
  Points points;
  for (const BoundaryPoint& place : samples.on_pieces)
    points.push_back(position_of(boundary, place));
  set_up_columns();
  auto [rows, logarithms] = rows_at(points);
  // Each coordinate jumps at few vertices and is zero on most of the boundary.
  const SparseMatrix slopes = slopes_.sparseView(),
                     values = parts_.values(samples.on_cage).sparseView();
  const MatrixXd targets = logarithms.transpose() * slopes + MatrixXd(values);

  const VectorXd norms = rows.rowwise().norm().cwiseMax(1e-300);
  rows.array().colwise() /= norms.array();
  MatrixXd gram = MatrixXd::Zero(rows.rows(), rows.rows());
  add_gram(rows, rows.cols(), 0, gram);
  gram.diagonal().array() += 1e-14 * static_cast<double>(gram.rows());
  Cholesky cholesky;
  check(cholesky.factor(gram), "Hilbert coordinates: the normal equations are definite");
  const MatrixXd right = rows * values + matrix_product(rows, logarithms.transpose()) * slopes;
  MatrixXd x = cholesky.solve_all(right);
  MatrixXd off = targets - transposed_matrix_product(rows, x);
  // The normal equations lose digits. Refining them rarely spares a round.
  for (int refined = 0; refined < kRefinements && off.cwiseAbs().maxCoeff() > tolerance;
       ++refined) {
    x += cholesky.solve_all(matrix_product(rows, off));
    off = targets - transposed_matrix_product(rows, x);
  }
  std::vector<double> errors(pieces_.size(), 0);
  const VectorXd largest = off.rowwise().lpNorm<Eigen::Infinity>();
  for (Index i = 0; i < off.rows(); ++i) {
    double& error = errors[static_cast<size_t>(samples.on_pieces[static_cast<size_t>(i)].segment)];
    error = std::max(error, largest[i]);
  }
  x.array().colwise() /= norms.array();
  coefficients_.resize(functions_.count(), x.cols());
  coefficients_(unknowns_, kAll) = x.topRows(unknowns()) + kI * x.bottomRows(unknowns());
  coefficients_(logarithms_, kAll) = kI * slopes_;
  error_ = *std::ranges::max_element(errors);
  return errors;
}

void HilbertCoordinates::set_up_columns() {
  unknowns_.clear();
  logarithms_.clear();
  for (Index column = 0; column < functions_.count(); ++column)
    (functions_.is_logarithm(column) ? logarithms_ : unknowns_).push_back(column);
}

void HilbertCoordinates::for_each_group(std::span<const Complex> points, int order,
                                        const HilbertFunctions::VisitGroup& visit) const {
  check(order == 0 || order == 1, "Hilbert coordinates: order 0 or 1");
  functions_.for_each_group(points, coefficients_, order,
                            [&](const PointGroup& group, MatrixXc& sums) {
                              const MatrixXc exact = linear_functions(group.points, order);
                              sums.real() += exact.real() * linear_weights_;
                              sums.imag() += exact.imag() * linear_weights_;
                              visit(group, sums);
                            });
}

MatrixXc HilbertCoordinates::at(std::span<const Complex> points, int order) const {
  MatrixXc values(static_cast<Index>(points.size()), coefficients_.cols());
  for_each_group(points, order, [&](const PointGroup& group, const MatrixXc& rows) {
    values(group.indices, kAll) = rows;
  });
  return values;
}

HilbertCoordinates::Sum HilbertCoordinates::sum(const VectorXd& weights) const {
  return {coefficients_ * weights, linear_weights_ * weights};
}

VectorXc HilbertCoordinates::values(std::span<const Complex> points, const Sum& sum) const {
  VectorXc values = linear_functions(points, 0) * sum.linear;
  functions_.for_each_group(
      points, sum.functions, 0,
      [&](const PointGroup& group, const MatrixXc& sums) { values(group.indices) += sums.col(0); });
  return values;
}

MatrixXc HilbertCoordinates::linear_functions(std::span<const Complex> points, int order) const {
  MatrixXc functions(static_cast<Index>(points.size()), parts_.linear.cols());
  for (Index i = 0; i < functions.rows(); ++i) {
    const Complex z = points[static_cast<size_t>(i)];
    const std::array<Complex, 3> exact =
        order == 0 ? std::array<Complex, 3>{1, z, -kI * z} : std::array<Complex, 3>{0, 1, -kI};
    for (Index k = 0; k < functions.cols(); ++k) functions(i, k) = exact[static_cast<size_t>(k)];
  }
  return functions;
}

}  // namespace holomorph
