// A basis of holomorphic functions on a domain, given by their values at boundary samples.
//
// F = sum of C_j a_j, where C_j are the Cauchy coordinates of a polygon slightly outside the
// domain. F is therefore smooth up to the boundary of the domain, including the corners. The
// unknowns are the whitened a_j: their squared norm is the mean of |F|^2 over the samples.
//
// In a domain with holes, the polygon has a loop inside each hole. Values of 1 and of z on such a
// loop alone give F = 0, so two of the loop's a_j are always 0.
//
// A polygon around many cage points or sharp bends has more vertices than a draft needs. A coarse
// basis has an unknown for only some of them. Between these, a_j is a linear function of z_j, and F
// is as smooth there as if the skipped vertices did not exist.
#pragma once

#include <algorithm>
#include <optional>

#include "core/geometry/cage.h"
#include "core/solvers/dense.h"
#include "core/solvers/factors.h"

namespace holomorph {

/// The part of the domain's boundary between two neighboring samples.
struct BoundaryPiece {
  Index segment = 0;
  double from = 0, to = 1;  ///< parameters on the segment

  Complex start, end;
  double length = 0;  ///< upper bound on |dz/dx| for x from 0 to 1 along the piece
  double bend = 0;    ///< upper bound on |d^2 z/dx^2|; 0 if straight
};

/// The part of a segment of an oriented cage between two parameters.
BoundaryPiece piece_of(const Cage& domain, Index segment, double from, double to);

/// The lengths of a cage's segments, accurate to about 1e-3.
std::vector<double> lengths_of(const Cage& cage);

class BoundaryBasis {
 public:
  /// The recommended number of vertices: `wanted`, clamped to a range that is neither too coarse
  /// nor too slow.
  static int usual_size(Index wanted) {
    return static_cast<int>(std::clamp<Index>(wanted, 50, 150));
  }

  /// The domain may have any orientation. The polygon has about `basis` >= 25 vertices: at least
  /// one for each vertex of the cage and twelve for each hole, more along sharp bends, and up to
  /// four times as many around curves that nearly touch. Each edge of the polygon has `samples` /
  /// `basis` samples, but at least two. All cage vertices are samples. The polygon is outside the
  /// domain, also in its holes, at a distance of a twentieth of the mean edge length. It is closer
  /// if the domain nearly touches itself. Throws Error for cages that check_rest_cage rejects.
  /// Cost: `basis` x `samples`, and a QR factorization of that size.
  /// If `most` is given, the functions have about that many unknowns at most, no matter how many
  /// vertices the polygon has.
  BoundaryBasis(const Cage& domain, int basis, int samples, std::optional<int> most = {});

  const Cage& domain() const { return domain_; }  ///< oriented: the inside is on its left
  /// Oriented like the domain, and simple.
  const Polygon& polygon() const { return polygon_; }
  const Points& samples() const { return samples_.points; }
  Loops sample_loops() const { return PolygonView(samples_).loops(); }
  /// For averages over the boundary: half the lengths of the pieces next to each sample, divided by
  /// the sum.
  VectorXd sample_weights() const;
  /// Piece i runs from sample i to the next one of the same loop.
  const std::vector<BoundaryPiece>& pieces() const { return pieces_; }
  /// The number of polygon vertices.
  Index size() const { return static_cast<Index>(polygon_.points.size()); }
  /// The number of unknowns, which is smaller than size() in a domain with holes and if the basis
  /// is coarse.
  Index unknowns() const { return coefficients_.cols(); }

  /// The samples, moved inward. Each one moves by the fraction `share` of the distance to the
  /// nearer neighboring sample, but in thin parts no farther than the middle.
  Points inset(double share) const;

  /// C (or C' for order 1) at points of the domain, with one row per point.
  MatrixXc values(std::span<const Complex> points, int order = 0) const;
  /// The whitened basis at the points for which `values` holds C: F = row . unknowns.
  MatrixXc whitened(const MatrixXc& values) const;
  const MatrixXc& at_samples() const { return at_samples_; }  ///< the whitened basis
  /// The coefficients a_j for the given unknowns.
  VectorXc coefficients(const VectorXc& unknowns) const;
  /// The matrix that maps unknowns to coefficients: size() x unknowns().
  const MatrixXc& coefficients() const { return coefficients_; }
  /// The unknowns of the constant function 1.
  VectorXc one() const { return one_; }

 private:
  Cage domain_;
  Polygon polygon_, samples_;
  std::vector<BoundaryPiece> pieces_;
  MatrixXc coefficients_, at_samples_;
  VectorXc one_;
};

/// Fits functions of the basis to values at points of the domain by least squares.
class HolomorphicFit {
 public:
  HolomorphicFit() = default;
  /// Cost: a QR factorization of points x unknowns.
  HolomorphicFit(const BoundaryBasis& basis, std::span<const Complex> points)
      : rows_(basis.whitened(basis.values(points))), least_squares_(rows_) {}

  /// The whitened basis at the points.
  const MatrixXc& rows() const { return rows_; }
  VectorXc unknowns(const VectorXc& values) const { return least_squares_.solve(values); }

  /// The function that fits best: the whitened unknowns, and the values at the points.
  struct Fit {
    VectorXc unknowns, values;
  };
  Fit operator()(const VectorXc& values) const;

 private:
  MatrixXc rows_;
  LeastSquares least_squares_;
};

}  // namespace holomorph
