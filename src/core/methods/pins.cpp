// Method `pins`: f = f_cage + h, with h holomorphic and h(u_i) = v_i - f_cage(u_i). Of all such
// functions, h is the smoothest: it minimizes mean |h''|^2 over the boundary, sampled at the
// midpoints of straight edges (Segall, Ben-Chen 2016, E_s and E_p2p; Lin, Chen 2024, 4.5, for
// curved cages).
//
// With the energy's rows in QR form, R g = y, the minimizer is a combination of one function per
// pin, as for thin-plate splines: (M M* + ridge) lambda + T c = data, with M = P R^-1. P evaluates
// the basis at the pins, and T evaluates the affine maps, whose energy is 0. The ridge is positive
// for soft pins and 0 for exact pins. The system is only as large as the number of pins, and each
// pin adds one column to the operator.

#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "core/geometry/orientation.h"
#include "core/maps/acting_pins.h"
#include "core/methods/linear.h"
#include "core/methods/parameters.h"
#include "core/methods/rows.h"
#include "core/solvers/dense.h"
#include "core/solvers/factors.h"

namespace holomorph {
namespace {

constexpr int kBasisControls = 100;

/// The cage with long segments cut until it has about kBasisControls control points. The parts of
/// straight segments have degree 1.
Cage basis_cage(const Cage& cage) {
  const double step = perimeter(outline_of(cage)) / kBasisControls;
  Cage basis;
  for (Index e = 0; e < cage.size(); ++e) {
    if (std::ranges::binary_search(cage.starts, e)) basis.starts.push_back(basis.size());
    const Points ends{cage.vertex(e), cage.end_vertex(e)};
    Points controls = is_straight(cage, e) ? ends : cage.controls(e);
    const double controls_each = static_cast<double>(controls.size()) - 1;
    double length = 0;
    for (size_t m = 0; m + 1 < controls.size(); ++m)
      length += std::abs(controls[m + 1] - controls[m]);
    const int parts =
        cage.size() >= kBasisControls
            ? 1
            : std::max(1, static_cast<int>(std::lround(length / step / controls_each)));
    for (int left = parts; left > 1; --left) {
      SplitCurve halves = split(controls, 1.0 / left);
      halves.before.pop_back();
      basis.segments.push_back(std::move(halves.before));
      controls = std::move(halves.after);
    }
    controls.pop_back();
    basis.segments.push_back(std::move(controls));
  }
  return basis;
}

/// The points where smoothness is measured. Their number on each segment is the segment's degree.
/// They avoid the ends, where f'' has poles.
std::vector<BoundaryPoint> smoothness_points(const Cage& basis) {
  std::vector<BoundaryPoint> places;
  for (Index e = 0; e < basis.size(); ++e)
    for (int k = 0; k < basis.degree(e); ++k) places.push_back({e, (k + 0.5) / basis.degree(e)});
  return places;
}

/// Everything that does not depend on the pins: the basis at the samples and the energy's factor R.
template <class T>
struct PinBasis {
  Cage cage;
  Points samples;
  Cage basis;
  bool own;           ///< whether the basis is the cage itself
  double length = 1;  ///< L = perimeter / 2 pi, the unit of all energies
  PlanarMatrix<T> cage_value, value;
  std::vector<Index> kept;  ///< the independent columns of the basis
  MatrixXc factor;          ///< upper triangular R, for these columns

  PinBasis(const Rest& rest, bool own_controls)
      : cage(rest.cage),
        samples(rest.samples),
        basis(own_controls ? rest.cage : basis_cage(rest.cage)),
        own(own_controls) {
    length = perimeter(outline_of(basis)) / (2 * kPi);
    cage_value = planar_coordinates<T>(cage, samples, 0);
    value = planar_coordinates<T>(basis, samples, 0);
    kept = independent_controls(basis);
    const Index m = basis.control_count(), n = static_cast<Index>(kept.size());
    MatrixXc rows(m + 2, n);
    rows.topRows(m) = independent(cauchy_coordinates(basis, smoothness_points(basis), 2)) *
                      (length * length / std::sqrt(static_cast<double>(m)));
    // The energy of affine maps is zero; two rows at an inner point make R invertible. They do not
    // change the minimizer, because the affine part is solved for separately.
    const Complex anchor = inner_point();
    rows.row(m) = independent(cauchy_coordinates(basis, std::span(&anchor, 1), 0));
    rows.row(m + 1) = length * independent(cauchy_coordinates(basis, std::span(&anchor, 1), 1));
    factor = upper_factor(std::move(rows));
  }

