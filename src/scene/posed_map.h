// A map of a deformation, with all that its display needs.
#pragma once

#include "core/maps/deformer.h"
#include "core/maps/injectivity.h"
#include "scene/prepared_map.h"

namespace holomorph {

struct PosedMap {
  std::optional<Deformation> deformation;  ///< none before the first map
  EvalOptions options;
  SampledMap map;                     ///< at the mesh's vertices
  std::vector<Depth> depths;          ///< the depths that determine the order of `drawn`
  std::shared_ptr<const Mesh> drawn;  ///< the mesh with its triangles in drawing order
  Injectivity injectivity;
  Points zero_images;       ///< the images of the zeros of f_z that the map reports
  double milliseconds = 0;  ///< time that the map and its examination took
};

/// The map of a deformation's own pose. Drafts continue from `before`, which must be null or belong
/// to the same prepared map. Throws Error.
PosedMap posed_map(const PreparedMap& prepared, const Deformation& deformation, EvalOptions options,
                   const PosedMap* before = nullptr);
/// Completes a map on the prepared mesh that was found in another way.
PosedMap examined_map(const PreparedMap& prepared, const Deformation& deformation,
                      EvalOptions options, SampledMap map, const PosedMap* before = nullptr);

}  // namespace holomorph
