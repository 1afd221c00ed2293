// Conformal maps by the angles of their boundary: f' = exp(i H), which vanishes nowhere, so that no
// such map folds (Weber, Gotsman 2010).
#pragma once

#include <variant>

#include "core/angles/hilbert.h"
#include "core/angles/integration_paths.h"
#include "core/maps/deformer.h"

namespace holomorph {

class AngleMap {
 public:
  /// For a mesh of the inside of the coordinates' cage, and the map wanted at samples in it or on
  /// its boundary. With Precision::single H is kept in float. Cost: a row of coordinates for each
  /// of about three places per mesh vertex.
  AngleMap(const Mesh& mesh, std::shared_ptr<const HilbertCoordinates> coordinates,
           const Points& samples, Precision precision);

  const HilbertCoordinates& coordinates() const { return *coordinates_; }
  /// A mesh vertex in the middle.
  Complex anchor() const { return anchor_; }

  /// f at the samples for boundary angles theta in radians, as many as coordinates; f(anchor) = 0
  /// and |f'(anchor)| = 1. The angle that remains at a vertex, the inner one less theta's jump
  /// there, must be positive. With `draft` only what theta's changes since the last call bring is
  /// computed, which agrees to rounding. Cost: a product of places x angles, an exponential and a
  /// sine for each place.
  void map(const VectorXd& theta, VectorXc& f, bool draft = false);
  /// The derivatives of f at the samples by the angles of the last call, a column each. Cost: as
  /// many integrals as angles.
  MatrixXc changes() const;

  /// Near vertex j f' is a power of the distance: its exponent for boundary angles theta.
  VectorXd exponents(const VectorXd& theta) const;
  /// H at places inside, but at no vertex, with Im H = 0 at the anchor: log f' = i H theta.
  MatrixXc rows(std::span<const Complex> points) const;

 private:
  template <class T>
  struct Parts {
    Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> re, im;
  };

  void turn_to(const VectorXd& theta, bool draft);
  VectorXc integral(const VectorXc& values) const;

  std::shared_ptr<const HilbertCoordinates> coordinates_;
  Complex anchor_;
  Eigen::RowVectorXd at_anchor_;  ///< Im H there
  IntegrationPaths paths_;
  std::vector<int> nodes_of_samples_;
  VectorXd angles_;                              ///< inside, at each vertex
  std::variant<Parts<float>, Parts<double>> h_;  ///< H at the places, Im H = 0 at the anchor
  VectorXd theta_, turn_, shrink_;               ///< the last ones, and Re H theta and Im H theta
  VectorXc slopes_;                              ///< f' at the places
};

}  // namespace holomorph
