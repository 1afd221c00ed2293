// The times on a scene's timeline at which a command evaluates it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "system/file.h"

namespace holomorph {

/// As given on the command line. If neither is given: the scene's own pose.
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

/// One moment: a frame and its time, or a time alone. If neither is given: the scene's own pose.
struct FrameTime {
  std::optional<int> frame = {};
  std::optional<double> time = {};
};
/// The moments that the command line asks for, at least one. Throws Error like frames_named, and if
/// there are times but no keyframes.
std::vector<FrameTime> moments_of(const Moments& wanted, const Scene& scene, const Path& path);

/// Throws Error if the scene has no keyframes. `path` is the scene's file.
void require_keyframes(const Scene& scene, const Path& path);

}  // namespace holomorph
