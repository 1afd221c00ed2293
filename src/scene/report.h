// All that can be said about a scene's map in numbers.
#pragma once

#include "core/distortion.h"
#include "scene/live_map.h"

namespace holomorph {

/// What `holomorph info` prints.
struct SceneReport {
  std::string method, status, note;
  int iterations = 0;
  int cage_vertices = 0, pins = 0, mesh_vertices = 0, mesh_triangles = 0;
  double prepare_milliseconds = 0, pose_milliseconds = 0;
  double smoothness_energy = 0;  ///< mean |f_zz|^2 L^2 over triangles, dimensionless
  double pin_rms = 0;            ///< root mean square distance of pins from their targets, pixels
  MapReport map;
  bool folds_visibly = false;  ///< as the editor tells it: but for specks
};

/// Prepares the scene's map in full precision and measures it. Throws Error for a scene without a
/// cage.
SceneReport report_of(const Scene& scene);

/// The same as readable lines, or as JSON with the keys of the specification.
std::string text_of(const SceneReport& report);
std::string json_of(const SceneReport& report);

/// "exact", "iterating", "certified" or "infeasible".
const char* name_of(SampledMap::Status status);

}  // namespace holomorph
