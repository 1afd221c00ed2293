// Notes that the methods without folds share.
#pragma once

#include <cstdio>
#include <string>

namespace holomorph {

/// A pin's distance from its target in pixels, for a pin with this index.
inline std::string short_pin_text(size_t pin, double pixels) {
  char text[64];
  std::snprintf(text, sizeof text, ". Pin %d stops %.*f px short", static_cast<int>(pin) + 1,
                pixels < 10 ? 1 : 0, pixels);
  return text;
}
/// From this fraction of the picture's size on, a missed pin is mentioned.
inline constexpr double kMissed = 0.005;

inline std::string coarse_mesh_text(int flipped_triangles) {
  return "No folds, but the mesh is too coarse for this map: " + std::to_string(flipped_triangles) +
         " inverted triangles";
}

}  // namespace holomorph
