// What a deformation's rest needs precomputed: a domain mesh and a deformer over it.
#pragma once

#include <atomic>

#include "core/mesh/draw_order.h"
#include "core/mesh/inbetween.h"
#include "core/mesh/mesher.h"
#include "scene/scene.h"

namespace holomorph {

/// A domain mesh and a deformer over it. Immutable but for the deformer.
struct PreparedMap {
  Rest rest;  ///< with samples
  std::string method;
  std::shared_ptr<const Mesh> mesh;
  std::unique_ptr<Deformer> deformer;
  std::vector<std::optional<Location>> pins;  ///< of the rest's pins; none outside the mesh
  double milliseconds = 0;                    ///< what preparing took
  /// For what lies between maps on the mesh; null until somebody needs it, or has time for it.
  std::atomic<std::shared_ptr<const Inbetween>> between = {};
};

/// Whether two deformations need the same preparation.
bool same_rest(const Deformation& a, const Deformation& b);

/// Throws Error{bad_input} when the cages and keyframes of all layers together need more than the
/// budget has; meshes have about their usual size.
void check_affordable(std::span<const Layer> layers);
/// A prepared map's `between`, which is made if there is none yet.
std::shared_ptr<const Inbetween> inbetween_of(PreparedMap& prepared);

/// The depths of the pins that act.
std::vector<Depth> depths_of(const Deformation& deformation);
/// The mesh as it is drawn: its triangles from the lowest to the highest; the same mesh where the
/// depths do not differ.
std::shared_ptr<const Mesh> drawn_mesh(std::shared_ptr<const Mesh> mesh,
                                       const std::vector<Depth>& depths);

/// Prepares at once, on this thread. `previous`, when given, lends what it has in common: the mesh
/// of the same cage, the method's precomputation. Throws Error.
std::unique_ptr<PreparedMap> prepared_map(const Deformation& deformation, Precision precision,
                                          const MeshOptions& options,
                                          const PreparedMap* previous = nullptr);

}  // namespace holomorph
