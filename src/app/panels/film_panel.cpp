// Frames are counted from 0, as on the timeline.
#include "app/panels/film_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/look/controls.h"
#include "app/look/numbers.h"
#include "edit/film_frames.h"
#include "scene/clips.h"
#include "scene/formats/file_kinds.h"

namespace holomorph {
namespace {

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

}  // namespace

/// The number of pictures with successive numbers to which a layer's picture belongs.
size_t FilmPanel::count_numbered(const Layer& layer) {
  const std::string& file = layer.image->file;
  if (counted_ == file) return count_;
  counted_ = file;
  try {
    count_ = is_named_as(file, FileContent::picture)
                 ? numbered_pictures(first_numbered_picture(file)).size()
                 : 0;
  } catch (const Error&) {
    count_ = 0;  // there are too many of them
  }
  return count_;
}

bool FilmPanel::has_film(const Workspace& workspace) {
  const Layer& layer = workspace.document.scene().layer();
  if (clip_of(layer)) return true;
  return layer.image && layer.image->entry.empty() &&
         workspace.document.pictures().find(*layer.image) && count_numbered(layer) > 1;
}

void FilmPanel::draw(Workspace& workspace) {
  const Layer& layer = workspace.document.scene().layer();
  const Clip* clip = clip_of(layer);
  if (!clip) {
    caption("This picture is one of " + std::to_string(count_numbered(layer)) +
            " with successive numbers.");
    const Action& play = workspace.actions.named("layer.play_numbered");
    if (button("Play them as a film", ButtonKind::secondary, -1)) run(play, workspace);
    return;
  }
  char text[80];
  std::snprintf(text, sizeof text, "%d frames, %.1f s", clip->frames,
                clip->frames / clip->frames_per_second);
  caption(text);
  double start = clip->start, rate = clip->frames_per_second, first = clip->first,
         last = last_played_frame(*clip);
  const double most = std::max(0, clip->frames - 1);
  apply(workspace,
        number_row("Start", start, {-kMaxTime, kMaxTime, "s", 2, false, 0.0, 0.01},
                   "When the film starts on the timeline"),
        [&](Clip& it) { it.start = std::round(1000 * start) / 1000; });
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
  apply(workspace,
        number_row(
            "Speed", rate,
            {kMinFrameRate, kMaxFrameRate, "fps", rate == std::round(rate) ? 0 : 3, false, {}, 1},
            "How many of its frames are shown in a second"),
        [&](Clip& it) { it.frames_per_second = std::round(1000 * rate) / 1000; });
  const Clip now = *clip_of(workspace.document.scene().layer());
  if (switch_row("Repeat", now.loops,
                 "Start again after the last frame. If this is off, the last frame stays.")) {
    Clip looped = now;
    looped.loops = !now.loops;
    set_clip(workspace, looped);
    workspace.end_mergeable_step();
  }
}

}  // namespace holomorph
