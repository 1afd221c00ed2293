// Holomorphic functions inside a cage with given real parts on its boundary: the Hilbert
// coordinates of Weber, Gotsman 2010, extended to curved boundaries.
//
// At each vertex, a logarithm reproduces the jump, and powers reproduce the other singularities
// that its angle causes. Cubic Cauchy coordinates represent the smooth remainder. The boundary is
// subdivided where they are not accurate enough. Each hole has a logarithm, ln(z - center) with a
// real coefficient; only its real part is single-valued.
#pragma once

#include <functional>

#include "core/angles/hilbert_functions.h"

namespace holomorph {

/// Real functions along a cage's boundary, one per column.
struct RealParts {
  /// Returns their values, one row per boundary point. It is never called for vertices.
  std::function<MatrixXd(std::span<const BoundaryPoint>)> values;
  MatrixXd jumps;   ///< their jumps, one row per vertex of the cage
  MatrixXd linear;  ///< weights that combine the functions into 1, x and y (or only 1)
};

/// Functions that are linear in arc length between corners. Columns 2 j and 2 j + 1 are 1 just
/// before and just after corner j, and 0 at all other corners. `corners` are vertices of the cage
/// in increasing order. Throws Error for fewer than three corners.
RealParts corner_values(const Cage& cage, const std::vector<Index>& corners);

class HilbertCoordinates {
 public:
  /// `cage` must be oriented and pass check_rest_cage. The boundary is subdivided, at most
  /// seven times, until the error of every real part is at most `tolerance` at the fitted points.
  /// Between these points, the error can be about twice as large. Cost: cubic in the number of
  /// vertices; 5 ms for a dozen, 200 ms for fifty.
  HilbertCoordinates(Cage cage, RealParts parts, double tolerance = 1e-3);

  const Cage& cage() const { return cage_; }
  const RealParts& parts() const { return parts_; }
  /// The inner angle at a vertex, in (0, 2 pi).
  double angle(Index vertex) const { return vertices_[static_cast<size_t>(vertex)].angle; }
  /// The number of unknowns of each coordinate.
  Index unknowns() const { return static_cast<Index>(unknowns_.size()); }
  /// The largest error of the coordinates' real parts at the fitted points.
  double error() const { return error_; }

  /// Row i holds the coordinates at points[i] (order 0), or their derivatives (order 1). Points
  /// must be inside the cage or on its boundary. At a vertex of the cage, derivatives are not
  /// finite, and neither are coordinates whose real parts jump there. The coordinates are
  /// determined up to imaginary constants. In cages with holes, only their real parts and their
  /// derivatives are single-valued. Their sums with the weights `linear` are 1, z and -i z
  /// up to rounding. Cost per point: at most a row of Cauchy coordinates, and `unknowns`
  /// multiplications per column; a fifth for many points in a cage of many vertices.
  MatrixXc at(std::span<const Complex> points, int order = 0) const;
  /// The same by groups of points: calls `visit` on all cores, and needs less memory.
  void for_each_group(std::span<const Complex> points, int order,
                      const HilbertFunctions::VisitGroup& visit) const;

  /// The sum of all coordinates with fixed weights: one function, whose values take less time.
  struct Sum {
    VectorXc functions, linear;  ///< coefficients
  };
  Sum sum(const VectorXd& weights) const;
  /// The values at(points) * weights of a sum. Cost per point: at most a row of Cauchy coordinates.
  VectorXc values(std::span<const Complex> points, const Sum& sum) const;

 private:
  using Vertex = HilbertFunctions::Vertex;
  /// The part of a segment between two parameters.
  struct Piece {
    Index segment;
    double from, to;
  };

  /// The functions 1, z and -i z, as many as `linear` has columns, or their derivatives.
  MatrixXc linear_functions(std::span<const Complex> points, int order) const;
  bool bends(Index vertex) const;
  void set_up_vertices();
  void refine(const std::vector<double>& errors, double tolerance);
  /// The boundary, divided into the pieces.
  Cage divided() const;
  struct Samples;
  Samples samples() const;
  struct Rows;
  Rows rows_at(const Points& points) const;
  void set_up_columns();
  std::vector<double> solve(double tolerance);

  Cage cage_;
  RealParts parts_;
  MatrixXd linear_weights_;  ///< of the linear functions, a column per coordinate
  std::vector<Vertex> vertices_;
  Points hole_centers_;
  double size_ = 1;  ///< of the cage
  std::vector<Piece> pieces_;
  HilbertFunctions functions_;
  std::vector<Index> logarithms_, unknowns_;  ///< the columns of the vertices' logarithms, others
  MatrixXd slopes_;        ///< the logarithms' coefficients over i, a column per coordinate
  MatrixXc coefficients_;  ///< of all functions, a column per coordinate
  double error_ = 0;
};

}  // namespace holomorph
