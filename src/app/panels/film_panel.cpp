// Frames are counted from 0, as on the timeline.
#include "app/panels/film_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/look/controls.h"
#include "app/look/numbers.h"
#include "edit/films.h"
#include "edit/timeline.h"
#include "scene/clips.h"

namespace holomorph {
namespace {

/// The action that plays numbered pictures.
const Action& play_action(const Workspace& workspace) {
  return workspace.actions.named("layer.play_numbered");
}

/// Applies a change of a number to the clip.
template <class Edit>
void apply(Workspace& workspace, const Change& change, Edit edit) {
  if (change.changed) {
    Clip clip = *clip_of(workspace.document.scene().layer());
    edit(clip);
    set_clip(workspace, std::move(clip));
  }
  if (change.ended) workspace.end_mergeable_step();
}

int whole(double value) {
  return static_cast<int>(std::lround(value));
}

/// The start of the film, at a frame of the timeline.
void start_row(Workspace& workspace, double start) {
  const Number number{-kMaxTime, kMaxTime, "s", 2, false, 0.0, 0.01};
  const double rate = workspace.document.scene().animation.frames_per_second;
  apply(workspace, number_row("Start", start, number, "When the film starts on the timeline"),
        [&](Clip& clip) { clip.start = std::round(start * rate) / rate; });
}

void range_rows(Workspace& workspace, const Clip& clip) {
  const double most = std::max(0, clip.frames - 1);
  double first = first_played_frame(clip), last = last_played_frame(clip);
  apply(workspace,
        number_row("First frame", first, {0, most, "", 0, false, 0.0, 0.2},
                   "The film plays from this frame on"),
        [&](Clip& it) { it.first = std::min(whole(first), last_played_frame(it)); });
  apply(workspace,
        number_row("Last frame", last, {0, most, "", 0, false, most, 0.2},
                   "The film plays up to this frame"),
        [&](Clip& it) {
          it.last = std::max(whole(last), it.first);
          if (*it.last == it.frames - 1) it.last.reset();
        });
}

void speed_row(Workspace& workspace, double rate) {
  const int decimals = rate == std::round(rate) ? 0 : 3;
  apply(workspace,
        number_row("Speed", rate, {kMinFrameRate, kMaxFrameRate, "fps", decimals, false, {}, 1},
                   "How many of its frames are shown in a second"),
        [&](Clip& clip) { clip.frames_per_second = std::round(1000 * rate) / 1000; });
}

}  // namespace

bool has_film(const Workspace& workspace) {
  return clip_of(workspace.document.scene().layer()) || play_action(workspace).enabled(workspace);
}

void film_section(Workspace& workspace) {
  if (!clip_of(workspace.document.scene().layer())) {
    caption("There are more pictures with successive numbers.");
    if (button("Play as film", ButtonKind::secondary, -1)) run(play_action(workspace), workspace);
    return;
  }
  const Clip clip = *clip_of(workspace.document.scene().layer());
  char text[80];
  std::snprintf(text, sizeof text, "%d frames, plays %.2f s", clip.frames, duration_of(clip));
  caption(text);
  start_row(workspace, clip.start);
  range_rows(workspace, clip);
  speed_row(workspace, clip.frames_per_second);
  if (switch_row("Repeat", clip.loops,
                 "Start again after the last frame. If this is off, the last frame stays.")) {
    Clip repeated = *clip_of(workspace.document.scene().layer());
    repeated.loops = !clip.loops;
    set_clip(workspace, std::move(repeated));
    workspace.end_mergeable_step();
  }
}

}  // namespace holomorph
