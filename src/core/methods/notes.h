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
/// Names the pin that is farthest from its target, and counts the others that miss theirs by at
/// least `least`, in units of the plane. `offsets` are those of `pins`. Empty if none misses.
std::string missed_pins_text(std::span<const size_t> pins, std::span<const Complex> offsets,
                             double least);
/// The note of a proved frame between keyframes. Texts about sliding pins may follow.
inline const std::string kNoFoldsBetween = "Between keyframes: no folds";
/// Why a pin leaves the place where both keyframes hold it.
enum class SlideReason : char {
  whole_turns,  ///< the picture makes whole turns
  limits,       ///< nothing within the distortion of both keyframes was found
  folds         ///< nothing was found that is proved not to fold
};
/// Such a pin, and by how many pixels it leaves its place.
struct SlidingPin {
  size_t pin;
  double pixels;
};
/// Names the pin that leaves its place by most, and counts the others. Empty if there is none.
std::string sliding_pins_text(std::span<const SlidingPin> pins, SlideReason reason);
/// The strongest distortion of the picture, which explains why a pin is missed.
std::string strain_text(const std::optional<Extremes>& extremes);

std::string coarse_mesh_text(int flipped_triangles);

}  // namespace holomorph
