// Menu Layer: pictures above each other, and what is behind them.
#include "edit/actions/groups.h"

namespace holomorph {
namespace {

bool has_others(const Workspace& w) {
  return layer_count(w.document.scene()) > 1;
}
template <int by>
bool has_neighbour(const Workspace& w) {
  const Scene& scene = w.document.scene();
  return by > 0 ? !scene.above.empty() : !scene.below.empty();
}
size_t neighbour(const Workspace& w, int by) {
  return edited_layer(w.document.scene()) + static_cast<size_t>(by);
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
  Scene scene = w.document.scene();
  scene.layer.visible = !scene.layer.visible;
  w.commit_layers(scene.layer.visible ? "Show layer" : "Hide layer", std::move(scene));
}
void lock_layer(Workspace& w) {
  Scene scene = w.document.scene();
  scene.layer.locked = !scene.layer.locked;
  w.commit_layers(scene.layer.locked ? "Lock layer" : "Unlock layer", std::move(scene));
}

template <Background::Kind kind>
void set_background(Workspace& w) {
  Scene scene = w.document.scene();
  scene.background.kind = kind;
  w.commit_layers("Background", std::move(scene));
}
template <Background::Kind kind>
bool has_background(const Workspace& w) {
  return w.document.scene().background.kind == kind;
}

// Glyphs of Font Awesome 4.
constexpr const char *kAdd = "\uf067", *kDouble = "\uf24d", *kTrash = "\uf1f8", *kUp = "\uf062",
                     *kDown = "\uf063";

}  // namespace

std::vector<Action> layer_actions() {
  using Kind = Background::Kind;
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
         if (w.document.scene().layer.locked) {
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
       [](const Workspace& w) { return w.document.scene().layer.visible; }},
      {"layer.lock",
       "Lock or unlock the layer",
       "",
       "Layer",
       {{'L', kCtrl}},
       has_content,
       lock_layer,
       [](const Workspace& w) { return w.document.scene().layer.locked; }},
      {"background.transparent",
       "Background: transparent",
       "",
       "Layer",
       {},
       has_content,
       set_background<Kind::transparent>,
       has_background<Kind::transparent>},
      {"background.color",
       "Background: a colour",
       "",
       "Layer",
       {},
       has_content,
       set_background<Kind::color>,
       has_background<Kind::color>},
      {"background.original",
       "Background: the original picture",
       "",
       "Layer",
       {},
       has_content,
       set_background<Kind::original>,
       has_background<Kind::original>},
  };
}

}  // namespace holomorph
