// The weights are stored as the real parts of a complex operator, because other methods also have
// complex operators.
#include "core/methods/real_coordinates.h"

#include "core/geometry/orientation.h"

namespace holomorph {
namespace {

class RealPoints final : public PointMap {
 public:
  RealPoints(std::shared_ptr<const RealCoordinates> coordinates, VectorXc displacement)
      : coordinates_(std::move(coordinates)), displacement_(std::move(displacement)) {}

  Value at(Complex z) const override { return values_at({&z, 1})[0]; }

  std::vector<Value> values_at(std::span<const Complex> points) const override {
    const VectorXc moved = coordinates_->values(points) * displacement_;
    const MatrixXc slopes = coordinates_->slopes(points);
    const VectorXc fz = 0.5 * (slopes * displacement_),
                   fzbar = 0.5 * (slopes * displacement_.conjugate()).conjugate();
    std::vector<Value> values;
    for (size_t i = 0; i < points.size(); ++i) {
      const Index row = static_cast<Index>(i);
      values.push_back({points[i] + moved[row], 1.0 + fz[row], fzbar[row]});
    }
    return values;
  }

 private:
  std::shared_ptr<const RealCoordinates> coordinates_;
  VectorXc displacement_;
};

template <class T>
class RealDeformer final : public LinearDeformer<T> {
 public:
  RealDeformer(const Rest& rest, std::shared_ptr<const RealCoordinates> coordinates)
      : LinearDeformer<T>(rest), coordinates_(std::move(coordinates)), orientation_(rest.cage) {
    this->value_.re = coordinates_->values(rest.samples).template cast<T>();
    this->value_.im = PlanarMatrix<T>::Real::Zero(this->value_.re.rows(), this->value_.re.cols());
  }

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution*) override {
    SampledMap out = LinearDeformer<T>::deform(pose, {}, nullptr);
    if (!options.derivatives || out.f.size() == 0) return out;
    if (slope_.rows() != out.f.size()) {
      const MatrixXc slopes = coordinates_->slopes(this->derivative_points());
      slope_.re = slopes.real().template cast<T>();
      slope_.im = slopes.imag().template cast<T>();
    }
    const VectorXc by = controls(pose);
    out.fz = 0.5 * product(slope_, by).array() + Complex(1);
    out.fzbar = 0.5 * product(slope_, by.conjugate()).conjugate();
    return out;
  }

  VectorXc controls(const Pose& pose) const override {
    return orientation_.turned(this->rest_.cage, cage_displacement(this->rest_, pose));
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    check_pose(this->rest_, pose);
    return std::make_unique<RealPoints>(coordinates_, controls(pose));
  }

 protected:
  PlanarMatrix<T> derivative_matrix() const override { return slope_; }

 private:
  std::shared_ptr<const RealCoordinates> coordinates_;
  Orientation orientation_;
  PlanarMatrix<T> slope_;
};

}  // namespace

std::unique_ptr<Deformer> real_deformer(const Rest& rest,
                                        std::shared_ptr<const RealCoordinates> coordinates) {
  if (rest.precision == Precision::full)
    return std::make_unique<RealDeformer<double>>(rest, std::move(coordinates));
  return std::make_unique<RealDeformer<float>>(rest, std::move(coordinates));
}

MatrixXd weights_at(const Cage& cage, std::span<const BoundaryPoint> places) {
  MatrixXd weights = MatrixXd::Zero(static_cast<Index>(places.size()), cage.control_count());
  for (size_t i = 0; i < places.size(); ++i) {
    const auto& [segment, t] = places[i];
    const int degree = cage.degree(segment);
    for (int m = 0; m <= degree; ++m) {
      Points unit(static_cast<size_t>(degree) + 1, 0);
      unit[static_cast<size_t>(m)] = 1;
      weights(static_cast<Index>(i), cage.control_index(segment, m)) +=
          bezier_point(unit, t).real();
    }
  }
  return weights;
}

}  // namespace holomorph
