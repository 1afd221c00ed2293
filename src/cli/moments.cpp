// Frame i is at i / frames_per_second seconds.
#include "cli/moments.h"

#include <cstdio>

#include "cli/streams.h"
#include "core/error.h"
#include "scene/budget.h"
#include "scene/keyframes.h"

namespace holomorph {

FrameRange frames_named(const std::string& text, const Scene& scene) {
  const int last = last_frame_of(scene);

  FrameRange range{0, last};
  int end = 0;
  if (text != "all" &&
      (std::sscanf(text.c_str(), "%d..%d%n", &range.first, &range.last, &end) != 2 ||
       end != static_cast<int>(text.size())))
    throw Error(
        ErrorKind::bad_input,
        "--frames: '" + text + "' is not a range of frames; write all, or for example 0..47");
  if (range.last < range.first)
    throw Error(ErrorKind::bad_input,
                "--frames: " + text + " runs backwards; write the lower frame first");
  if (range.first < 0 || range.last > last)
    throw Error(ErrorKind::bad_input,
                "--frames: the scene has frames 0.." + std::to_string(last) + " at " +
                    csv_line("%g", scene.animation.frames_per_second) + " frames per second");
  check_budget(&Budget::frames, range.last - range.first + 1.0, "--frames: the range has");
  return range;
}

void require_keyframes(const Scene& scene, const Path& path) {
  if (!has_time(scene))
    throw Error(ErrorKind::bad_input,
                shown_name(path) +
                    ": the scene has no keyframes; --time, --frames and films need "
                    "keyframes, or a film as a picture");
}

std::vector<FrameTime> moments_of(const Moments& wanted, const Scene& scene, const Path& path) {
  if (!wanted.any()) return {{}};
  require_keyframes(scene, path);
  if (!wanted.frames) return {{{}, wanted.time}};
  std::vector<FrameTime> moments;
  const FrameRange range = frames_named(*wanted.frames, scene);
  for (int i = range.first; i <= range.last; ++i)
    moments.push_back({i, i / scene.animation.frames_per_second});
  return moments;
}

}  // namespace holomorph
