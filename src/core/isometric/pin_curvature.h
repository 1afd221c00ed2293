// The second derivatives of the pins' penalty in the isometric program.
//
// From f'' = w e^l dl^2 + conj(w e^l (nu dl^2 + 2 dl dnu)) at each node of the paths, and from
// 2 penalty s Re(conj(c) c'').
#pragma once

#include <vector>

#include "core/isometric/isometric_program.h"

namespace holomorph {

class PinCurvature {
 public:
  /// phi and psi: weight * e^l and weight * nu e^l at the nodes of the paths. offsets: c, whose
  /// weighted mean is 0. The system must outlive this. Cost: linear.
  PinCurvature(const IsometricSystem& system, const VectorXc& phi, const VectorXc& psi,
               double penalty, const VectorXc& offsets);

  /// The sum of all second derivatives, computed in single precision: a matrix of size 4n, of which
  /// the lower triangle is set. Cost: 8 nodes n^2 multiplications.
  MatrixXd second_derivatives() const;
  /// The sum of the positive parts of the second derivatives at each node, likewise. Cost: 16 nodes
  /// n^2 multiplications.
  MatrixXd convex_part() const;

 private:
  /// At a node: Re(alpha dl^2 + 2 beta dl dnu) is added to the value.
  struct Bend {
    Complex alpha, beta;
  };

  const IsometricSystem& system_;
  std::vector<Bend> bends_;
};

}  // namespace holomorph
