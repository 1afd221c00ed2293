// Menu Cage: the cage, and what the method does with it.
#include "edit/actions/groups.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/curve_edits.h"
#include "edit/tools/tool.h"
#include "scene/auto_cage.h"

namespace holomorph {
namespace {

bool has_image(const Workspace& w) {
  return w.document.image() != nullptr;
}
bool has_cage_selection(const Workspace& w) {
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::cage && handle.control == 0) return true;
  return false;
}

void make_cage(Workspace& w) {
  const auto cage = std::make_shared<Cage>();
  const auto image = w.document.pictures().shared(w.document.scene().layer());
  const AutoCageOptions options = w.tools.auto_cage;
  w.perform(
      "Making the cage", [=](Job::Progress&) { *cage = auto_cage(*image, options); },
      [&w, cage] {
        if (!w.commit("Cage from picture", with_cage(w.shown.own(), std::move(*cage)),
                      EditBase::document))
          return;
        w.mode = EditMode::pose;
        w.tools.active = ToolId::select;
        w.selection.clear();
      });
}

/// A cage that leaves the picture its shape: its box moves, scales and turns it.
void make_box(Workspace& w) {
  const Image& image = *w.document.image();
  const double width = image.width, height = image.height;
  const Points corners{{0, 0}, {width, 0}, {width, height}, {0, height}};
  if (!w.commit("Box around the picture", with_cage(w.shown.own(), corners), EditBase::document))
    return;
  w.mode = EditMode::pose;
  w.tools.active = ToolId::select;
  const std::vector<Handle> all = handles_of(w.shown.deformation(), w.mode);
  w.selection = Selection(all.begin(), all.end());
}

void switch_posture(Workspace& w) {
  w.mode = w.mode == EditMode::pose ? EditMode::rest : EditMode::pose;
  w.prune_selection();
}

bool converges(const Workspace& w) {
  return w.map().map().energies.size() > 1;
}

// Glyphs of Font Awesome 4.
constexpr const char *kMagic = "\uf0d0", *kMove = "\uf047";

}  // namespace

std::vector<Action> cage_actions() {
  return {
      {"cage.from_picture", "Make from picture", kMagic, "Cage", {}, has_image, make_cage},
      {"cage.box",
       "Box around the picture, to move and scale it",
       kMove,
       "Cage",
       {},
       has_image,
       make_box},
      {"cage.rest",
       "Show and edit the rest shape",
       "",
       "Cage",
       {Key::tab},
       has_cage,
       switch_posture,
       [](const Workspace& w) { return w.mode == EditMode::rest; }},
      {"cage.corner",
       "Smooth point or corner",
       "",
       "Cage",
       {'C'},
       has_cage_selection,
       toggle_corners},
      {"cage.all_corners",
       "All points are corners with angles",
       "",
       "Cage",
       {},
       [](const Workspace& w) { return !w.shown.deformation().corners.empty(); },
       [](Workspace& w) { w.commit("All corners", with_all_corners(w.shown.deformation())); }},
      {"cage.bake",
       "Pose the cage as the pins do",
       "",
       "Cage",
       {},
       [](const Workspace& w) {
         return w.shown.deformation().has_cage() &&
                method_named(w.shown.deformation().method).uses_pins &&
                !w.shown.deformation().pins.empty();
       },
       [](Workspace& w) { w.commit("Pose by pins", baked(w.shown.deformation())); }},
      {"cage.raise",
       "Raise the curves' degree",
       "",
       "Cage",
       {},
       has_cage,
       [](Workspace& w) {
         w.commit("Raise degree", raised(w.shown.deformation(), w.selection, w.mode));
       }},
      {"cage.lower",
       "Lower the curves' degree",
       "",
       "Cage",
       {},
       has_cage,
       [](Workspace& w) {
         w.commit("Lower degree", lowered(w.shown.deformation(), w.selection, w.mode));
       }},
      {"map.fold_free",
       "Make it fold-free",
       "",
       "Cage",
       {},
       [](const Workspace& w) {
         return w.shown.own().has_cage() && w.shown.deformation().method != "bounded";
       },
       [](Workspace& w) { w.commit("Make fold-free", fold_free(w.shown.deformation())); }},
      {"map.play",
       "Watch the map converge",
       "",
       "Cage",
       {},
       converges,
       [](Workspace& w) {
         Playback& p = w.playback;
         p.playing = !p.playing;
         if (p.playing && !p.iteration) p.iteration = 0;
       },
       [](const Workspace& w) { return w.playback.playing; }},
      {"map.step",
       "One iteration more",
       "",
       "Cage",
       {},
       [](const Workspace& w) { return converges(w) && w.playback.iteration; },
       [](Workspace& w) {
         const int last = static_cast<int>(w.map().map().energies.size()) - 1,
                   next = w.playback.iteration.value_or(-1) + 1;
         w.playback = {};
         if (next < last) w.playback.iteration = next;
       }},
      {"map.restart",
       "Back to the first iteration",
       "",
       "Cage",
       {},
       converges,
       [](Workspace& w) { w.playback = {0}; }},
  };
}

}  // namespace holomorph
