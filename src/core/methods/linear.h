// Common parts of methods that are linear in the pose: f = z + M c(pose) and f_z = 1 + M' c(pose)
// at the samples.
//
// The controls c are displacements. Therefore the rest pose gives exactly the identity, and
// rounding errors scale with the deformation, not with the picture.
#pragma once

#include "core/cauchy/cauchy_map.h"
#include "core/maps/deformer.h"

namespace holomorph {

/// A holomorphic map that is linear in its controls; T is the scalar type of the operator.
template <class T>
class LinearDeformer : public Deformer {
 public:
  explicit LinearDeformer(const Rest& rest);

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution*) override;
  const PlanarMatrix<float>* operator_matrix() const override;

 protected:
  /// Computes M' at the derivative samples. Called when derivatives are first needed.
  virtual PlanarMatrix<T> derivative_matrix() const = 0;

  const Points& derivative_points() const {
    return rest_.derivative_samples.empty() ? rest_.samples : rest_.derivative_samples;
  }

  Rest rest_;
  PlanarMatrix<T> value_;
  std::string note_;

 private:
  PlanarMatrix<T> derivative_;
};

/// f(z) = z + constant + slope (z - center) + Cauchy integrals + conjugated Cauchy integrals.
class SumMap final : public PointMap {
 public:
  std::vector<CauchySum> terms, conjugates;
  Complex constant = 0, slope = 0, center = 0;

  Value at(Complex z) const override;
};

/// Throws Error unless the pose's cage has the rest's structure and is finite.
void check_pose(const Rest& rest, const Pose& pose);

/// The displacements of the posed cage's control points, after raising the posed segments to the
/// degrees of the rest.
VectorXc cage_displacement(const Rest& rest, const Pose& pose);

/// A matrix that contains the columns of both operators.
template <class T>
PlanarMatrix<T> side_by_side(const PlanarMatrix<T>& left, const PlanarMatrix<T>& right);

}  // namespace holomorph
