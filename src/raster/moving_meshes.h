// The meshes of a scene's layers as they move, for engines and modelers.
#pragma once

#include <functional>
#include <optional>

#include "scene/formats/moving_mesh.h"
#include "scene/pictures.h"

namespace holomorph {

struct MovingMeshOptions {
  std::vector<double> times = {};    ///< seconds, increasing; empty: the scene's own pose
  std::vector<double> checked = {};  ///< more times at which the error is measured
  /// Chooses the fewest frames with which the motion is as close as this, in pixels, at these times
  /// and between them; see fewest_frames().
  std::optional<double> frame_tolerance = {};
  std::optional<size_t> vertices = {};  ///< of each layer; by default those of its own mesh
  /// Chooses the fewest vertices with which the meshes are as close as this, in pixels, at some of
  /// the times.
  std::optional<double> vertex_tolerance = {};
  /// Only the edited layer, in its own plane, with the order of triangles and vertices of its mesh,
  /// and without the faint surroundings of a cut-out.
  bool edited_only = false;
};

/// The meshes of the visible layers, or only of the edited one. What is drawn later comes later,
/// also within a mesh, as depths demand. `picture` is the picture of the edited layer, or null.
/// `step` is called on this thread with the number of times that are done, and of all; an exception
/// from it ends the work. Throws Error if there is nothing to export, or if a map cannot be found.
/// Cost: the maps of all keyframes, and a sparse solve for each time and layer.
MovingMeshes moving_meshes_of(const Scene& scene, const Image* picture, const Pictures& others,
                              const MovingMeshOptions& options,
                              const std::function<void(size_t done, size_t all)>& step);

}  // namespace holomorph
