// Notes that the methods without folds share.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/maps/deformer.h"

namespace holomorph {

/// A pin's distance from its target in pixels, for a pin with this index.
std::string short_pin_text(size_t pin, double pixels);
/// From this fraction of the picture's size on, a missed pin is mentioned.
inline constexpr double kMissed = 0.005;
/// The pin that is farthest from its target, and how many others are off, from `least` on. Each pin
/// of `pins` has an offset. Empty if all pins are met.
std::string missed_pins_text(std::span<const size_t> pins, std::span<const Complex> offsets,
                             double least);
/// The strongest distortion of the picture, which explains why a pin is missed.
std::string strain_text(const std::optional<Extremes>& extremes);

std::string coarse_mesh_text(int flipped_triangles);

}  // namespace holomorph
