// The continuous argument, along a boundary, of a function that has zeros inside (Levi, Weber 2016,
// alg. 4).
#pragma once

#include <functional>

#include "core/mesh/mesh.h"

namespace holomorph {

/// A zero of a function, found by the argument principle: the center of a triangle, and the winding
/// number around 0 of the values along the triangle's edges.
struct Zero {
  Complex position;
  int multiplicity = 1;
};

/// Zeros of the function with these values at mesh.vertices. A zero on an edge is counted in
/// exactly one of the edge's triangles, because both triangles count the edge in the same way.
/// Cost: linear.
std::vector<Zero> zeros_of(const Mesh& mesh, const VectorXc& values);

/// The values of a function at points.
using FunctionValues = std::function<VectorXc(const Points&)>;

/// A straight step between two points, and the values of a function there.
struct Step {
  Complex from, to;
  Complex value_from, value_to;
};
/// How much the argument of a function changes along each step, in radians. `at` supplies more
/// values where it changes by more than half a radian, or the modulus by more than a factor of
/// four. Cost: mostly that of `at`, which is called up to twenty times.
VectorXd argument_changes(const std::vector<Step>& steps, const FunctionValues& at);

/// Zeros of a function that `at` gives at any point. `points` are positions of the mesh's vertices,
/// for example a little inside the boundary, and `values` the function's values there. Unlike
/// zeros_of(mesh, values), finds what the values at the vertices alone do not tell.
std::vector<Zero> zeros_of(const Mesh& mesh, const Points& points, const VectorXc& values,
                           const FunctionValues& at);

/// The winding number around 0 of the values along a closed loop.
int winding_around_zero(const VectorXc& values);
/// Whether the values wind around 0 along any loop of the boundary.
bool winds_around_zero(PolygonView samples, const VectorXc& values);

/// The argument of the values along each loop of a boundary, summed from the increments between
/// neighboring samples. For each zero, 2 pi is subtracted at the sample nearest to the zero, or at
/// the nearest sample across the domain if that makes the argument vary clearly less. Without the
/// second choice, a sharply bent arm would turn the long way around. The sum of all increments
/// along a loop is therefore 0, and the argument is single-valued. If a loop has too few or too
/// many zeros, the jumps that correct the sum are placed where |value| is smallest. The argument of
/// a hole is continued from the nearest sample of another loop. Throws Error when a value is 0 or
/// not finite. Cost: samples times zeros, times up to 64 combinations of jump positions.
VectorXd boundary_argument(PolygonView samples, const VectorXc& values,
                           const std::vector<Zero>& zeros);

}  // namespace holomorph
