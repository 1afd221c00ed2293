// Conformal maps defined by their boundary angles: f' = exp(i H). The derivative never vanishes, so
// these maps never fold (Weber, Gotsman 2010).
#pragma once

#include <variant>

#include "core/angles/hilbert.h"
#include "core/angles/integration_paths.h"
#include "core/maps/rest.h"

namespace holomorph {

class AngleMap {
 public:
  /// `mesh` must be a mesh of the coordinates' cage. The map is evaluated at `samples`, which must
  /// lie inside the cage or on its boundary. With Precision::single, H is stored in float. Cost:
  /// one row of coordinates per quadrature point. There are about three quadrature points per mesh
  /// vertex.
  AngleMap(const Mesh& mesh, std::shared_ptr<const HilbertCoordinates> coordinates,
           const Points& samples, Precision precision);

  const HilbertCoordinates& coordinates() const { return *coordinates_; }
  /// The mesh vertex nearest to the deepest point of the cage.
  Complex anchor() const { return anchor_; }

  /// Evaluates f at the samples for boundary angles theta (radians, one per coordinate), with
  /// f(anchor) = 0 and |f'(anchor)| = 1. At every vertex, the inner angle minus the jump of theta
  /// must be positive. With `draft`, only the contributions of angles that changed since the last
  /// call are recomputed. The result is the same up to rounding. Cost: a matrix-vector product
  /// (quadrature points x angles), and one exponential and one sine per quadrature point.
  void map(const VectorXd& theta, VectorXc& f, bool draft = false);
  /// The derivatives of f with respect to the angles (samples x angles), taken at the angles of the
  /// last call of map(). Cost: one integration per angle.
  MatrixXc jacobian() const;

  /// Near each vertex, f' behaves like a power of the distance to that vertex. Returns the
  /// exponents for boundary angles theta, one per vertex.
  VectorXd exponents(const VectorXd& theta) const;
  /// H (points x angles) at points in the cage other than its vertices, with Im H = 0 at the anchor
  /// and log f' = i H theta.
  MatrixXc rows(std::span<const Complex> points) const;
  /// The function H theta, with log f' = i H theta, for coordinates().values. It has the same
  /// values as rows(points) * theta.
  HilbertCoordinates::Sum sum(const VectorXd& theta) const;

 private:
  template <class T>
  struct Parts {
    Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> re, im;
  };

  void set_angles(const VectorXd& theta, bool draft);
  VectorXc integral(const VectorXc& values) const;

  std::shared_ptr<const HilbertCoordinates> coordinates_;
  Complex anchor_;
  Eigen::RowVectorXd at_anchor_;  ///< Im H at the anchor
  IntegrationPaths paths_;
  std::vector<int> nodes_of_samples_;
  VectorXd angles_;                              ///< the inner angle at each vertex
  std::variant<Parts<float>, Parts<double>> h_;  ///< H at the quadrature points
  VectorXd theta_, re_h_theta_, im_h_theta_;     ///< last angles, Re H theta, Im H theta
  VectorXc derivatives_;                         ///< f' at the quadrature points
};

}  // namespace holomorph
