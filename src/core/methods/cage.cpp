// Method `cage`: f(z) = sum C_j(z) b_j, conformal wherever f' does not vanish.
#include "core/methods/linear.h"
#include "core/methods/rows.h"

namespace holomorph {
namespace {

template <class T>
class CageDeformer final : public LinearDeformer<T> {
 public:
  explicit CageDeformer(const Rest& rest) : LinearDeformer<T>(rest) {
    this->value_ = planar_coordinates<T>(rest.cage, rest.samples, 0);
  }
  VectorXc controls(const Pose& pose) const override {
    return cage_displacement(this->rest_, pose);
  }
  std::optional<Cage> solved_cage(const Pose& pose) const override {
    return elevated_to(pose.cage, this->rest_.cage);
  }
  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    check_pose(this->rest_, pose);
    auto map = std::make_unique<SumMap>();
    map->terms.emplace_back(this->rest_.cage, controls(pose));
    return map;
  }

 protected:
  PlanarMatrix<T> derivative_matrix() const override {
    return planar_coordinates<T>(this->rest_.cage, this->derivative_points(), 1);
  }
};

std::unique_ptr<Deformer> make_cage(const Rest& rest, const Deformer*) {
  if (rest.precision == Precision::full) return std::make_unique<CageDeformer<double>>(rest);
  return std::make_unique<CageDeformer<float>>(rest);
}

}  // namespace

Method cage_method() {
  return {
      .id = "cage",
      .label = "Cage",
      .summary = "Follows its points. Good for shapes you redraw.",
      .hint =
          "Move the cage points; the picture follows and keeps its angles. Pins have no effect.",
      .make = make_cage,
  };
}

}  // namespace holomorph
