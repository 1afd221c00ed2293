// Each step starts from the clip as it was when the drag began.
#include "edit/tools/clip_drag.h"

#include <algorithm>
#include <cmath>

#include "edit/films.h"
#include "scene/clips.h"
#include "scene/limits.h"

namespace holomorph {

void ClipDrag::start(const Workspace& workspace, Kind kind, double time) {
  kind_ = kind;
  from_ = time;
  clip_ = *clip_of(workspace.document.scene().layer());
  active_ = true;
}

void ClipDrag::follow(Workspace& workspace, double time, bool freely) const {
  const Clip* now = clip_of(workspace.document.scene().layer());
  if (!active_ || !now) return;
  const double by = time - from_, rate = workspace.document.scene().animation.frames_per_second;
  const int frames = static_cast<int>(std::lround(by * clip_.frames_per_second)),
            first = first_played_frame(clip_), last = last_played_frame(clip_);
  Clip clip = clip_;
  switch (kind_) {
    case Kind::move:
      clip.start = freely ? clip_.start + by : std::round((clip_.start + by) * rate) / rate;
      break;
    case Kind::trim_start:
      clip.first = std::clamp(first + frames, 0, last);
      clip.start = clip_.start + (clip.first - first) / clip_.frames_per_second;
      break;
    case Kind::trim_end:
      clip.last = std::clamp(last + frames, first, std::max(clip_.frames - 1, first));
      if (*clip.last == clip_.frames - 1) clip.last.reset();
      break;
  }
  clip.start = std::clamp(clip.start, -kMaxTime, kMaxTime);
  if (clip != *now) set_clip(workspace, std::move(clip));
}

void ClipDrag::end(Workspace& workspace) {
  if (active_) workspace.end_mergeable_step();
  active_ = false;
}

}  // namespace holomorph
