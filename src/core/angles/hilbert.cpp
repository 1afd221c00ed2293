// The real parts are fitted by least squares at points along the boundary, which are denser near
// corners.
#include "core/angles/hilbert.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/arithmetic.h"
#include "core/cauchy/cauchy_array.h"
#include "core/cauchy/quadrature.h"
#include "core/geometry/deepest_point.h"
#include "core/solvers/dense.h"

namespace holomorph {
namespace {

constexpr int kDegree = 3, kSamplesPerPiece = 16;  ///< per piece
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

Complex logarithmic_slope(Complex at, Complex tip, Complex z) {
  return 1.0 / (z - at) - 1.0 / (z - tip);
}

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
  correction_weights_ =
      (parts_.linear.transpose() * parts_.linear).ldlt().solve(parts_.linear.transpose());
  const auto bends = [&](Index vertex) { return std::abs(angle(vertex) - kPi) > kFlatTurn; };
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
  log_coefficients_ = MatrixXc::Zero(n, parts_.jumps.cols());
  for (Index j = 0; j < n; ++j) {
    const Points before = cage_.controls(cage_.before(j)), after = cage_.controls(j);
    const Complex out = after[1] - after[0], in = before.back() - before[before.size() - 2];
    Vertex vertex{after[0], 0, std::arg(-in / out), {}, {}};
    if (vertex.angle <= 0) vertex.angle += 2 * kPi;
    vertex.tip = tip_of(outline, vertex.at,
                        -out / std::abs(out) * std::polar(1.0, vertex.angle / 2), vertex.angle);
    vertex.powers = powers_of(vertex.angle);
    vertex.powers.resize(std::min(vertex.powers.size(), kMostPowers));
    for (const double power : vertex.powers) {
      const auto lower = std::ranges::find_if(
          vertex.powers, [power](double other) { return std::abs(other + 1 - power) < 1e-6; });
      vertex.lower.push_back(
          lower == vertex.powers.end() ? -1 : static_cast<int>(lower - vertex.powers.begin()));
    }
    // The logarithm's imaginary part decreases by the inner angle as the boundary passes the
    // vertex.
    log_coefficients_.row(j) = kI / vertex.angle * parts_.jumps.row(j);
    vertices_.push_back(std::move(vertex));
  }
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

/// Fits all coordinates; returns each piece's largest error.
std::vector<double> HilbertCoordinates::solve(double tolerance) {
  boundary_ = {};
  std::vector<BoundaryPoint> samples, on_cage;
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (piece.from == 0 && std::ranges::binary_search(cage_.holes, piece.segment))
      boundary_.holes.push_back(boundary_.size());
    Points controls = part_of(cage_.controls(piece.segment), piece.from, piece.to);
    controls = elevated(controls, std::max(kDegree, static_cast<int>(controls.size()) - 1));
    controls.pop_back();
    boundary_.segments.push_back(std::move(controls));
    const auto add = [&](double t) {
      samples.push_back({static_cast<Index>(i), t});
      on_cage.push_back({piece.segment, piece.from + t * (piece.to - piece.from)});
    };
    for (int k = 0; k < kSamplesPerPiece; ++k) add((k + 0.5) / kSamplesPerPiece);
    for (int k = 1; k <= kCornerSamples; ++k) {
      const double near = std::pow(10.0, -k) / 3;
      if (piece.from == 0) add(near);
      if (piece.to == 1) add(1 - near);
    }
  }
  Points points;
  for (const BoundaryPoint& place : samples) points.push_back(position_of(boundary_, place));
  const MatrixXc basis = this->basis(points, 0);
  const MatrixXd targets =
      parts_.values(on_cage) - matrix_product(logarithms(points, 0), log_coefficients_).real();

