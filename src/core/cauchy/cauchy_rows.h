// Rows of Cauchy coordinates: the contributions of all segments of a cage at one point.
#pragma once

#include <optional>

#include "core/cauchy/cauchy.h"

namespace holomorph {

class CauchyRows {
 public:
  /// Derivatives have a logarithm at vertices where the slope of the control points jumps. Rows
  /// there are either NaN or those of a point that is 1e-12 of the shorter edge inside. Products of
  /// the latter with control points whose slope does not jump are the limit.
  enum class AtVertices { not_a_number, from_inside };

  /// The cage must be counter-clockwise, and the order must be >= 0.
  CauchyRows(const Cage& cage, int order, AtVertices at_vertices);

  /// The coordinates of all control points at z, or at a boundary point.
  VectorXc row(Complex z) const;
  VectorXc row(BoundaryPoint point) const;

  /// The columns of the row at z that are lost to rounding when segments are evaluated one by one.
  /// There are such columns on the boundary and, for derivatives, next to a vertex. They run
  /// cyclically from `first`. None if no column is lost.
  struct Patch {
    Index first = 0;
    VectorXc values;
  };
  std::optional<Patch> patch(Complex z) const;

 private:
  /// The position at which a row is evaluated.
  struct EvalPoint {
    FinePoint point;
    std::optional<Contact> on;
  };

  size_t before(size_t vertex) const { return (vertex + segments_.size() - 1) % segments_.size(); }
  Index column(size_t segment, int m) const;
  bool is_undefined(const EvalPoint& eval_point) const;
  EvalPoint eval_point_on(const Contact& contact) const;
  EvalPoint eval_point_at(Complex z) const;
  Complex inwards(size_t vertex) const;
  VectorXc coordinates(const EvalPoint& eval_point, size_t segment) const;
  VectorXc whole_row(const EvalPoint& eval_point) const;
  void set_second_derivatives(VectorXc& row, const FinePoint& z) const;

  Cage cage_;
  int order_;
  AtVertices at_vertices_;
  std::vector<Index> offsets_;
  std::vector<SegmentPolynomial> segments_;
  std::vector<double> reach_;  ///< for each vertex, the shorter of its two chords
};

}  // namespace holomorph
