// The time of films that play as pictures of layers.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// The first and the last frame that play. If the film has become shorter, they are those that it
/// still has.
int first_played_frame(const Clip& clip);
int last_played_frame(const Clip& clip);
/// The number of frames that play, and how long all of them are shown, in seconds.
int played_frames(const Clip& clip);
double duration_of(const Clip& clip);
/// The number of the frame that is shown at a time. A frame is shown from its own time until just
/// before the time of the next one.
int clip_frame_at(const Clip& clip, double time);
/// The time of the last frame: when the clip plays first, or for a clip that loops, when it first
/// ends after time 0.
double end_of(const Clip& clip);
/// The time of the last frame at this rate that shows the clip's last frame, or end_of() if no
/// frame shows it.
double last_moment_of(const Clip& clip, double frames_per_second);

/// The clip of a layer; null if its picture does not move.
const Clip* clip_of(const Layer& layer);
/// Whether any layer has a clip.
bool has_clips(const Scene& scene);

}  // namespace holomorph
