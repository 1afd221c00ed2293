// A proof that a map keeps its bounds everywhere, from the boundary's samples.
//
// ln |f_z| is harmonic, |nu| and |f_z| + |f_zbar| are subharmonic and ln(|f_z| - |f_zbar|) is
// superharmonic: bounds that hold on the boundary hold inside. Between two samples l and nu leave
// the chord of their values by at most an eighth of the largest second derivative, and the bounds
// are convex in (Re l, |nu|). After Levi, Weber 2016, with second derivatives in closed form. The
// same with Psi' for nu, where |f_z| leaves its chord by another eighth.
#pragma once

#include <optional>

#include "core/cauchy/boundary_basis.h"

namespace holomorph {

/// k = |f_zbar / f_z| <= k and sigma <= |f_z| - |f_zbar|, |f_z| + |f_zbar| <= Sigma.
struct Bounds {
  double k = 0.7, sigma = 0.2, Sigma = 5;

  /// Throws Error unless 0 <= k < 1 and 0 < sigma < Sigma.
  void check_usable() const;
  /// Narrowed by a share, so that what is solved for can be proved: k and ln of both sigmas.
  Bounds tightened(double share) const;
  /// The Re l that is farthest from both stretch bounds.
  double middle() const { return 0.5 * (std::log(sigma) + std::log(Sigma)); }
};

/// The derivatives of a harmonic map f = Phi + conj(Psi) without folds: f_z = Phi' = e^l, and
/// conj(f_zbar) = Psi' = w e^l or w itself. l and w are coefficients over a BoundaryBasis' polygon.
struct LogMap {
  enum class Second { nu, psi };  ///< what w is: Psi' / Phi' (the space L_nu), or Psi' (L_psi)
  VectorXc l, w;
  Second second = Second::nu;
};

/// The map times a factor.
LogMap scaled(LogMap map, Complex factor);

/// Phi' and Psi' at points.
struct Derivatives {
  VectorXc phi, psi;
};

/// Those of a map, from l and w at the points.
Derivatives derivatives_of(const LogMap& map, const VectorXc& l, const VectorXc& w);
/// Phi'' and Psi'', from the first derivatives and l, w, l' and w' at the points.
Derivatives second_derivatives_of(const LogMap& map, const Derivatives& first, const VectorXc& w,
                                  const VectorXc& l1, const VectorXc& w1);

/// The three bounds, in the order of the cone programs' cones; and a name for messages.
enum class Bound { Sigma, sigma, k };
const char* bound_name(Bound bound);

/// What a proof found.
struct Certificate {
  bool holds = false;
  Bound failed = Bound::Sigma;  ///< the first one that could not be proved, and where
  Complex where;
  /// Points of the boundary where a bound is broken, or that are in the middle of a smallest piece
  /// on which it could not be proved.
  Points unproved;
};

class Certifier {
 public:
  /// Cost: pieces times polygon vertices. The basis must outlive this.
  explicit Certifier(const BoundaryBasis& basis);

  /// Tries to prove the bounds for all pieces, each halved up to `depth` times. Cost: products with
  /// four matrices of pieces x vertices, and a few microseconds for each halving.
  Certificate certify(const LogMap& map, const Bounds& bounds, int depth = 6) const;

  const MatrixXc& coordinates() const { return values_; }  ///< C at the basis' samples

 private:
  struct Values {
    Complex l, w;
  };
  /// A holomorphic function: coefficients, their slopes along the polygon's edges, and the slopes'
  /// jumps at its vertices.
  struct Function {
    VectorXc values, slopes, jumps;
    VectorXd moduli;
  };
  class Proof;
  Function function_of(const VectorXc& coefficients) const;
  Values at(Complex z, const Function& l, const Function& w) const;

  const BoundaryBasis& basis_;
  MatrixXc values_;         ///< C at samples
  MatrixXc second_;         ///< F'' at the pieces' middles from the jumps
  MatrixXd near_, nearer_;  ///< bounds of |F''| and |F'''| on the pieces from their moduli
};

}  // namespace holomorph
