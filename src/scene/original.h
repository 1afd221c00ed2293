// The pictures as they were before they were bent, which lie behind those that are bent.
#pragma once

#include "core/mesh/mesh.h"
#include "scene/formats/image.h"
#include "scene/scene.h"

namespace holomorph {

/// Where the undeformed picture of a layer lies in the scene: where the layer was placed, on layers
/// that are not bent either.
Similarity resting_placement(const Scene& scene, size_t layer);

/// Whether a layer lies there, and is not carried away from it by what it is attached to.
bool rests_at(const Similarity& resting, const Similarity& placed, const Image& picture);

/// Whether a map moves, turns or scales a picture as a whole, so that it leaves no gaps: the cage
/// is the picture's box, and the positions are those of a similarity. Behind it, the undeformed
/// picture would only be a second one.
bool moves_as_whole(const Deformation& deformation, const Image& picture, const Mesh& mesh,
                    std::span<const Complex> positions);

/// The layers that are clipped to a layer.
std::vector<size_t> clipped_to(const Scene& scene, size_t base);

}  // namespace holomorph
