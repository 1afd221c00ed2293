// Method `harmonic`: f = sum h_c b_c with the harmonic functions h_c that run along the cage as its
// control points' weights do, so that the cage's image is the posed cage itself.
#include <algorithm>
#include <numeric>

#include "core/hilbert.h"
#include "core/methods/linear.h"
#include "core/methods/rows.h"
#include "core/polyline.h"

namespace holomorph {
namespace {

/// Each control point's weight at places of a cage.
MatrixXd weights_at(const Cage& cage, std::span<const BoundaryPoint> places) {
  MatrixXd weights = MatrixXd::Zero(static_cast<Index>(places.size()), cage.control_count());
  for (size_t i = 0; i < places.size(); ++i) {
    const auto& [segment, t] = places[i];
    const int degree = cage.degree(segment);
    for (int m = 0; m <= degree; ++m) {
      Points unit(static_cast<size_t>(degree) + 1, 0);
      unit[static_cast<size_t>(m)] = 1;
      const Index column = (cage.control_offset(segment) + m) % cage.control_count();
      weights(static_cast<Index>(i), column) += bezier_point(unit, t).real();
    }
  }
  return weights;
}

/// The polygon that a cage's curves are taken for here.
FlatCage coarsely_flattened(const Cage& cage) {
  constexpr int kPieces = 10;
  FlatCage flat;
  for (Index e = 0; e < cage.size(); ++e) {
    const int pieces = is_straight(cage, e) ? 1 : kPieces;
    for (int k = 0; k < pieces; ++k) flat.places.push_back({e, static_cast<double>(k) / pieces});
  }
  for (const BoundaryPoint& place : flat.places) flat.points.push_back(position_of(cage, place));
  return flat;
}

/// h as the real parts of holomorphic functions g.
class HarmonicCoordinates {
 public:
  /// Of a counter-clockwise cage. Beside a curve's chords the functions go on linearly.
  explicit HarmonicCoordinates(const Cage& cage)
      : flat_(coarsely_flattened(cage)),
        edge_(flat_.points, true),
        weights_(weights_at(cage, flat_.places)),
        hilbert_(flat_.points, all_vertices(), twice(weights_)) {}

  /// One row for each point: g, or g' with order 1; at vertices g is their own weights.
  MatrixXc at(std::span<const Complex> points, int order) const {
    Points inside;
    std::vector<Index> outside;
    for (const Complex& z : points) {
      inside.push_back(winding_number(flat_.points, z) != 0 ? z : beside_edge(z));
      if (inside.back() != z) outside.push_back(static_cast<Index>(inside.size()) - 1);
    }
    MatrixXc g = hilbert_.at(inside, order);
    if (order > 0) return g;
    Points moved;
    for (const Index i : outside) moved.push_back(inside[static_cast<size_t>(i)]);
    const MatrixXc slopes = hilbert_.at(moved, 1);
    for (size_t k = 0; k < outside.size(); ++k) {
      const Complex z = points[static_cast<size_t>(outside[k])];
      const auto vertex = std::ranges::find(flat_.points, z);
      if (vertex != flat_.points.end())
        g.row(outside[k]) = weights_.row(vertex - flat_.points.begin()).cast<Complex>();
      else
        g.row(outside[k]) += (z - moved[k]) * slopes.row(static_cast<Index>(k));
    }
    return g;
  }

 private:
  /// The place of the boundary next to a point on it or outside, but none of its vertices.
  Complex beside_edge(Complex z) const {
    constexpr double kLeast = 0.02;  // of an edge
    const Polyline::Nearest at = edge_.nearest(z);
    const size_t i = static_cast<size_t>(at.segment);
    const double t = std::clamp(at.parameter, kLeast, 1 - kLeast);
    return t == at.parameter && at.distance == 0
               ? z
               : flat_.points[i] +
                     t * (flat_.points[(i + 1) % flat_.points.size()] - flat_.points[i]);
  }

