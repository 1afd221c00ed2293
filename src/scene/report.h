// A numerical report on a scene's map.
#pragma once

#include "core/maps/deformer.h"
#include "core/maps/distortion.h"
#include "scene/timed_map.h"

namespace holomorph {

/// The values that `holomorph info` prints.
struct SceneReport {
  std::optional<int> frame;    ///< number of the animation frame
  std::optional<double> time;  ///< in seconds
  std::string method, status, note;
  int iterations = 0;
  int cage_vertices = 0, pins = 0, mesh_vertices = 0, mesh_triangles = 0;
  double prepare_milliseconds = 0;
  std::optional<double> pose_milliseconds;  ///< with derivatives; none between keyframes
  double smoothness_energy = 0;             ///< mean |f_zz|^2 L^2 over triangles, dimensionless
  double isometric_energy = 2;              ///< of the triangles; see isometric_energy_of
  double pin_rms = 0;              ///< root mean square distance of pins from their targets, pixels
  double pin_most = 0;             ///< the largest of these distances
  std::optional<Extremes> proved;  ///< if the map is certified
  /// Measured at the mesh's vertices, or in its triangles if the map is blended in these.
  /// For conformal maps, the turning number follows from the zeros.
  MapReport map;
  bool in_triangles = false;
  double least_in_triangles = 1, most_in_triangles = 1;  ///< stretches of the drawn triangles
  bool folds_visibly = false;  ///< as in the editor, if the picture were opaque
};

/// Measures a frame of a scene's map at the mesh's vertices. Between keyframes, a map that is
/// blended triangle by triangle is measured in the triangles.
SceneReport report_of(TimedMap& timed, const TimedFrame& frame);

/// A report as readable text.
std::string text_of(const SceneReport& report);
/// Reports as JSON with the keys of the specification: a single object for one report without a
/// frame, otherwise a list of objects.
std::string json_of(const std::vector<SceneReport>& reports);

/// "exact", "iterating", "certified" or "infeasible".
const char* name_of(SampledMap::Status status);

}  // namespace holomorph
