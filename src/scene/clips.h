// The time of films that play as pictures of layers.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// The last frame of the film that plays. The clip's film must have been opened once.
int last_played_frame(const Clip& clip);
/// The number of the frame that is shown at a time. A frame is shown from its own time until just
/// before the time of the next one.
int frame_at(const Clip& clip, double time);
/// The time of the last frame, when the clip plays for the first time.
double end_of(const Clip& clip);
/// The clip with its range of frames limited to those of a film with this many frames.
Clip fitted(Clip clip, int frames);

/// The clip of a layer; null if its picture does not move.
const Clip* clip_of(const Layer& layer);
/// Whether any layer has a clip.
bool has_clips(const Scene& scene);

}  // namespace holomorph
