// A shown frame becomes the picture of its layer; see Pictures.
#include "edit/films.h"

#include <utility>

#include "scene/clips.h"
#include "scene/layers.h"

namespace holomorph {

void show_film_frames(Workspace& workspace, const std::function<void()>& wake) {
  Document& document = workspace.document;
  const Scene& scene = document.scene();
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    const std::shared_ptr<Footage> footage = document.pictures().footage(layer);
    if (!footage || (i != scene.edited && !is_shown(scene, i))) continue;
    const int number = clip_frame_at(*clip_of(layer), workspace.shown.timeline.time);
    const std::shared_ptr<const Image> frame = footage->frame_now(layer.id, number, wake);
    if (frame && frame != document.pictures().shared(layer))
      document.show_frame(layer, number, frame);
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
