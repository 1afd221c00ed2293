// The precomputation for a deformation's rest state: a domain mesh and a deformer on it.
#pragma once

#include <mutex>

#include "core/maps/deformer.h"
#include "core/mesh/draw_order.h"
#include "core/mesh/inbetween.h"
#include "core/mesh/mesher.h"
#include "scene/scene.h"

namespace holomorph {

/// A shared pointer that several threads read and set. A mutex guards it, because in the standard
/// library of GCC 12, reading an atomic shared pointer can race with setting it afterward.
class SharedInbetween {
 public:
  std::shared_ptr<const Inbetween> load() const {
    const std::lock_guard lock(mutex_);
    return between_;
  }
  void store(std::shared_ptr<const Inbetween> between) {
    const std::lock_guard lock(mutex_);
    between_ = std::move(between);
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const Inbetween> between_;
};

/// A domain mesh and a deformer on it. Immutable except for the deformer and `between`.
struct PreparedMap {
  Rest rest;  ///< with samples at the mesh's vertices; its own mesh may be a coarser solving_mesh
  std::string method;
  std::shared_ptr<const Mesh> mesh;
  std::unique_ptr<Deformer> deformer;
  std::vector<std::optional<Location>>
      pins;                 ///< locations of the pins at rest; none for pins outside the mesh
  double milliseconds = 0;  ///< time that the preparation took
  /// Interpolates between maps on the mesh. Null until it is needed or has been computed in idle
  /// time.
  SharedInbetween between = {};
};

/// Whether two deformations need the same preparation.
bool same_rest(const Deformation& a, const Deformation& b);

/// Throws Error{bad_input} if the cages and keyframes of all layers together need more than the
/// budget allows, assuming meshes of the default size.
void check_affordable(std::span<const Layer> layers);
/// Returns `between` of a prepared map, creating it if it is null.
std::shared_ptr<const Inbetween> inbetween_of(PreparedMap& prepared);

/// The depths of the pins; empty if they are all equal, or if the method does not use pins.
std::vector<Depth> depths_of(const Deformation& deformation);
/// The mesh of a deformation with its triangles in drawing order, from the lowest to the highest.
/// Where depths are equal, Method::limbs_in_front decides. Its value for each method is kept, so
/// that scenes of earlier releases look as they did.
std::shared_ptr<const Mesh> drawn_mesh(std::shared_ptr<const Mesh> mesh,
                                       const Deformation& deformation);

/// Prepares a map synchronously on the calling thread. If `previous` has the same cage, and its
/// method's maps are as smooth between vertices, its meshes are reused. If it has the same method,
/// its precomputation is reused where possible. Throws Error.
std::unique_ptr<PreparedMap> prepared_map(const Deformation& deformation, Precision precision,
                                          const MeshOptions& options,
                                          const PreparedMap* previous = nullptr);

}  // namespace holomorph
