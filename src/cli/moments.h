// The moments of a scene's keyframes that a command is about.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "system/file.h"

namespace holomorph {

/// As the command line has them; neither: the scene as it stands.
struct Moments {
  std::optional<double> time = {};         ///< seconds
  std::optional<std::string> frames = {};  ///< "A..B" or "all"

  bool any() const { return time || frames; }
};

struct FrameRange {
  int first = 0, last = 0;
};
/// Throws Error for a text that is not a range of the scene's frames.
FrameRange frames_named(const std::string& text, const Scene& scene);

/// One of them; neither: the scene as it stands.
struct FrameTime {
  std::optional<int> frame = {};
  std::optional<double> time = {};
};
/// At least one. Throws Error as frames_named, and for times of a scene without keyframes.
std::vector<FrameTime> moments_of(const Moments& wanted, const Scene& scene, const Path& path);

/// Throws Error unless a scene has keyframes. `path` is where it came from.
void require_keyframes(const Scene& scene, const Path& path);

}  // namespace holomorph
