// Menu Layer: pictures above each other, and what is behind them.
#include "edit/actions/groups.h"

namespace holomorph {
namespace {

bool has_others(const Workspace& w) {
  return w.document.scene().layers.size() > 1;
}
template <int by>
bool has_neighbour(const Workspace& w) {
  const Scene& scene = w.document.scene();
  return by > 0 ? scene.edited + 1 < scene.layers.size() : scene.edited > 0;
}
size_t neighbour(const Workspace& w, int by) {
  return w.document.scene().edited + static_cast<size_t>(by);
}
template <int by>
void choose(Workspace& w) {
  w.choose_layer(neighbour(w, by));
}
template <int by>
void move(Workspace& w) {
  w.commit_layers(by > 0 ? "Layer up" : "Layer down",
                  with_layer_moved(w.document.scene(), neighbour(w, by)));
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

// Glyphs of Font Awesome 4.
constexpr const char *kAdd = "\uf067", *kDouble = "\uf24d", *kTrash = "\uf1f8", *kUp = "\uf062",
                     *kDown = "\uf063";

}  // namespace

std::vector<Action> layer_actions() {
  using Fill = Background::Fill;
  return {
      {"layer.add",
       "Add a picture as a layer...",
       kAdd,
       "Layer",
       {},
       has_content,
       ask<Request::add_layer>},
      {"layer.replace",
       "Replace the picture, keep the rest...",
       "",
       "Layer",
       {},
       has_content,
       ask<Request::replace_picture>},
      {"layer.double",
       "Duplicate layer",
       kDouble,
       "Layer",
       {{'J', kCtrl}},
       has_content,
       [](Workspace& w) {
         w.commit_layers("Duplicate layer", with_layer_doubled(w.document.scene()));
       }},
      {"layer.rename",
       "Rename layer",
       "",
       "Layer",
       {Key::f2},
       has_content,
       ask<Request::rename_layer>},
      {"layer.delete",
       "Delete layer",
       kTrash,
       "Layer",
       {},
       has_others,
       [](Workspace& w) {
         if (w.document.scene().layer().locked) {
           w.require_open_layer();
           return;
         }
         w.commit_layers("Delete layer", without_layer(w.document.scene()));
       }},
      {"layer.above",
       "Edit the layer above",
       "",
       "Layer",
       {Key::page_up},
       has_neighbour<1>,
       choose<1>},
      {"layer.below",
       "Edit the layer below",
       "",
       "Layer",
       {Key::page_down},
       has_neighbour<-1>,
       choose<-1>},
      {"layer.up",
       "Move the layer up",
       kUp,
       "Layer",
       {{Key::page_up, kCtrl}},
       has_neighbour<1>,
       move<1>},
      {"layer.down",
       "Move the layer down",
       kDown,
       "Layer",
       {{Key::page_down, kCtrl}},
       has_neighbour<-1>,
       move<-1>},
      {"layer.visible",
       "Show or hide the layer",
       "",
       "Layer",
       {{'H', kCtrl}},
       has_content,
       show_layer,
       [](const Workspace& w) { return w.document.scene().layer().visible; }},
      {"layer.lock",
       "Lock or unlock the layer",
       "",
       "Layer",
       {{'L', kCtrl}},
       has_content,
       lock_layer,
       [](const Workspace& w) { return w.document.scene().layer().locked; }},
      {"background.transparent",
       "Background: transparent",
       "",
       "Layer",
       {},
       has_content,
       set_background<Fill::transparent>,
       has_background<Fill::transparent>},
      {"background.color",
       "Background: a colour",
       "",
       "Layer",
       {},
       has_content,
       set_background<Fill::color>,
       has_background<Fill::color>},
      {"background.original",
       "Background: the original picture",
       "",
       "Layer",
       {},
       has_content,
       set_background<Fill::original>,
       has_background<Fill::original>},
  };
}

}  // namespace holomorph