  std::vector<Index> all_vertices() const {
    std::vector<Index> all(flat_.points.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  /// Before and after each vertex alike.
  static MatrixXd twice(const MatrixXd& rows) {
    MatrixXd both(2 * rows.rows(), rows.cols());
    for (Index i = 0; i < rows.rows(); ++i) both.row(2 * i) = both.row(2 * i + 1) = rows.row(i);
    return both;
  }

  FlatCage flat_;
  Polyline edge_;
  MatrixXd weights_;  ///< of the control points at the polygon's vertices
  HilbertCoordinates hilbert_;
};

class HarmonicPoints final : public PointMap {
 public:
  HarmonicPoints(std::shared_ptr<const HarmonicCoordinates> coordinates, VectorXc displacement)
      : coordinates_(std::move(coordinates)), displacement_(std::move(displacement)) {}

  Value at(Complex z) const override {
    const std::span<const Complex> point(&z, 1);
    const MatrixXc g = coordinates_->at(point, 0), slope = coordinates_->at(point, 1);
    return {z + (g.real() * displacement_)[0], 1.0 + 0.5 * (slope * displacement_)[0],
            0.5 * std::conj((slope * displacement_.conjugate())[0])};
  }

 private:
  std::shared_ptr<const HarmonicCoordinates> coordinates_;
  VectorXc displacement_;
};

template <class T>
class HarmonicDeformer final : public LinearDeformer<T> {
 public:
  explicit HarmonicDeformer(const Rest& rest)
      : LinearDeformer<T>(rest),
        coordinates_(std::make_shared<const HarmonicCoordinates>(counter_clockwise(rest.cage))),
        reversed_(signed_area(outline_of(rest.cage)) < 0) {
    this->value_ = planar(coordinates_->at(rest.samples, 0).real().template cast<Complex>());
  }

  void deform(const Pose& pose, SampledMap& out, Wanted wanted) override {
    LinearDeformer<T>::deform(pose, out, {});
    if (!wanted.derivatives || out.f.size() == 0) return;
    if (slope_.rows() != out.f.size())
      slope_ = planar(coordinates_->at(this->derivative_points(), 1));
    const VectorXc by = controls(pose);
    out.fz = 0.5 * product(slope_, by).array() + Complex(1);
    out.fzbar = 0.5 * product(slope_, by.conjugate()).conjugate();
  }

  VectorXc controls(const Pose& pose) const override {
    const VectorXc by = cage_displacement(this->rest_, pose);
    if (!reversed_) return by;
    const std::vector<Index> column = reversed_columns(this->rest_.cage);
    VectorXc turned(by.size());
    for (Index c = 0; c < by.size(); ++c) turned[column[static_cast<size_t>(c)]] = by[c];
    return turned;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    check_pose(this->rest_, pose);
    return std::make_unique<HarmonicPoints>(coordinates_, controls(pose));
  }

 protected:
  PlanarMatrix<T> derivative_matrix() const override { return slope_; }

 private:
  static PlanarMatrix<T> planar(const MatrixXc& matrix) {
    PlanarMatrix<T> planar(matrix.rows(), matrix.cols());
    planar.re = matrix.real().template cast<T>();
    planar.im = matrix.imag().template cast<T>();
    return planar;
  }

  std::shared_ptr<const HarmonicCoordinates> coordinates_;
  bool reversed_;
  PlanarMatrix<T> slope_;
};

std::unique_ptr<Deformer> prepare(const Rest& rest, const Deformer*) {
  check_rest_cage(rest.cage);
  if (rest.precision == Precision::full) return std::make_unique<HarmonicDeformer<double>>(rest);
  return std::make_unique<HarmonicDeformer<float>>(rest);
}

}  // namespace

Method harmonic_method() {
  return {"harmonic",
          "Harmonic",
          "The cage's edges stay straight and go exactly where you put them; angles give way.",
          {},
          false,
          true,
          true,
          prepare};
}

}  // namespace holomorph
