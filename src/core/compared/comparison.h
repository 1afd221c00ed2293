// The comparison in Levi, Weber 2016: several methods project the same reference map onto the same
// bounds.
#pragma once

#include <functional>
#include <stop_token>

#include "core/bounded/certificate.h"
#include "core/maps/rest.h"

namespace holomorph {

/// One row of the comparison.
struct ComparedMap {
  std::string label, hint;
  VectorXc f = {};  ///< at the mesh's vertices
  double max_k = 0,
         max_tau = 0;         ///< tau = max(sigma_max, 1 / sigma_min); infinite if the map folds
  int flipped_triangles = 0;  ///< inverted triangles
  double turning_number = 0;  ///< turning number of the boundary's image
  double milliseconds = 0;    ///< time of the solve, excluding preparation
  int iterations = 0;
  bool settled = true;  ///< false when it stopped at the iteration limit
  /// For comparisons of methods with pins: see isometric_energy_of, and the largest distance of a
  /// pin from its target.
  std::optional<double> energy = {};
  double miss = 0;
};

/// Compares maps for a rest and pose of method `bounded`. The rows are the reference itself, this
/// program's map, and the results of plain implementations of Lipman 2012, Chen and Weber 2015,
/// Aigerman and Lipman 2013, and Kovalsky et al. 2015. These implementations follow the text of the
/// papers, and the times are theirs, not the authors'. All use the rest's parameters. Piecewise
/// linear maps are measured on the mesh's triangles; harmonic maps are measured at the mesh's
/// vertices and densely along the boundary, including between the samples. `on_row` receives each
/// row as soon as it is finished; `stop` ends the work early. Throws Error under the same
/// conditions as the methods. Cost: seconds for a thousand vertices.
void compare(const Rest& rest, const Pose& pose,
             const std::function<void(const ComparedMap&)>& on_row, std::stop_token stop = {});

}  // namespace holomorph
