// Holomorphic functions on a domain, known by their values at samples of its boundary.
//
// F = sum of C_j a_j with Cauchy coordinates of a polygon a little outside of the domain, so that F
// is smooth up to the domain's boundary, corners included. Unknowns are a's image under a whitening
// that makes the mean of |F|^2 over the samples the square of the unknowns.
#pragma once

#include <Eigen/QR>
#include <algorithm>

#include "core/geometry/cage.h"
#include "core/solvers/dense.h"

namespace holomorph {

/// A part of the domain's boundary between two neighboring samples.
struct BoundaryPiece {
  Index segment = 0;
  double from = 0, to = 1;  ///< its parameters on the segment

  Complex start, end;
  double length = 0;  ///< bounds |dz/dx| for x = 0 to 1 along it
  double bend = 0;    ///< bounds |d^2 z/dx^2|; 0 when straight
};

/// The part of a counter-clockwise cage's segment between two parameters.
BoundaryPiece piece_of(const Cage& domain, Index segment, double from, double to);

class BoundaryBasis {
 public:
  /// How many vertices serve: `wanted`, but neither too coarse nor too slow.
  static int usual_size(Index wanted) {
    return static_cast<int>(std::clamp<Index>(wanted, 50, 150));
  }

  /// For a domain of either orientation, with about `basis` >= 25 polygon vertices (at least one
  /// for each of the cage's, more along sharp bends, and up to four times as many around curves
  /// that nearly touch) and `samples` / `basis` samples along each of its edges, two at least, all
  /// cage vertices among them. The
  /// polygon lies a twentieth of its mean edge outside, nearer where the domain nearly touches
  /// itself. Throws Error for what check_rest_cage refuses. Cost: the product of the two numbers,
  /// and a QR factorisation of that size.
  BoundaryBasis(const Cage& domain, int basis, int samples);

  const Cage& domain() const { return domain_; }      ///< counter-clockwise
  const Points& polygon() const { return polygon_; }  ///< counter-clockwise, simple, around it
  const Points& samples() const { return samples_; }
  /// Piece i runs from sample i to the next one.
  const std::vector<BoundaryPiece>& pieces() const { return pieces_; }
  Index size() const { return static_cast<Index>(polygon_.size()); }

  /// The samples moved inwards by a share of the distance to their nearer neighbor, and no farther
  /// than to the middle of a thin part.
  Points inset(double share) const;

  /// C at points of the domain, or C' with order 1: one row each.
  MatrixXc values(std::span<const Complex> points, int order = 0) const;
  /// The whitened basis at points whose C these are: F = row . unknowns.
  MatrixXc whitened(const MatrixXc& values) const { return values * coefficients_; }
  const MatrixXc& at_samples() const { return at_samples_; }  ///< whitened
  /// The polygon's coefficients of unknowns.
  VectorXc coefficients(const VectorXc& unknowns) const { return coefficients_ * unknowns; }
  /// Those of all unknowns: one column each.
  const MatrixXc& coefficients() const { return coefficients_; }
  /// The unknowns of the function that is 1.
  VectorXc one() const { return one_; }

 private:
  Cage domain_;
  Points polygon_, samples_;
  std::vector<BoundaryPiece> pieces_;
  MatrixXc coefficients_, at_samples_;
  VectorXc one_;
};

/// Fits functions of the basis to values at points of the domain, in the sense of least squares.
class HolomorphicFit {
 public:
  HolomorphicFit() = default;
  /// Cost: a QR factorisation of points x unknowns.
  HolomorphicFit(const BoundaryBasis& basis, std::span<const Complex> points)
      : rows_(basis.whitened(basis.values(points))), qr_(rows_) {}

  /// The whitened basis at the points.
  const MatrixXc& rows() const { return rows_; }
  VectorXc unknowns(const VectorXc& values) const { return qr_.solve(values); }

  /// The nearest function: whitened unknowns, and its values at the points.
  struct Fit {
    VectorXc unknowns, values;
  };
  Fit operator()(const VectorXc& values) const {
    VectorXc x = unknowns(values);
    return {x, rows_ * x};
  }

 private:
  MatrixXc rows_;
  Eigen::HouseholderQR<MatrixXc> qr_;
};

}  // namespace holomorph
