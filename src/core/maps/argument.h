// The continuous argument of a function with zeros, along a boundary (Levi, Weber 2016, alg. 4).
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// A zero of a function, as the argument principle sees it: the center of a triangle, and how often
/// the values wind around 0 along the triangle's edges.
struct Zero {
  Complex place;
  int multiplicity = 1;
};

/// Zeros of the function with these values at mesh.vertices. A zero on an edge is counted in one of
/// its triangles: each edge's increment is found once. Cost: linear.
std::vector<Zero> zeros_of(const Mesh& mesh, const VectorXc& values);

/// How often values along a closed loop turn around 0.
int turns_of(const VectorXc& values);

/// The argument along a closed boundary, from increments between neighboring samples, less 2 pi
/// per zero at the sample nearest to it, or across the domain from there when that turns the
/// boundary clearly less: so it is a function again, the sum of all increments is 0. Zeros that are
/// missing in the list (or too many in it) are made up for where |value| is least. Throws Error
/// when a value is 0 or not finite. Cost: samples times zeros, times up to 64 choices of sides.
VectorXd boundary_argument(std::span<const Complex> samples, const VectorXc& values,
                           const std::vector<Zero>& zeros);

}  // namespace holomorph
