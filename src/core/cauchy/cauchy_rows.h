// Rows of Cauchy coordinates: the contributions of all segments of a cage at one point.
#pragma once

#include <optional>

#include "core/cauchy/cauchy.h"

namespace holomorph {

class CauchyRows {
 public:
  /// The value of a derivative row at a vertex. Derivatives have a logarithmic singularity at
  /// vertices where the slope of the control points jumps. `not_a_number` gives the limit of each
  /// coordinate that has one, to 10 digits, and NaN for the others.
  /// `from_inside` evaluates the row inside the cage, at a distance of 1e-12 of the shorter edge.
  /// The product of that row with control points is the limit if their slope does not jump.
  enum class AtVertices { not_a_number, from_inside };

  /// The cage's inside must be on its left, and the order must be >= 0.
  CauchyRows(const Cage& cage, int order, AtVertices at_vertices);

  /// The coordinates of all control points at z, or at a boundary point.
  VectorXc row(Complex z) const;
  VectorXc row(BoundaryPoint point) const;

  /// Correct values for the columns of the row at z that would lose accuracy if each segment were
  /// evaluated separately. This happens on the boundary and, for derivatives, next to a vertex.
  /// Returns nullopt if no column is affected.
  struct Patch {
    std::vector<Index> columns;
    VectorXc values;
  };
  std::optional<Patch> patch(Complex z) const;

 private:
  /// The position at which a row is evaluated.
  struct EvalPoint {
    FinePoint point;
    std::optional<Contact> on;
  };

  size_t before(size_t vertex) const {
    return static_cast<size_t>(cage_.before(static_cast<Index>(vertex)));
  }
  size_t next(size_t segment) const {
    return static_cast<size_t>(cage_.next(static_cast<Index>(segment)));
  }
  Index column(size_t segment, int m) const;
  bool is_undefined(const EvalPoint& eval_point) const;
  EvalPoint eval_point_on(const Contact& contact) const;
  EvalPoint eval_point_at(Complex z) const;
  Complex inwards(size_t vertex) const;
  VectorXc coordinates(const EvalPoint& eval_point, size_t segment) const;
  VectorXc whole_row(const EvalPoint& eval_point) const;
  VectorXc row_of_limits(const EvalPoint& eval_point) const;
  void set_second_derivatives(VectorXc& row, const FinePoint& z) const;

  Cage cage_;
  int order_;
  AtVertices at_vertices_;
  std::vector<Index> offsets_;
  std::vector<SegmentPolynomial> segments_;
  std::vector<double> reach_;  ///< for each vertex, the shorter of its two chords
};

}  // namespace holomorph