  MatrixXc independent(const MatrixXc& rows) const {
    return kept.size() == static_cast<size_t>(rows.cols()) ? rows : rows(kAll, kept).eval();
  }

  /// Returns the grid point that is deepest inside the outline.
  Complex inner_point() const {
    const Polygon outline = outline_of(basis);
    const Box box = box_of(outline);
    Complex best;
    double depth = -1;
    constexpr int kGrid = 24;
    for (int i = 1; i < kGrid; ++i)
      for (int j = 1; j < kGrid; ++j) {
        const Complex z(box.left + box.width() * i / kGrid, box.bottom + box.height() * j / kGrid);
        if (!encloses(outline, z)) continue;
        if (const double here = nearest_on_polygon(outline, z).distance; here > depth)
          best = z, depth = here;
      }
    return depth > 0 ? best : 0.5 * (outline.points[0] + outline.points[1]);
  }
};

template <class T>
class PinsDeformer final : public LinearDeformer<T> {
 public:
  PinsDeformer(const Rest& rest, const PinsDeformer* previous, const Method& method)
      : LinearDeformer<T>(rest) {
    const bool own = parameter(method, rest.parameters, "own_controls") != 0;
    if (previous && previous->basis_->own == own && previous->basis_->cage == rest.cage &&
        previous->basis_->samples == rest.samples)
      basis_ = previous->basis_;
    else
      basis_ = std::make_shared<const PinBasis<T>>(rest, own);
    UsablePins acting = usable_pins(rest);
    used_ = std::move(acting.used);
    this->note_ = std::move(acting.note);
    cage_at_pins_.resize(0, rest.cage.control_count());
    if (used_.empty()) {
      this->value_ = basis_->cage_value;
      return;
    }
    solve(parameter(method, rest.parameters, "exact") != 0
              ? 0.0
              : parameter(method, rest.parameters, "smoothness") /
                    parameter(method, rest.parameters, "pin_weight"));
    PlanarMatrix<T> correction(basis_->value.rows(), coefficients_.re.cols());
    multiply(basis_->value, coefficients_, correction);
    add_affine(correction, rest.samples, 0);
    this->value_ = side_by_side(basis_->cage_value, correction);
  }

  VectorXc controls(const Pose& pose) const override {
    const VectorXc cage = cage_displacement(this->rest_, pose);
    VectorXc all(cage.size() + functionals());
    all.head(cage.size()) = cage;
    Index row = cage.size();
    const VectorXc base = cage_at_pins_ * cage;  // the value of each functional for the cage's map
    for (const size_t i : used_) all[row++] = pose.pins[i].position - this->rest_.pins[i].position;
    for (const size_t i : used_)
      if (this->rest_.pins[i].has_frame)
        all[row++] = basis_->length * (std::polar(pose.pins[i].scale, pose.pins[i].angle) - 1.0);
    all.tail(functionals()) -= base;
    return all;
  }
  std::optional<Cage> solved_cage(const Pose& pose) const override {
    if (!basis_->own) return {};
    const VectorXc all = controls(pose), rest = controls_of(this->rest_.cage);
    VectorXc places = rest + all.head(rest.size());
    if (functionals() > 0) {
      const VectorXc data = all.tail(functionals());
      places += coefficients() * data;
      places.array() += (affine_.row(0) * data)(0);
      if (affine_.rows() > 1)
        places.array() += (affine_.row(1) * data)(0) / basis_->length * (rest.array() - center_);
    }
    Cage cage = this->rest_.cage;
    Index i = 0;
    for (Points& segment : cage.segments)
      for (Complex& z : segment) z = places[i++];
    return cage;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    check_pose(this->rest_, pose);
    auto map = std::make_unique<SumMap>();
    const VectorXc all = controls(pose);
    map->terms.emplace_back(this->rest_.cage, all.head(all.size() - functionals()));
    if (functionals() == 0) return map;
    const VectorXc data = all.tail(functionals());
    map->terms.emplace_back(basis_->basis, coefficients() * data);
    map->constant = (affine_.row(0) * data)(0);
    if (affine_.rows() > 1) map->slope = (affine_.row(1) * data)(0) / basis_->length;
    map->center = center_;
    return map;
  }

