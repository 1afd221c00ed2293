// Cauchy coordinates: the basis from which every map is built.
//
// Over the segment w = c(t) of a cage with Bernstein polynomials B_m^N
//     C_m^(k)(z) = k! / (2 pi i) * integral of B_m^N(t) / (w - z)^(k+1) dw
// is the k-th derivative in z of the m-th coordinate. For straight segments these are eqs. 13 and
// 14 of Lin, Chen 2024 with the missing factor 1 / (2 pi i). Degree 1 gives the Cauchy-Green
// coordinates C_j, D_j and D2_j of Weber, Ben-Chen, Gotsman 2009 and of Segall, Ben-Chen 2016,
// appendix A. Curved segments need no other formula: c' / (c - z) is the sum of 1 / (t - t_r) over
// the roots t_r of c(t) = z. Each root therefore contributes like a straight edge.
#pragma once

#include <span>

#include "core/geometry/cage.h"
#include "core/geometry/contact.h"

namespace holomorph {

/// Coordinates of the cage's control points at `points`: row i, column c holds the weight of
/// control point c (in the order of controls_of) at points[i], differentiated `order` >= 0 times.
///
/// Identities inside the cage: with b = controls_of(cage), order 0: rows sum to 1 and C b = z;
/// order 1: rows sum to 0 and D b = 1. Outside the cage, all of these sums are 0. On the boundary,
/// or within rounding error of it (see contact.h), the result is the limit from inside. At a
/// vertex, the derivatives of some coordinates have no limit and are NaN: those of the vertex
/// itself and of the next `order` control points on both of its segments. The others are limits, to
/// about 10 digits. The cage may have either orientation, and it may mix straight and curved
/// segments. Scaling all inputs by 2^k scales the results exactly. The relative error per straight
/// edge is below 1e-13 for degrees up to 8 and orders up to 3. Throws Error if the order is
/// negative. Cost: one complex logarithm per point and root; see cauchy_array.h for the fast path.
MatrixXc cauchy_coordinates(const Cage& cage, std::span<const Complex> points, int order = 0);

/// The coordinates at boundary points given by segment and parameter, as limits from inside.
MatrixXc cauchy_coordinates(const Cage& cage, std::span<const BoundaryPoint> points, int order = 0);

/// The control points whose coordinates are linearly independent inside the cage: all except two of
/// each hole, where values of 1 or of z on the hole's loop alone give 0.
std::vector<Index> independent_controls(const Cage& cage);

/// Whether z lies inside the cage or, to within rounding error, on it. The answer is exact even for
/// curved cages, because the roots of c(t) = z give the angle that a curve subtends. The cage may
/// have either orientation. inside.h tests many points faster.
bool contains(const Cage& cage, Complex z);

/// A flag for each end of a segment.
struct Ends {
  bool start = false, end = false;
};

/// The degree + 1 coordinates of a single segment for a basis of the given degree, differentiated
/// `order` times. z must differ from both ends. If z lies on the segment, `own` must give its
/// location there, and the result is the limit from the left. For derivatives, the first coordinate
/// has a pole at the start of the segment, and the last coordinate has a pole at the end. The poles
/// of the neighboring segments cancel them. `without_poles` says at which ends to omit the pole. At
/// each vertex, the pole must be omitted for both segments or for neither.
VectorXc segment_coordinates(const SegmentPolynomial& segment, int degree, const FinePoint& z,
                             int order, const Contact* own = nullptr, Ends without_poles = {});

/// The degree + 1 coordinates of a single straight edge from a to b at z, differentiated `order`
/// times. If `on_edge` is set, the result is the limit from the left of the edge. z must differ
/// from a and b.
VectorXc edge_coordinates(Complex a, Complex b, int degree, Complex z, int order,
                          bool on_edge = false);

/// The imaginary part of ln(q / -s): the angle that the segment subtends for one root, positive to
/// the left of the segment. Close to an end, it is exact for the rounded value of s or q.
double angle_of(const Root& root);

/// The row of order 0 at a vertex: the contributions of the two adjacent segments, as limits from
/// inside a counter-clockwise cage. own[0] is the coordinate of the vertex itself, and the last
/// entry of `before` is 0. Between straight edges of degree 1, own[0] is
/// (ln|A_{j+1} / A_j| + i (2 pi - alpha_j)) / (2 pi i).
struct VertexLimit {
  VectorXc before, own;
};
VertexLimit vertex_limit(const SegmentPolynomial& before, int degree_before,
                         const SegmentPolynomial& own, int degree);

}  // namespace holomorph
