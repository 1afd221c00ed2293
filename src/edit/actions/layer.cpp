// The Layer menu: the stack of pictures, and the background behind it.
#include "edit/actions/groups.h"
#include "edit/actions/icons.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/numbered_frames.h"

namespace holomorph {
namespace {

bool has_others(const Workspace& w) {
  return w.document.scene().layers.size() > 1;
}
template <int by>
bool has_neighbor(const Workspace& w) {
  const Scene& scene = w.document.scene();
  return by > 0 ? scene.edited + 1 < scene.layers.size() : scene.edited > 0;
}
size_t neighbor(const Workspace& w, int by) {
  return w.document.scene().edited + static_cast<size_t>(by);
}
template <int by>
void choose(Workspace& w) {
  w.choose_layer(neighbor(w, by));
}
template <int by>
void move(Workspace& w) {
  w.commit_layers(by > 0 ? "Move layer up" : "Move layer down",
                  with_layer_moved(w.document.scene(), neighbor(w, by)));
}

bool can_attach(const Workspace& w) {
  return may_follow_any(w.document.scene(), w.document.scene().edited);
}
bool is_attached(const Workspace& w) {
  return w.document.scene().layer().attachment.has_value();
}
void attach_layer(Workspace& w) {
  if (!w.require_open_layer()) return;
  w.mode = EditMode::pose;
  w.tools.active = ToolId::attach;
}
void detach_layer(Workspace& w) {
  if (!w.require_open_layer() || !w.require_placements()) return;
  const Scene& scene = w.document.scene();
  w.commit_layers("Detach layer", detached(scene, scene.edited, w.placement(scene.edited)));
}

bool is_of_layered_file(const Workspace& w) {
  const auto& image = w.document.scene().layer().image;
  return image && !image->entry.empty();
}

/// Whether the picture is one of several with successive numbers, and does not play as a film yet.
bool is_numbered(const Workspace& w) {
  const auto& image = w.document.scene().layer().image;
  return image && image->entry.empty() && !image->clip &&
         is_named_as(image->file, FileContent::picture) && has_numbered_neighbor(image->file);
}

void show_layer(Workspace& w) {
  Layer layer = w.document.scene().layer();
  layer.visible = !layer.visible;
  w.commit_layers(layer.visible ? "Show layer" : "Hide layer",
                  with_layer(w.document.scene(), layer));
}
void lock_layer(Workspace& w) {
  Layer layer = w.document.scene().layer();
  layer.locked = !layer.locked;
  w.commit_layers(layer.locked ? "Lock layer" : "Unlock layer",
                  with_layer(w.document.scene(), layer));
}

bool may_clip(const Workspace& w) {
  return w.document.scene().edited > 0 || w.document.scene().layer().clipped;
}
void clip_layer(Workspace& w) {
  Layer layer = w.document.scene().layer();
  layer.clipped = !layer.clipped;
  w.commit_layers(layer.clipped ? "Clip layer" : "Release layer",
                  with_layer(w.document.scene(), layer));
}

template <Background::Fill fill>
void set_background(Workspace& w) {
  Scene scene = w.document.scene();
  scene.background.fill = fill;
  w.commit_layers("Background", std::move(scene));
}
template <Background::Fill fill>
bool has_background(const Workspace& w) {
  return w.document.scene().background.fill == fill;
}

}  // namespace

std::vector<Action> layer_actions() {
  using Fill = Background::Fill;
  return {
      {
          .id = "layer.add",
          .label = "Add picture...",
          .hint = "Add a picture as a layer",
          .icon = icon_named("add"),
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = ask<Request::add_layer>,
      },
      {
          .id = "layer.replace",
          .label = "Replace picture...",
          .hint = "Keep the cage, pins and keyframes",
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = ask<Request::replace_picture>,
      },
      {
          .id = "layer.play_numbered",
          .label = "Play as film",
          .hint = "Play the pictures with successive numbers in their names as a film",
          .needs = "Needs one of several numbered pictures",
          .enabled = is_numbered,
          .run = ask<Request::play_numbered>,
      },
      {
          .id = "layer.add_new",
          .label = "Add new layers of the file",
          .hint = "Add the layers of the file that are not in the scene yet",
          .needs = "Needs a layer of a file with layers",
          .enabled = is_of_layered_file,
          .run = ask<Request::add_new_layers>,
      },
      {
          .id = "layer.double",
          .label = "Duplicate layer",
          .icon = icon_named("duplicate"),
          .keys = {{'J', kCtrl}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run =
              [](Workspace& w) {
                w.commit_layers("Duplicate layer", with_layer_duplicated(w.document.scene()));
              },
      },
      {
          .id = "layer.rename",
          .label = "Rename layer",
          .keys = {Key::f2},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = ask<Request::rename_layer>,
      },
      {
          .id = "layer.delete",
          .label = "Delete layer",
          .icon = icon_named("trash"),
          .needs = "Needs a second layer, because one has to stay",
          .enabled = has_others,
          .run =
              [](Workspace& w) {
                if (w.document.scene().layer().locked) {
                  w.require_open_layer();
                  return;
                }
                w.commit_layers("Delete layer", without_layer(w.document.scene()));
              },
      },
      {
          .id = "layer.attach",
          .label = "Attach to...",
          .hint = "The layer then follows a pin, a stroke or a place of another layer",
          .icon = icon_named("attach"),
          .needs = "Needs another layer, which does not follow this one",
          .enabled = can_attach,
          .run = attach_layer,
      },
      {
          .id = "layer.detach",
          .label = "Detach layer",
          .hint = "The layer stays where it is and no longer follows the other one",
          .needs = "Needs a layer that is attached",
          .enabled = is_attached,
          .run = detach_layer,
      },
      {
          .id = "layer.above",
          .label = "Edit layer above",
          .keys = {Key::page_up},
          .needs = "There is no layer above",
          .enabled = has_neighbor<1>,
          .run = choose<1>,
      },
      {
          .id = "layer.below",
          .label = "Edit layer below",
          .keys = {Key::page_down},
          .needs = "There is no layer below",
          .enabled = has_neighbor<-1>,
          .run = choose<-1>,
      },
      {
          .id = "layer.up",
          .label = "Move layer up",
          .icon = icon_named("up"),
          .keys = {{Key::page_up, kCtrl}},
          .needs = "There is no layer above",
          .enabled = has_neighbor<1>,
          .run = move<1>,
      },
      {
          .id = "layer.down",
          .label = "Move layer down",
          .icon = icon_named("down"),
          .keys = {{Key::page_down, kCtrl}},
          .needs = "There is no layer below",
          .enabled = has_neighbor<-1>,
          .run = move<-1>,
      },
      {
          .id = "layer.clip",
          .label = "Clip to the layer below",
          .hint = "Draw the layer only where the one below it is, as a pupil in an eye",
          .keys = {{'G', kCtrlAlt}},
          .needs = "There is no layer below",
          .enabled = may_clip,
          .run = clip_layer,
          .checked = [](const Workspace& w) { return w.document.scene().layer().clipped; },
      },
      {
          .id = "layer.visible",
          .label = "Show layer",
          .hint = "Show or hide the current layer",
          .keys = {{'H', kCtrl}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = show_layer,
          .checked = [](const Workspace& w) { return w.document.scene().layer().visible; },
      },
      {
          .id = "layer.lock",
          .label = "Lock layer",
          .hint = "Protect the current layer from changes, or unlock it",
          .keys = {{'L', kCtrl}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = lock_layer,
          .checked = [](const Workspace& w) { return w.document.scene().layer().locked; },
      },
      {
          .id = "background.transparent",
          .label = "Background: transparent",
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = set_background<Fill::transparent>,
          .checked = has_background<Fill::transparent>,
      },
      {
          .id = "background.color",
          .label = "Background: color",
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = set_background<Fill::color>,
          .checked = has_background<Fill::color>,
      },
      {
          .id = "background.original",
          .label = "Background: original picture",
          .hint = "Fill the gaps that moved parts leave",
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = set_background<Fill::original>,
          .checked = has_background<Fill::original>,
      },
  };
}

}  // namespace holomorph
