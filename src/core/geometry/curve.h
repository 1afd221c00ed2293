// Bezier segments, which make up cages.
#pragma once

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

}  // namespace holomorph
