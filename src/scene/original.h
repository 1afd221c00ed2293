// The background that shows the pictures as they were before they were bent.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "core/geometry/similarity.h"

namespace holomorph {

struct Deformation;
struct Mesh;
struct Scene;

/// How a map places a picture: if its cage is the picture's box, the similarity that best fits the
/// images of the cage's vertices; otherwise the identity. So a picture that is moved, turned and
/// scaled as a whole leaves no second one behind, and one that is then bent only fills its gaps.
/// None if the box is mirrored.
std::optional<Similarity> placing_motion(const Deformation& deformation, const Box& picture,
                                         const Mesh& mesh, std::span<const Complex> positions);

using PlacingMotion = std::function<std::optional<Similarity>(size_t layer)>;
/// Where the undeformed picture of a layer lies in the scene: where the layer was placed, on
/// undeformed layers. `motion` gives the placing motion of each layer. That of the lowest layer
/// with a picture, which may be hidden, does not count: it is the page on which the others lie.
/// None if the layer, or one that it follows, is mirrored.
std::optional<Similarity> original_placement(const Scene& scene, size_t layer, size_t lowest,
                                             const PlacingMotion& motion);

}  // namespace holomorph
