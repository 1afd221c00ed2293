// Cauchy coordinates: the one basis that every map is built from.
//
// Over the edge from a to b of a straight-edged cage with Bernstein polynomials B_m^N,
//     C_m^(k)(z) = k! / (2 pi i) * integral of B_m^N(t) / (w - z)^(k+1) dw,   w = a + t (b - a),
// is the k-th derivative in z of the m-th coordinate (Lin, Chen 2024, eqs. 13 and 14 with the
// missing factor 1 / (2 pi i)). Degree 1 gives the Cauchy-Green coordinates C_j, D_j and D2_j of
// Weber, Ben-Chen, Gotsman 2009 and of Segall, Ben-Chen 2016, appendix A.
#pragma once

#include <array>
#include <span>

#include "core/cage.h"

namespace holomorph {

/// A point of the cage's boundary, addressed exactly: parameter t in [0, 1) on segment `segment`.
struct BoundaryPoint {
  Index segment = 0;
  double t = 0.0;
};

/// The place of a boundary point in the plane (straight segments).
Complex position_of(const Cage& cage, BoundaryPoint point);

/// Coordinates of the cage's control points at `points`: row i, column c is the weight of control
/// point c (in the order of controls_of) at points[i], differentiated `order` >= 0 times.
///
/// Identities inside the cage: with b = controls_of(cage), order 0: rows sum to 1 and C b = z;
/// order 1: rows sum to 0 and D b = 1. Outside, all of these are 0.
/// On an edge (points within rounding of it count as on it) the limit from inside is returned; at a
/// vertex the limit exists for order 0 only and the row is NaN above.
/// The cage must be straight (is_straight) with either orientation; scaling all inputs by 2^k
/// scales the results exactly. Relative error per edge below 1e-13 for degrees to 8, orders to 3.
/// Throws Error when the cage is not straight or order is negative.
/// Cost: one complex logarithm per point and edge; see cauchy_array.h for the fast degree-1 path.
MatrixXc cauchy_coordinates(const Cage& cage, std::span<const Complex> points, int order = 0);

/// The same at boundary points that are addressed by segment and parameter: limits from inside.
MatrixXc cauchy_coordinates(const Cage& cage, std::span<const BoundaryPoint> points, int order = 0);

/// The degree + 1 coordinates of a single edge from a to b at z, differentiated `order` times.
/// `on_edge` asks for the limit from the left of the edge; points within rounding of the open edge
/// are taken to be on it. z must be neither a nor b.
VectorXc edge_coordinates(Complex a, Complex b, int degree, Complex z, int order,
                          bool on_edge = false);

/// edge_coordinates of degree 1 and order 0 or 1, without allocation: the start's and the end's.
std::array<Complex, 2> linear_edge_coordinates(Complex a, Complex b, Complex z, int order);

/// The coordinate of a vertex between two straight edges at that vertex, as the limit from inside a
/// counter-clockwise cage: (ln|A_{j+1} / A_j| + i (2 pi - alpha_j)) / (2 pi i).
Complex vertex_limit(Complex before, Complex vertex, Complex after);

}  // namespace holomorph