  MatrixXd rows(basis.rows(), 2 * basis.cols());
  rows << basis.real(), -basis.imag();
  rows.rightCols(static_cast<Index>(hole_centers_.size())).setZero();  // not single-valued
  const VectorXd norms = rows.colwise().norm().cwiseMax(1e-300);
  rows *= norms.cwiseInverse().asDiagonal();
  MatrixXd gram = MatrixXd::Zero(rows.cols(), rows.cols());
  add_gram(rows.transpose(), rows.rows(), 0, gram);
  gram.diagonal().array() += 1e-14 * static_cast<double>(gram.rows());
  Cholesky cholesky;
  check(cholesky.factor(gram), "Hilbert coordinates: the normal equations are definite");
  MatrixXd x = cholesky.solve_all(transposed_matrix_product(rows, targets));
  MatrixXd off = targets - matrix_product(rows, x);
  // The normal equations lose digits. Refining them rarely spares a round.
  for (int refined = 0; refined < kRefinements && off.cwiseAbs().maxCoeff() > tolerance;
       ++refined) {
    x += cholesky.solve_all(transposed_matrix_product(rows, off));
    off = targets - matrix_product(rows, x);
  }
  std::vector<double> errors(pieces_.size(), 0);
  for (Index i = 0; i < off.rows(); ++i) {
    double& error = errors[static_cast<size_t>(samples[static_cast<size_t>(i)].segment)];
    error = std::max(error, off.row(i).cwiseAbs().maxCoeff());
  }
  x.array().colwise() /= norms.array();
  coefficients_ = x.topRows(basis.cols()) + kI * x.bottomRows(basis.cols());
  error_ = *std::ranges::max_element(errors);
  return errors;
}

HilbertCoordinates::Singular HilbertCoordinates::singular(const Vertex& vertex, Complex z) {
  const Complex ratio = quotient(z - vertex.at, z - vertex.tip);
  Singular at{{0.5 * std::log(std::norm(ratio)), std::atan2(ratio.imag(), ratio.real())}, {}};
  for (size_t k = 0; k < vertex.powers.size(); ++k) {
    const double power = vertex.powers[k];
    at.powers[k] = vertex.lower[k] >= 0
                       ? times(ratio, at.powers[static_cast<size_t>(vertex.lower[k])])
                       : std::polar(std::exp(power * at.log.real()), power * at.log.imag());
  }
  return at;
}

MatrixXc HilbertCoordinates::logarithms(std::span<const Complex> points, int order) const {
  MatrixXc values =
      MatrixXc::Zero(static_cast<Index>(points.size()), static_cast<Index>(vertices_.size()));
  for (size_t j = 0; j < vertices_.size(); ++j) {
    const Index column = static_cast<Index>(j);
    if (log_coefficients_.row(column).isZero(0)) continue;
    for (size_t i = 0; i < points.size(); ++i)
      values(static_cast<Index>(i), column) =
          order == 0 ? singular(vertices_[j], points[i]).log
                     : logarithmic_slope(vertices_[j].at, vertices_[j].tip, points[i]);
  }
  return values;
}

MatrixXc HilbertCoordinates::basis(std::span<const Complex> points, int order) const {
  const MatrixXc cauchy = as_complex(planar_coordinates<double>(boundary_, points, order));
  Index column = cauchy.cols(), powers = 0;
  for (const Vertex& vertex : vertices_) powers += static_cast<Index>(vertex.powers.size());
  const Index holes = static_cast<Index>(hole_centers_.size());
  MatrixXc basis(cauchy.rows(), cauchy.cols() + powers + holes);
  basis.leftCols(cauchy.cols()) = cauchy;
  for (const Vertex& vertex : vertices_) {
    for (size_t i = 0; i < points.size() && !vertex.powers.empty(); ++i) {
      const Singular at = singular(vertex, points[i]);
      const Complex slope = logarithmic_slope(vertex.at, vertex.tip, points[i]);
      for (size_t k = 0; k < vertex.powers.size(); ++k)
        basis(static_cast<Index>(i), column + static_cast<Index>(k)) =
            order == 0 ? at.powers[k] : vertex.powers[k] * slope * at.powers[k];
    }
    column += static_cast<Index>(vertex.powers.size());
  }
  for (const Complex& center : hole_centers_) {
    for (size_t i = 0; i < points.size(); ++i) {
      const Complex z = points[i] - center;
      basis(static_cast<Index>(i), column) = order == 0 ? std::log(z / size_) : inverse(z);
    }
    ++column;
  }
  return basis;
}

namespace {

constexpr size_t kBlock = 1024;  // rows of the basis that fit into the cache

/// Calls `visit` with the first row and the points of each block.
void for_each_block(std::span<const Complex> points,
                    const std::function<void(Index, std::span<const Complex>)>& visit) {
  for (size_t first = 0; first < points.size(); first += kBlock)
    visit(static_cast<Index>(first),
          points.subspan(first, std::min(kBlock, points.size() - first)));
}

}  // namespace

MatrixXc HilbertCoordinates::at(std::span<const Complex> points, int order) const {
  check(order == 0 || order == 1, "Hilbert coordinates: order 0 or 1");
  MatrixXc values(static_cast<Index>(points.size()), coefficients_.cols());
  for_each_block(points, [&](Index first, std::span<const Complex> some) {
    values.middleRows(first, static_cast<Index>(some.size())) = block(some, order);
  });
  return values;
}

MatrixXd HilbertCoordinates::real_parts(std::span<const Complex> points) const {
  const Index logs = log_coefficients_.rows(), all = logs + coefficients_.rows();
  MatrixXd factors(2 * all, coefficients_.cols());
  factors << log_coefficients_.real(), coefficients_.real(), -log_coefficients_.imag(),
      -coefficients_.imag();
  const MatrixXd linear = parts_.linear;
  MatrixXd parts(static_cast<Index>(points.size()), coefficients_.cols());
  for_each_block(points, [&](Index first, std::span<const Complex> some) {
    MatrixXc functions(static_cast<Index>(some.size()), all);
    functions << logarithms(some, 0), basis(some, 0);
    MatrixXd halves(functions.rows(), 2 * all);
    halves << functions.real(), functions.imag();
    const MatrixXd values = matrix_product(halves, factors);
    const MatrixXd missing = linear_functions(some, 0).real() - values * linear;
    parts.middleRows(first, values.rows()) = values + missing * correction_weights_;
  });
  return parts;
}

MatrixXc HilbertCoordinates::block(std::span<const Complex> points, int order) const {
  const MatrixXc values = matrix_product(logarithms(points, order), log_coefficients_) +
                          matrix_product(basis(points, order), coefficients_);
  const MatrixXc missing = linear_functions(points, order) - values * parts_.linear;
  return values + missing * correction_weights_;
}

// With v = at(points) and the weights w, block() gives v w + (exact - v linear) c, where c are the
// corrected sums. This is v (w - linear c) + exact c.
HilbertCoordinates::Sum HilbertCoordinates::sum(const VectorXd& weights) const {
  const VectorXd corrected = correction_weights_ * weights,
                 left = weights - parts_.linear * corrected;
  return {log_coefficients_ * left, coefficients_ * left, corrected};
}

VectorXc HilbertCoordinates::values(std::span<const Complex> points, const Sum& sum) const {
  VectorXc values(static_cast<Index>(points.size()));
  const Index smooth = boundary_.control_count();
  const VectorXc on_boundary = sum.basis.head(smooth);
  for_each_block(points, [&](Index first, std::span<const Complex> some) {
    values.segment(first, static_cast<Index>(some.size())) =
        product(planar_coordinates<double>(boundary_, some), on_boundary) +
        linear_functions(some, 0) * sum.linear;
  });
  Index column = smooth;
  for (size_t j = 0; j < vertices_.size(); ++j) {
    const Vertex& vertex = vertices_[j];
    const Complex jump = sum.logarithms[static_cast<Index>(j)];
    const Index powers = static_cast<Index>(vertex.powers.size());
    for (size_t i = 0; i < points.size() && (jump != Complex(0) || powers > 0); ++i) {
      const Singular at = singular(vertex, points[i]);
      Complex here = jump == Complex(0) ? jump : times(jump, at.log);
      for (Index k = 0; k < powers; ++k)
        here += times(sum.basis[column + k], at.powers[static_cast<size_t>(k)]);
      values[static_cast<Index>(i)] += here;
    }
    column += powers;
  }
  for (const Complex& center : hole_centers_) {
    for (size_t i = 0; i < points.size(); ++i)
      values[static_cast<Index>(i)] += sum.basis[column] * std::log((points[i] - center) / size_);
    ++column;
  }
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
