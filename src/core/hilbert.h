// Holomorphic functions inside a polygon by the real parts that they have on its boundary: the
// Hilbert coordinates of Weber, Gotsman 2010.
//
// Real parts are linear in arc length between corners and may jump there. A logarithm at each
// corner has the jump, powers have what else its angle brings; cubic Cauchy coordinates of the
// boundary, cut more finely where it is needed, have the smooth rest.
#pragma once

#include "core/cage.h"

namespace holomorph {

class HilbertCoordinates {
 public:
  /// Of a simple polygon, counter-clockwise, and corners among its vertices, by increasing number:
  /// a coordinate for each value just before and just after a corner. The boundary is cut until no
  /// real part is off by more than `tolerance` times the largest value at a corner (between the
  /// places that are fitted, up to about twice that), seven times at most. Throws Error for less
  /// than three corners. Cost: 1 to 50 ms for a dozen
  /// vertices, seconds for fifty.
  HilbertCoordinates(Points polygon, std::vector<Index> corners, double tolerance = 1e-3);
  /// The same for sums of coordinates, by columns: two rows for each corner, the values before and
  /// after it.
  HilbertCoordinates(Points polygon, std::vector<Index> corners, MatrixXd sums,
                     double tolerance = 1e-3);

  const Points& polygon() const { return polygon_; }
  const std::vector<Index>& corners() const { return corners_; }
  /// The inner angle at corner i, in (0, 2 pi).
  double angle(size_t i) const { return vertices_[static_cast<size_t>(corners_[i])].angle; }
  /// How many real unknowns each coordinate has.
  Index unknowns() const { return coefficients_.rows(); }
  /// The largest error of a coordinate's real part at the places where it was fitted.
  double error() const { return error_; }

  /// Row i holds the coordinates at points[i], or their derivatives with order 1; points must be
  /// inside or on an edge, but at no vertex of the polygon. Column 2 j belongs to the value just
  /// before corner j, column 2 j + 1 to the one just after it, and the sum of a row has the real
  /// part 1; or the columns are the sums that were asked for. Imaginary constants are arbitrary.
  /// Where all vertices are corners, the columns with the values of 1, x and y at them add up to 1,
  /// z and -i z, to rounding. Cost: a row of Cauchy coordinates and `unknowns` multiplications for
  /// each column.
  MatrixXc at(std::span<const Complex> points, int order = 0) const;

  /// The real parts on the boundary that the columns stand for: rows as in `at`, at fractions of
  /// the polygon's edges.
  MatrixXd boundary_values(std::span<const BoundaryPoint> places) const;

 private:
  struct Vertex {
    Complex at, tip;             ///< the logarithm's cut goes from here to the tip, outside
    double angle = 0;            ///< inside
    std::vector<double> powers;  ///< of (z - at) / (z - tip)
  };
  /// A part of an edge.
  struct Piece {
    Index edge;
    double from, to;
  };

  void take_vertices();
  void take_linear();
  void cut(const std::vector<double>& errors, double tolerance);
  std::vector<double> solve();
  Complex logarithm(const Vertex& vertex, Complex z) const;
  Complex logarithmic_slope(const Vertex& vertex, Complex z) const;
  MatrixXc jumps(std::span<const Complex> points, int order) const;
  /// What the smooth rest is made of.
  MatrixXc basis(std::span<const Complex> points, int order) const;

  Points polygon_;
  std::vector<Index> corners_;
  MatrixXd sums_;
  MatrixXd linear_,
      shares_;  ///< columns that add up to 1, z and -i z; who makes up for what is missing
  std::vector<Vertex> vertices_;
  std::vector<Piece> pieces_;
  Cage boundary_;          ///< the pieces, as straight cubics
  MatrixXc coefficients_;  ///< of the basis, a column for each coordinate
  double error_ = 0;
};

}  // namespace holomorph
