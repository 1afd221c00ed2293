// Pictures and scenes with several parts.
#pragma once

#include "scene/auto_cage.h"
#include "scene/scene.h"
#include "support/scenes.h"

namespace holomorph {

/// A part that a test draws: a disk, a ring or a bar.
struct Drawn {
  Complex at;
  double radius;
  int kind;
  bool contains(Complex z) const {
    const Complex off = z - at;
    if (kind == 2) return std::abs(off.real()) < radius && std::abs(off.imag()) < 0.3 * radius;
    return std::abs(off) < radius && (kind == 0 || std::abs(off) > 0.6 * radius);
  }
};

inline Image picture_of(int width, int height, const std::vector<Drawn>& parts) {
  Image image(width, height);
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c)
      for (const Drawn& part : parts)
        if (part.contains(Complex(c + 0.5, height - r - 0.5))) image.at(c, r)[3] = 255;
  return image;
}

/// A ring with a disk in it, and a bar. Pins are set in the ring and in the bar.
inline Scene scene_with_parts() {
  const Image image =
      picture_of(400, 200, {{{90, 100}, 80, 1}, {{90, 100}, 25, 0}, {{290, 100}, 90, 2}});
  Deformation deformation = with_cage({}, auto_cage(image, {.parts = PartChoice::apart}));
  deformation.method = "sheet";
  deformation.pins.push_back({{20, 100}, {25, 110}, {}, {}});
  deformation.pins.push_back({{290, 100}, {300, 90}, {}, {}});
  Keyframe key;
  key.time = 1;
  key.pose = whole_pose_of(deformation);
  deformation.keyframes.push_back(key);
  key.time = 2;
  key.pose.cage.segments[9][0] += Complex(3, 4);
  deformation.keyframes.push_back(key);
  Scene scene;
  change_layer(scene, [&](Layer& layer) { layer.deformation = deformation; });
  return scene;
}

}  // namespace holomorph
