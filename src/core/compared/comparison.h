// The comparison of Levi, Weber 2016: one reference, projected onto the same bounds by others.
#pragma once

#include <functional>
#include <stop_token>

#include "core/bounded/certificate.h"
#include "core/maps/deformer.h"

namespace holomorph {

/// A row of the comparison.
struct ComparedMap {
  std::string label, hint;
  VectorXc f = {};                ///< at the mesh's vertices
  double max_k = 0, max_tau = 0;  ///< tau = max(sigma_max, 1 / sigma_min); infinite where it folds
  int flipped_triangles = 0;      ///< triangles that are turned over
  double turning_number = 0;      ///< of the boundary's image
  double milliseconds = 0;        ///< of the solve, preparation not counted
  int iterations = 0;
  bool settled = true;  ///< false when it stopped at its most iterations
};

/// Compares the maps of a rest and pose of method `bounded`: the reference itself, this program's
/// map, and those of Lipman 2012, Chen and Weber 2015, Aigerman and Lipman 2013, and Kovalsky et
/// al. 2015, plainly implemented, all for the rest's parameters. Piecewise linear maps are measured
/// on the mesh's triangles, harmonic ones densely along the boundary, between the samples too, and
/// at vertices. `take` gets each row as it is done; `stop` ends the work early. Throws Error as the
/// methods do. Cost: seconds for a thousand vertices.
void compare(const Rest& rest, const Pose& pose,
             const std::function<void(const ComparedMap&)>& take, std::stop_token stop = {});

}  // namespace holomorph
