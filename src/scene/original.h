// The background that shows the pictures as they were before they were bent.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

struct Deformation;
struct Mesh;
struct Scene;
struct Similarity;

/// Where the undeformed picture of a layer lies in the scene: where the layer was placed, on layers
/// that are not bent either.
Similarity resting_placement(const Scene& scene, size_t layer);

/// Whether a map moves, turns or scales a picture as a whole: the cage is the picture's box, and
/// the positions are those of a similarity. Such a picture is placed and not bent, so that its
/// original is where it is.
bool moves_as_whole(const Deformation& deformation, const Box& picture, const Mesh& mesh,
                    std::span<const Complex> positions);

}  // namespace holomorph
