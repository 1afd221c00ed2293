// Holomorphic functions inside a cage by the real parts that they have on its boundary: the
// Hilbert coordinates of Weber, Gotsman 2010, along curved boundaries, too.
//
// A logarithm at each vertex has the jump there, powers have what else its angle brings; cubic
// Cauchy coordinates of the boundary, cut more finely where it is needed, have the smooth rest.
#pragma once

#include <functional>

#include "core/geometry/cage.h"

namespace holomorph {

/// Real functions along a cage's boundary, one for each column.
struct RealParts {
  /// Their values, a row for each place; not asked for at vertices.
  std::function<MatrixXd(std::span<const BoundaryPoint>)> values;
  MatrixXd jumps;   ///< by how much they grow at once at each of the cage's vertices
  MatrixXd linear;  ///< sums of them that equal 1, x and y, or 1 alone; a column each
};

/// Functions that are linear in arc length between corners, which are vertices of the cage by
/// increasing number: columns 2 j and 2 j + 1 are 1 just before and just after corner j, and 0 at
/// all other corners. Throws Error for less than three corners.
RealParts corner_values(const Cage& cage, const std::vector<Index>& corners);

class HilbertCoordinates {
 public:
  /// Of a counter-clockwise cage that can rest. The boundary is cut until no real part is off by
  /// more than `tolerance` (between the places that are fitted, up to about twice that), seven
  /// times at most. Cost: cubic in the vertices; 5 ms for a dozen, 200 ms for fifty.
  HilbertCoordinates(Cage cage, RealParts parts, double tolerance = 1e-3);

  const Cage& cage() const { return cage_; }
  const RealParts& parts() const { return parts_; }
  /// The inner angle at a vertex, in (0, 2 pi).
  double angle(Index vertex) const { return vertices_[static_cast<size_t>(vertex)].angle; }
  /// How many unknowns each coordinate has.
  Index unknowns() const { return coefficients_.rows(); }
  /// The largest error of a coordinate's real part at the places where it was fitted.
  double error() const { return error_; }

  /// Row i holds the coordinates at points[i], or their derivatives with order 1; points must be
  /// inside or on the boundary. At a vertex of the cage derivatives are not finite, nor are
  /// coordinates whose real parts jump there. Imaginary constants are arbitrary.
  /// The sums in `linear` are 1, z and -i z to rounding. Cost: a row of Cauchy coordinates and
  /// `unknowns` multiplications for each column.
  MatrixXc at(std::span<const Complex> points, int order = 0) const;

 private:
  struct Vertex {
    Complex at, tip;             ///< the logarithm's cut goes from here to the tip, outside
    double angle = 0;            ///< inside
    std::vector<double> powers;  ///< of (z - at) / (z - tip)
  };
  /// A part of a segment.
  struct Piece {
    Index segment;
    double from, to;
  };

  MatrixXc block(std::span<const Complex> points, int order) const;
  void set_up_vertices();
  void cut(const std::vector<double>& errors, double tolerance);
  std::vector<double> solve();
  Complex logarithm(const Vertex& vertex, Complex z) const;
  Complex logarithmic_slope(const Vertex& vertex, Complex z) const;
  /// The logarithms that bring the jumps.
  MatrixXc logarithms(std::span<const Complex> points, int order) const;
  /// What the smooth rest is made of.
  MatrixXc basis(std::span<const Complex> points, int order) const;

  Cage cage_;
  RealParts parts_;
  MatrixXd shares_;  ///< who makes up for what is missing in the linear sums
  MatrixXc steps_;   ///< of the logarithms, a column for each coordinate
  std::vector<Vertex> vertices_;
  std::vector<Piece> pieces_;
  Cage boundary_;          ///< the pieces, of degree 3 at least
  MatrixXc coefficients_;  ///< of the basis, a column for each coordinate
  double error_ = 0;
};

}  // namespace holomorph
