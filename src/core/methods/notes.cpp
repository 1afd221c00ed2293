#include "core/methods/notes.h"

#include <algorithm>
#include <cstdio>

namespace holomorph {
namespace {

std::string pixels_text(double pixels) {
  if (pixels < 0.1) return "less than 0.1 px";
  char text[40];
  std::snprintf(text, sizeof text, "%.*f px", pixels < 10 ? 1 : 0, pixels);
  return text;
}

/// Besides the pin that is farthest off, so many others are off, too.
std::string others_text(size_t others) {
  if (others == 0) return "";
  return others == 1 ? ", and another pin by less"
                     : ", and " + std::to_string(others) + " other pins by less";
}

}  // namespace

std::string short_pin_text(size_t pin, double pixels) {
  return ". Pin " + std::to_string(pin + 1) + " stops " + pixels_text(pixels) + " short";
}

std::string sliding_pins_text(std::span<const SlidingPin> pins, SlideReason reason) {
  if (pins.empty()) return "";
  const SlidingPin& most = *std::ranges::max_element(pins, {}, &SlidingPin::pixels);
  return ". Pin " + std::to_string(most.pin + 1) + " slides " + pixels_text(most.pixels) +
         others_text(pins.size() - 1) + ": " +
         (reason == SlideReason::whole_turns
              ? "a picture that makes whole turns can hold only one pin"
          : reason == SlideReason::limits
              ? "no map was found that holds it within both keyframes' limits"
              : "no map without folds was found that holds it");
}

std::string missed_pins_text(std::span<const size_t> pins, std::span<const Complex> offsets,
                             double least) {
  double farthest = 0;
  size_t which = 0;
  size_t missed = 0;
  for (size_t i = 0; i < pins.size(); ++i) {
    const double off = std::abs(offsets[i]);
    missed += off >= least;
    if (off > farthest) farthest = off, which = pins[i];
  }
  if (missed == 0) return "";
  return short_pin_text(which, farthest) + others_text(missed - 1);
}

std::string strain_text(const std::optional<Extremes>& extremes) {
  if (!extremes) return "";
  char text[80];
  if (extremes->largest * extremes->smallest > 1)
    std::snprintf(text, sizeof text, ". The picture already stretches to %.0f %%",
                  100 * extremes->largest);
  else
    std::snprintf(text, sizeof text, ". The picture already shrinks to %.0f %%",
                  100 * extremes->smallest);
  return text;
}

std::string coarse_mesh_text(int flipped_triangles) {
  return "The mesh is too coarse for this map: " +
         (flipped_triangles == 1 ? std::string("1 triangle is inverted")
                                 : std::to_string(flipped_triangles) + " triangles are inverted");
}

}  // namespace holomorph
