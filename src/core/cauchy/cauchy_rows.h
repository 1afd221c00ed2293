// Rows of Cauchy coordinates: what all segments of a cage contribute at one point.
#pragma once

#include <optional>

#include "core/cauchy/cauchy.h"

namespace holomorph {

class CauchyRows {
 public:
  /// Derivatives have a logarithm at vertices where the control points' slope jumps. Rows there are
  /// not a number, or those of a point that is 1e-12 of the shorter edge inside: products with
  /// control points whose slope does not jump are then the limit.
  enum class AtVertices { not_a_number, from_inside };

  /// For a counter-clockwise cage and order >= 0.
  CauchyRows(const Cage& cage, int order, AtVertices at_vertices);

  /// The coordinates of all control points at z, or at a point of the boundary.
  VectorXc row(Complex z) const;
  VectorXc row(BoundaryPoint point) const;

  /// The columns of z's row that are lost to rounding when segments are looked at one by one: on
  /// the boundary and, for derivatives, next to a vertex. Columns are cyclic from `first`; none
  /// when no column is.
  struct Patch {
    Index first = 0;
    VectorXc values;
  };
  std::optional<Patch> patch(Complex z) const;

 private:
  /// Where a row is looked at from.
  struct Stand {
    FinePoint point;
    std::optional<Contact> on;
  };

  size_t before(size_t vertex) const { return (vertex + segments_.size() - 1) % segments_.size(); }
  Index column(size_t segment, int m) const;
  bool is_undefined(const Stand& stand) const;
  Stand stand_on(const Contact& contact) const;
  Stand stand_at(Complex z) const;
  Complex inwards(size_t vertex) const;
  VectorXc coordinates(const Stand& stand, size_t segment) const;
  VectorXc whole_row(const Stand& stand) const;
  void set_second_derivatives(VectorXc& row, const FinePoint& z) const;

  Cage cage_;
  int order_;
  AtVertices at_vertices_;
  std::vector<Index> offsets_;
  std::vector<SegmentPolynomial> segments_;
  std::vector<double> reach_;  ///< of each vertex: the shorter of its two chords
};

}  // namespace holomorph
