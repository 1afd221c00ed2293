// A proof, from samples of the boundary, that a map stays within its bounds everywhere.
//
// ln |f_z| is harmonic, |nu| and |f_z| + |f_zbar| are subharmonic and ln(|f_z| - |f_zbar|) is
// superharmonic. Bounds that hold on the boundary therefore hold inside. Between two samples, l and
// nu deviate from the chord of their values by at most an eighth of their largest second
// derivative. The bounds on shear and on the smallest size are convex in (Re l, |nu|). The largest
// size, e^(Re l) (1 + |nu|), exceeds its values at both samples by at most a quarter of the product
// of the changes of its factors, if one grows and the other shrinks. This follows Levi and Weber
// (2016), with second derivatives in closed form. The same holds with Psi' in place of nu, except
// that |f_z| also deviates from its chord, by at most an eighth of its own second derivative.
#pragma once

#include <optional>

#include "core/cauchy/boundary_basis.h"
#include "core/maps/deformer.h"

namespace holomorph {

/// |f_zbar / f_z| <= k, |f_z| - |f_zbar| >= sigma and |f_z| + |f_zbar| <= Sigma.
struct Bounds {
  double k = 0.7, sigma = 0.2, Sigma = 5;

  /// Throws Error unless 0 <= k < 1 and 0 < sigma < Sigma.
  void check_usable() const;
  /// Bounds narrowed by a fraction, in k and in the logarithms of the stretches. If a program is
  /// solved with the narrower bounds, the original bounds can be proved for the solution.
  Bounds tightened(double fraction) const;
  /// The value of Re l midway between the stretch bounds.
  double middle() const { return 0.5 * (std::log(sigma) + std::log(Sigma)); }
};

/// The derivatives of a harmonic map f = Phi + conj(Psi) without folds: f_z = Phi' = e^l, and
/// conj(f_zbar) = Psi', which is either w e^l or w. l and w are coefficients at the vertices of a
/// BoundaryBasis' polygon.
struct LogMap {
  enum class Second { nu, psi };  ///< what w is: Psi' / Phi' (the space L_nu), or Psi' (L_psi)
  VectorXc l, w;
  Second second = Second::nu;
};

/// The map multiplied by a factor.
LogMap scaled(LogMap map, Complex factor);

/// Phi' and Psi' at points.
struct Derivatives {
  VectorXc phi, psi;
};

/// Phi' and Psi' of a map, from the values of l and w at the points.
Derivatives derivatives_of(const LogMap& map, const VectorXc& l, const VectorXc& w);
/// Phi'' and Psi'' of a map, from the first derivatives, w, l' and w' at the points.
Derivatives second_derivatives_of(const LogMap& map, const Derivatives& first, const VectorXc& w,
                                  const VectorXc& l1, const VectorXc& w1);

/// The three bounds, in the order of the cones in the cone programs, and their names in messages.
enum class Bound { Sigma, sigma, k };
const char* bound_name(Bound bound);

/// The result of a proof.
struct Certificate {
  bool holds = false;
  Bound failed = Bound::Sigma;  ///< the first bound that could not be proved
  Complex where;                ///< a point where it could not be proved
  /// Boundary points at which a bound is violated, and midpoints of the smallest pieces on which a
  /// bound could not be proved.
  Points unproved;
};

class Certifier {
 public:
  /// Cost: pieces times polygon vertices. The basis must outlive this object.
  explicit Certifier(const BoundaryBasis& basis);

  /// Tries to prove the bounds on all pieces. Each piece is halved up to `depth` times. Cost:
  /// products with four matrices of pieces x vertices, plus a few microseconds for each halving.
  Certificate certify(const LogMap& map, const Bounds& bounds, int depth = 6) const;

  /// Bounds on the distortion of a map for which |nu| < 1 has been proved. Each bound holds
  /// everywhere. It exceeds a value that is attained by at most 1 % plus 1e-4, unless that takes
  /// more than 4000 halvings of pieces.
  Extremes extremes(const LogMap& map) const;

  const MatrixXc& coordinates() const { return values_; }  ///< C at the basis' samples

 private:
  struct Values {
    Complex l, w;
  };
  /// A holomorphic function: its coefficients, their slopes along the polygon's edges, the jumps of
  /// the slopes at the vertices, and the moduli of the jumps.
  struct Function {
    VectorXc values, slopes, jumps;
    VectorXd moduli;
  };
  class Proof;
  class Search;
  /// A piece, the values of l and w at its ends, and bounds on |l''| and |w''| along it.
  struct Leaf {
    BoundaryPiece piece;
    Values start, end;
    double second_l = 0, second_w = 0;
  };
  static double above_ends(const Leaf& leaf);
  std::vector<Leaf> leaves_of(const LogMap& map, const Function& l, const Function& w) const;
  std::pair<Leaf, Leaf> halved(const Leaf& leaf, const Function& l, const Function& w) const;
  Function function_of(const VectorXc& coefficients) const;
  Values at(Complex z, const Function& l, const Function& w) const;

  const BoundaryBasis& basis_;
  MatrixXc values_;         ///< C at samples
  MatrixXc second_;         ///< F'' at the midpoints of the pieces, from the jumps
  MatrixXd near_, nearer_;  ///< for bounds on |F''| and |F'''| on the pieces, from the moduli
};

}  // namespace holomorph
