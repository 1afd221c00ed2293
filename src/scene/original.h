// The background that shows the pictures as they were before they were bent.
#pragma once

#include <functional>
#include <span>

#include "core/types.h"

namespace holomorph {

struct Deformation;
struct Mesh;
struct Scene;
struct Similarity;

/// How a map places a picture: if its cage is the picture's box, the similarity that best matches
/// the positions of the mesh's vertices; otherwise the identity. So a picture that is moved, turned
/// and scaled as a whole leaves no second one behind, and one that is then bent only fills its
/// gaps.
Similarity placing_motion(const Deformation& deformation, const Box& picture, const Mesh& mesh,
                          std::span<const Complex> positions);

/// Where the undeformed picture of a layer lies in the scene: where the layer was placed, on
/// undeformed layers. `motion` gives the placing motion of a layer. That of the lowest layer that
/// is drawn does not count: it is the page on which the others lie.
Similarity original_placement(const Scene& scene, size_t layer, size_t lowest,
                              const std::function<Similarity(size_t layer)>& motion);

}  // namespace holomorph
