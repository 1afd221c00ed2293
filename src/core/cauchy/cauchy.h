// Cauchy coordinates: the one basis that every map is built from.
//
// Over the segment w = c(t) of a cage with Bernstein polynomials B_m^N
//     C_m^(k)(z) = k! / (2 pi i) * integral of B_m^N(t) / (w - z)^(k+1) dw
// is the k-th derivative in z of the m-th coordinate. For straight segments these are eqs. 13 and
// 14 of Lin, Chen 2024 with the missing factor 1 / (2 pi i); degree 1 gives the Cauchy-Green
// coordinates C_j, D_j and D2_j of Weber, Ben-Chen, Gotsman 2009 and of Segall, Ben-Chen 2016,
// appendix A. Curved segments are no harder: c' / (c - z) is the sum of 1 / (t - t_r) over the
// roots of c(t) = z, so that each root contributes what a straight edge does.
#pragma once

#include <span>

#include "core/geometry/cage.h"
#include "core/geometry/contact.h"

namespace holomorph {

/// Coordinates of the cage's control points at `points`: row i, column c is the weight of control
/// point c (in the order of controls_of) at points[i], differentiated `order` >= 0 times.
///
/// Identities inside the cage: with b = controls_of(cage), order 0: rows sum to 1 and C b = z;
/// order 1: rows sum to 0 and D b = 1. Outside, all of these are 0.
/// On the boundary (points within rounding of it count as on it, see contact.h) the limit from
/// inside is returned; at a vertex the limit exists for order 0 only and the row is NaN above.
/// The cage may have either orientation, straight and curved segments; scaling all inputs by 2^k
/// scales the results exactly. Relative error per straight edge below 1e-13 for degrees to 8,
/// orders to 3. Throws Error when order is negative. Cost: one complex logarithm per point and
/// root; see cauchy_array.h for the fast path.
MatrixXc cauchy_coordinates(const Cage& cage, std::span<const Complex> points, int order = 0);

/// The same at boundary points that are addressed by segment and parameter: limits from inside.
MatrixXc cauchy_coordinates(const Cage& cage, std::span<const BoundaryPoint> points, int order = 0);

/// Whether z lies inside the cage or on it (within rounding), exactly, for curved cages too: the
/// winding number is the sum of the same logarithms. Either orientation. Cost: as a row of order 0.
bool contains(const Cage& cage, Complex z);

/// Ends of a segment.
struct Ends {
  bool start = false, end = false;
};

/// The degree + 1 coordinates of a single segment for a basis of `degree`, differentiated `order`
/// times. z must be neither end. `own` is where z lies on the segment, for the limit from its left.
/// A derivative's first coordinate has a pole at the segment's start and its last one at the end,
/// which those of the neighboring segments cancel; `without_poles` leaves them out, as must be done
/// for both or neither.
VectorXc segment_coordinates(const SegmentPolynomial& segment, int degree, const FinePoint& z,
                             int order, const Contact* own = nullptr, Ends without_poles = {});

/// The degree + 1 coordinates of a single straight edge from a to b at z, differentiated `order`
/// times. `on_edge` asks for the limit from the left of the edge. z must be neither a nor b.
VectorXc edge_coordinates(Complex a, Complex b, int degree, Complex z, int order,
                          bool on_edge = false);

/// The imaginary part of ln(q / -s): the angle under which the segment is seen along one root,
/// positive from the left. Next to an end it is exact for the rounded s or q there.
double angle_of(const Root& root);

/// What the two segments that meet at a vertex contribute to its row of order 0, as limits from
/// inside a counter-clockwise cage. The vertex's own coordinate is own[0]; before's last is 0.
/// Between straight edges of degree 1 it is (ln|A_{j+1} / A_j| + i (2 pi - alpha_j)) / (2 pi i).
struct VertexLimit {
  VectorXc before, own;
};
VertexLimit vertex_limit(const SegmentPolynomial& before, int degree_before,
                         const SegmentPolynomial& own, int degree);

}  // namespace holomorph
