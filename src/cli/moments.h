// The times on a scene's timeline at which a command evaluates it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "system/file.h"

namespace holomorph {

/// The options for times, as given on the command line. If neither is given, the scene's own pose
/// is used.
struct Moments {
  std::optional<double> time = {};         ///< seconds
  std::optional<std::string> frames = {};  ///< "A", "A..B", "A..B:STEP" or "all"
};

struct FrameRange {
  int first = 0, last = 0;
  int step = 1;
};
/// Parses Moments::frames. Throws Error if the text is not a range of the scene's frames, or if it
/// has a step that the caller does not take.
FrameRange frames_named(const std::string& text, const Scene& scene, bool takes_steps = false);

/// One moment: a frame and its time, or only a time. If neither is set, it is the scene's own pose.
struct FrameTime {
  std::optional<int> frame = {};
  std::optional<double> time = {};
};
/// The moments that the command line asks for, at least one. Throws Error if the frames are not a
/// range of the scene's frames, or if frames are named but the scene has no keyframes.
std::vector<FrameTime> moments_of(const Moments& wanted, const Scene& scene, const Path& path);

/// Throws Error if the scene has no keyframes. `path` is the scene's file.
void require_keyframes(const Scene& scene, const Path& path);

}  // namespace holomorph
