// Bezier segments and polylines, which make up cages, strokes and outlines.
#pragma once

#include <optional>
#include <span>

#include "core/types.h"

namespace holomorph {

/// The highest degree of a segment. Powers of higher degrees amplify rounding errors, and such
/// curves are not needed for drawing.
inline constexpr int kHighestDegree = 8;

/// Point at parameter t of the Bezier curve with control points `controls` (degree + 1 of them),
/// by de Casteljau's algorithm. Cost O(degree^2).
Complex bezier_point(std::span<const Complex> controls, double t);

/// The two parts of a Bezier curve, split at t by de Casteljau's algorithm. Each part has as many
/// control points as the curve. The last point of `before` is also the first point of `after`.
struct SplitCurve {
  Points before, after;
};
SplitCurve split(std::span<const Complex> controls, double t);

/// The same curve, raised to the given degree. Each degree adds one control point. Throws Error if
/// the curve's degree is already higher.
Points elevated(std::span<const Complex> controls, int degree);

/// The Bezier curve of the given degree that starts at the first sample, ends at the last sample
/// and fits the other samples by least squares. parameters[i] is the parameter of samples[i].
Points fitted(std::span<const Complex> samples, std::span<const double> parameters, int degree);

/// The counter-clockwise angle from `out` to `in`, in (0, 2 pi]. It is the interior angle at a
/// vertex of a counter-clockwise boundary, where `out` points to the next vertex and `in` to the
/// previous one.
double inner_angle(Complex out, Complex in);
/// The unit vector that bisects the inner angle.
Complex interior_bisector(Complex out, Complex in);

/// Signed area of a closed polygon: positive when counter-clockwise.
double signed_area(std::span<const Complex> polygon);

/// Length of a closed polygon.
double perimeter(std::span<const Complex> polygon);

/// The winding number of a closed polygon around z. Points on the boundary may count as inside or
/// outside.
int winding_number(std::span<const Complex> polygon, Complex z);

/// The nearest point on a polyline: the edge from vertex `edge` to the next vertex, the parameter
/// on this edge, the position and the distance.
struct NearestPoint {
  Index edge = 0;
  double t = 0.0;
  Complex point;
  double distance = 0.0;
};
NearestPoint nearest_on_segment(Complex a, Complex b, Complex z);
NearestPoint nearest_on_polygon(std::span<const Complex> polygon, Complex z);

/// A self-intersection of a closed polygon: two edges that touch or cross, and a point on both.
struct Crossing {
  Index first = 0, second = 0;
  Complex point;
};

/// The first self-crossing of a closed polygon, or none when it is simple. Neighboring edges count
/// as crossing only if they overlap. Method: a sweep over boxes sorted by x. Cost: O(n log n) for
/// ordinary outlines.
std::optional<Crossing> self_crossing(std::span<const Complex> polygon);

/// The turning number of a closed polygon: the sum of its exterior angles over 2 pi. Edges of zero
/// length are skipped.
double turning_number(std::span<const Complex> polygon);

}  // namespace holomorph
