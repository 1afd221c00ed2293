#include "core/methods/notes.h"

#include <cstdio>

namespace holomorph {

std::string short_pin_text(size_t pin, double pixels) {
  char text[64];
  std::snprintf(text, sizeof text, ". Pin %d stops %.*f px short", static_cast<int>(pin) + 1,
                pixels < 10 ? 1 : 0, pixels);
  return text;
}

std::string sliding_pin_text(size_t pin, double pixels, SlideReason reason) {
  char distance[40] = "less than 0.1";
  if (pixels >= 0.1) std::snprintf(distance, sizeof distance, "%.*f", pixels < 10 ? 1 : 0, pixels);
  return ". Pin " + std::to_string(pin + 1) + " slides " + distance + " px: " +
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
  int missed = 0;
  for (size_t i = 0; i < pins.size(); ++i) {
    const double off = std::abs(offsets[i]);
    missed += off >= least;
    if (off > farthest) farthest = off, which = pins[i];
  }
  if (missed == 0) return "";
  std::string text = short_pin_text(which, farthest);
  if (missed > 1)
    text += missed == 2 ? ", and another pin by less"
                        : ", and " + std::to_string(missed - 1) + " other pins by less";
  return text;
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