 protected:
  PlanarMatrix<T> derivative_matrix() const override {
    const bool at_samples = this->rest_.derivative_samples.empty();
    const Points points = at_samples ? this->rest_.samples : inset(this->derivative_points());
    PlanarMatrix<T> cage = planar_coordinates<T>(this->rest_.cage, points, 1);
    if (used_.empty()) return cage;
    PlanarMatrix<T> correction(static_cast<Index>(points.size()), coefficients_.re.cols());
    multiply(planar_coordinates<T>(basis_->basis, points, 1), coefficients_, correction);
    add_affine(correction, points, 1);
    return side_by_side(cage, correction);
  }

 private:
  /// The basis has corners all along the boundary, where its derivatives have logarithmic poles.
  /// Points on the boundary represent their neighborhood, so they are moved inward by a fraction of
  /// the nearest segment's length.
  Points inset(Points points) const {
    constexpr double kOn = 0.05, kBy = 0.2;
    const Polygon loops = outline_of(oriented(basis_->basis), 4);
    const PolygonView outline = loops;
    for (Complex& z : points) {
      const NearestPoint near = nearest_on_polygon(outline, z);
      const Complex side = outline[outline.loops().next(near.edge)] - outline[near.edge];
      if (near.distance > kOn * std::abs(side)) continue;
      const Complex moved = z + kBy * kI * side;
      if (contains(basis_->basis, moved)) z = moved;
    }
    return points;
  }

  MatrixXc coefficients() const { return as_complex(coefficients_); }

  Index functionals() const { return cage_at_pins_.rows(); }

  /// Solves the system with unit data for each functional. The results are the coefficients of the
  /// basis and of the affine maps, one column per functional.
  void solve(double ridge_per_pin) {
    const auto& pins = this->rest_.pins;
    Points places, turning;
    for (const size_t i : used_) {
      places.push_back(pins[i].position);
      if (pins[i].has_frame) turning.push_back(pins[i].position);
    }
    const Index p = static_cast<Index>(places.size()), q = static_cast<Index>(turning.size()),
                m = p + q;
    const Cage& basis = basis_->basis;
    const double length = basis_->length;
    MatrixXc rows(m, static_cast<Index>(basis_->kept.size()));
    rows.topRows(p) = basis_->independent(cauchy_coordinates(basis, places, 0));
    cage_at_pins_.resize(m, this->rest_.cage.control_count());
    cage_at_pins_.topRows(p) = cauchy_coordinates(this->rest_.cage, places, 0);
    if (q > 0) {
      // At a vertex, derivatives are generally infinite, so planar_coordinates uses a point just
      // inside.
      const auto slopes = [&](const Cage& cage) {
        return as_complex(planar_coordinates<double>(cage, turning, 1));
      };
      rows.bottomRows(q) = length * basis_->independent(slopes(basis));
      cage_at_pins_.bottomRows(q) = length * slopes(this->rest_.cage);
    }
    // The affine maps 1 and (z - center) / L; a single pin without a frame uses only the first.
    const Index affine = m >= 2 ? 2 : 1;
    center_ = places[0];
    MatrixXc T_rows = MatrixXc::Zero(m, affine);
    for (Index i = 0; i < m; ++i) {
      T_rows(i, 0) = i < p ? 1 : 0;
      if (affine == 2) T_rows(i, 1) = i < p ? (places[i] - center_) / length : 1.0;
    }
    // M* = R^-* P*.
    const MatrixXc adjoint =
        basis_->factor.adjoint().template triangularView<Eigen::Lower>().solve(rows.adjoint());
    MatrixXc system = MatrixXc::Zero(m + affine, m + affine);
    system.topLeftCorner(m, m) = adjoint.adjoint() * adjoint;
    system.topLeftCorner(m, m).diagonal().array() += ridge_per_pin * static_cast<double>(m);
    system.topRightCorner(m, affine) = T_rows;
    system.bottomLeftCorner(affine, m) = T_rows.adjoint();
    MatrixXc data = MatrixXc::Zero(m + affine, m);
    data.topRows(m).setIdentity();
    const MatrixXc solution = solve_nearly_singular(system, data);
    if (!solution.allFinite())
      throw Error(ErrorKind::bad_input,
                  "the pins contradict each other; move one away from the others");
    const MatrixXc solved =
        basis_->factor.template triangularView<Eigen::Upper>().solve(adjoint * solution.topRows(m));
    const Index n = basis.control_count();
    MatrixXc coefficients = MatrixXc::Zero(n, m);
    for (size_t k = 0; k < basis_->kept.size(); ++k)
      coefficients.row(basis_->kept[k]) = solved.row(static_cast<Index>(k));
    affine_ = solution.bottomRows(affine);
    coefficients_ = PlanarMatrix<T>(n, m);
    coefficients_.re = coefficients.real().template cast<T>();
    coefficients_.im = coefficients.imag().template cast<T>();
  }

