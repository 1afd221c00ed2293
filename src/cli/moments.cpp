// Frame i is at i / frames_per_second seconds.
#include "cli/moments.h"

#include <algorithm>
#include <cstdio>

#include "cli/streams.h"
#include "core/error.h"
#include "scene/budget.h"
#include "scene/keyframes.h"

namespace holomorph {

namespace {

/// The frames that a text names: "3", "0..47", or "0..47:2", which is every second one. None if it
/// has another form.
std::optional<FrameRange> parsed_frames(const std::string& text) {
  FrameRange range;
  const auto fits = [&](const char* format, auto*... numbers) {
    int end = 0;
    const int read = std::sscanf(text.c_str(), format, numbers..., &end);
    return read == sizeof...(numbers) && end == static_cast<int>(text.size());
  };
  if (fits("%9d..%9d:%9d%n", &range.first, &range.last, &range.step) && range.step > 0)
    return range;
  range.step = 1;
  if (fits("%9d..%9d%n", &range.first, &range.last)) return range;
  if (!fits("%9d%n", &range.first)) return {};
  range.last = range.first;
  return range;
}

}  // namespace

FrameRange frames_named(const std::string& text, const Scene& scene, bool takes_steps) {
  const int last = last_frame_of(scene);
  const std::optional<FrameRange> parsed =
      text == "all" ? FrameRange{0, last} : parsed_frames(text);
  if (!parsed)
    throw Error(ErrorKind::bad_input,
                "--frames: '" + text +
                    "' is not a range of frames; write all, or for example 3, 0..47 or 0..47:2");
  FrameRange range = *parsed;
  if (range.step != 1 && !takes_steps)
    throw Error(ErrorKind::bad_input,
                "--frames: " + text +
                    " has a step; only pictures, info, map and inverse can leave out frames");
  if (range.last < range.first)
    throw Error(ErrorKind::bad_input,
                "--frames: " + text + " runs backwards; write the lower frame first");
  if (range.first < 0 || range.last > last)
    throw Error(ErrorKind::bad_input,
                "--frames: the scene has frames 0.." + std::to_string(last) + " at " +
                    csv_line("%g", scene.animation.frames_per_second) + " frames per second");
  range.step = std::min(range.step, range.last - range.first + 1);
  check_budget(&Budget::frames, (range.last - range.first) / range.step + 1.0,
               "--frames: the range has");
  return range;
}

void require_keyframes(const Scene& scene, const Path& path) {
  if (!has_time(scene))
    throw Error(ErrorKind::bad_input,
                shown_name(path) +
                    ": the scene has no keyframes; --frames and films need keyframes, or a film "
                    "as a picture");
}

std::vector<FrameTime> moments_of(const Moments& wanted, const Scene& scene, const Path& path) {
  if (!wanted.frames) return {{{}, wanted.time}};
  require_keyframes(scene, path);
  std::vector<FrameTime> moments;
  const FrameRange range = frames_named(*wanted.frames, scene, true);
  for (int i = range.first; i <= range.last; i += range.step)
    moments.push_back({i, i / scene.animation.frames_per_second});
  return moments;
}

}  // namespace holomorph
