// Bezier segments and polylines: what cages, strokes and outlines are made of.
#pragma once

#include <optional>
#include <span>

#include "core/types.h"

namespace holomorph {

/// The highest degree of a segment: above it powers amplify rounding, and nobody draws.
inline constexpr int kHighestDegree = 8;

/// Point at parameter t of the Bezier curve with control points `controls` (degree + 1 of them),
/// by de Casteljau's algorithm. Cost O(degree^2).
Complex bezier_point(std::span<const Complex> controls, double t);

/// The two halves of a Bezier curve cut at t, each with as many control points as the curve; the
/// last of the first half is the first of the second (de Casteljau).
struct SplitCurve {
  Points before, after;
};
SplitCurve split(std::span<const Complex> controls, double t);

/// The same curve written with one more control point per step until it has `degree`.
/// Throws Error when the curve's degree is already higher.
Points elevated(std::span<const Complex> controls, int degree);

/// The Bezier curve of `degree` with the given samples' end points that passes nearest to the
/// samples in the least-squares sense, samples[i] belonging to parameter parameters[i].
Points fitted(std::span<const Complex> samples, std::span<const double> parameters, int degree);

/// The angle, in (0, 2 pi], by which `out` has to turn counter-clockwise onto `in`: the one inside
/// at a vertex of a counter-clockwise boundary that is left along `out` and reached against `in`.
double inner_angle(Complex out, Complex in);
/// The unit vector that halves it.
Complex inwards_between(Complex out, Complex in);

/// Signed area of a closed polygon: positive when counter-clockwise.
double signed_area(std::span<const Complex> polygon);

/// Length of a closed polygon.
double perimeter(std::span<const Complex> polygon);

/// How often a closed polygon winds around z; points on the boundary count as either side.
int winding_number(std::span<const Complex> polygon, Complex z);

/// A nearest point on a polyline: the edge (from vertex `edge` to the next), the parameter on it,
/// the point and its distance.
struct NearestPoint {
  Index edge = 0;
  double t = 0.0;
  Complex point;
  double distance = 0.0;
};
NearestPoint nearest_on_segment(Complex a, Complex b, Complex z);
NearestPoint nearest_on_polygon(std::span<const Complex> polygon, Complex z);

/// A place where a closed polygon touches or crosses itself: the two edges and one common point.
struct Crossing {
  Index first = 0, second = 0;
  Complex point;
};

/// The first self-crossing of a closed polygon, or none when it is simple. Neighboring edges
/// cross only when they overlap. Sweep over x-sorted boxes: O(n log n) for ordinary outlines.
std::optional<Crossing> self_crossing(std::span<const Complex> polygon);

/// The turning number of a closed polygon: the sum of its exterior angles over 2 pi.
/// Edges of zero length are passed over.
double turning_number(std::span<const Complex> polygon);

}  // namespace holomorph