  /// Adds the operator of the affine part (order 0) or of its derivative (order 1).
  void add_affine(PlanarMatrix<T>& matrix, const Points& points, int order) const {
    for (Index column = 0; column < matrix.cols(); ++column) {
      const Complex constant = affine_(0, column);
      const Complex slope = affine_.rows() > 1 ? affine_(1, column) / basis_->length : Complex(0);
      for (Index i = 0; i < matrix.rows(); ++i) {
        const Complex value = order == 0 ? constant + slope * (points[i] - center_) : slope;
        matrix.re(i, column) += static_cast<T>(value.real());
        matrix.im(i, column) += static_cast<T>(value.imag());
      }
    }
  }

  std::shared_ptr<const PinBasis<T>> basis_;
  std::vector<size_t> used_;      ///< the pins that are not ignored
  MatrixXc cage_at_pins_;         ///< functionals x cage controls
  PlanarMatrix<T> coefficients_;  ///< basis x functionals
  MatrixXc affine_;               ///< affine maps x functionals
  Complex center_;
};

std::unique_ptr<Deformer> make_pins(const Rest& rest, const Deformer* previous) {
  const Method& method = method_named("pins");
  if (rest.precision == Precision::full)
    return std::make_unique<PinsDeformer<double>>(
        rest, dynamic_cast<const PinsDeformer<double>*>(previous), method);
  return std::make_unique<PinsDeformer<float>>(
      rest, dynamic_cast<const PinsDeformer<float>*>(previous), method);
}

}  // namespace

Method pins_method() {
  return {
      .id = "pins",
      .label = "Elastic",
      .summary = "Keeps angles. Good for soft shapes and faces.",
      .hint = "Drag pins, and the picture follows smoothly. Cage points also work.",
      .parameters =
          {toggle("exact", "Exact",
                  "Every pin is met exactly, however much the picture bends. Off: pins that "
                  "contradict each other are met approximately"),
           used_with(
               "exact", 0,
               by_decades("smoothness", "Smoothness",
                          "Higher values bend the picture less and meet the pins less closely",
                          1e-5, 1e-8, 1e-1)),
           used_with("exact", 0,
                     by_decades("pin_weight", "Pin weight",
                                "Higher values meet the pins more closely", 10, 1e-3, 1e3)),
           toggle("own_controls", "Cage's own points",
                  "Pins move the cage's own points, and you see where they go. Off: pins move a "
                  "finer boundary of about a hundred points")},
      .uses_pins = true,
      .make = make_pins,
  };
}

}  // namespace holomorph
