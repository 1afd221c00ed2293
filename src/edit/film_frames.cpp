#include "edit/film_frames.h"

#include <utility>

#include "scene/clips.h"

namespace holomorph {

void show_film_frames(Workspace& workspace, const std::function<void()>& wake) {
  Document& document = workspace.document;
  for (const SharedLayer& layer : document.scene().layers) {
    const std::shared_ptr<Footage> footage = document.pictures().footage(*layer);
    if (!footage) continue;
    const int number = frame_at(*clip_of(*layer), workspace.shown.timeline.time);
    const std::shared_ptr<const Image> frame = footage->frame_now(number, wake);
    if (frame && frame != document.pictures().shared(*layer)) document.show_frame(*layer, frame);
    if (const auto error = footage->take_error()) workspace.messages.complain(*error);
  }
}

void set_clip(Workspace& workspace, Clip clip) {
  Layer layer = workspace.document.scene().layer();
  layer.image->clip = std::move(clip);
  workspace.commit_or_amend_layers("Film",
                                   with_layer(workspace.document.scene(), std::move(layer)));
}

}  // namespace holomorph
