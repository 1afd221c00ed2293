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
      {
          .id = "cage.from_picture",
          .label = "Make from picture",
          .icon = kMagic,
          .menu = "Cage",
          .enabled = has_image,
          .run = make_cage,
      },
      {
          .id = "cage.box",
          .label = "Box around the picture, to move and scale it",
          .icon = kMove,
          .menu = "Cage",
          .enabled = has_image,
          .run = make_box,
      },
      {
          .id = "cage.rest",
          .label = "Show and edit the rest shape",
          .menu = "Cage",
          .keys = {Key::tab},
          .enabled = has_cage,
          .run = switch_posture,
          .checked = [](const Workspace& w) { return w.mode == EditMode::rest; },
      },
      {
          .id = "cage.corner",
          .label = "Smooth point or corner",
          .menu = "Cage",
          .keys = {'C'},
          .enabled = has_cage_selection,
          .run = toggle_corners,
      },
      {
          .id = "cage.all_corners",
          .label = "All points are corners with angles",
          .menu = "Cage",
          .enabled = [](const Workspace& w) { return !w.shown.deformation().corners.empty(); },
          .run =
              [](Workspace& w) {
                w.commit("All corners", with_all_corners(w.shown.deformation()));
              },
      },
      {
          .id = "cage.bake",
          .label = "Pose the cage as the pins do",
          .menu = "Cage",
          .enabled =
              [](const Workspace& w) {
                return w.shown.deformation().has_cage() &&
                       method_named(w.shown.deformation().method).uses_pins &&
                       !w.shown.deformation().pins.empty();
              },
          .run = [](Workspace& w) { w.commit("Pose by pins", baked(w.shown.deformation())); },
      },
      {
          .id = "cage.raise",
          .label = "Raise the curves' degree",
          .menu = "Cage",
          .enabled = has_cage,
          .run =
              [](Workspace& w) {
                w.commit("Raise degree", raised(w.shown.deformation(), w.selection, w.mode));
              },
      },
      {
          .id = "cage.lower",
          .label = "Lower the curves' degree",
          .menu = "Cage",
          .enabled = has_cage,
          .run =
              [](Workspace& w) {
                w.commit("Lower degree", lowered(w.shown.deformation(), w.selection, w.mode));
              },
      },
      {
          .id = "map.fold_free",
          .label = "Make it fold-free",
          .menu = "Cage",
          .enabled = [](const Workspace& w) { return has_cage(w) && !is_bounded(w); },
          .run = [](Workspace& w) { w.commit("Make fold-free", fold_free(w.shown.deformation())); },
      },
      {
          .id = "map.play",
          .label = "Watch the map converge",
          .menu = "Cage",
          .enabled = converges,
          .run =
              [](Workspace& w) {
                Playback& p = w.playback;
                p.playing = !p.playing;
                if (p.playing && !p.iteration) p.iteration = 0;
              },
          .checked = [](const Workspace& w) { return w.playback.playing; },
      },
      {
          .id = "map.step",
          .label = "One iteration more",
          .menu = "Cage",
          .enabled = [](const Workspace& w) { return converges(w) && w.playback.iteration; },
          .run =
              [](Workspace& w) {
                const int last = static_cast<int>(w.map().map().energies.size()) - 1,
                          next = w.playback.iteration.value_or(-1) + 1;
                w.playback = {};
                if (next < last) w.playback.iteration = next;
              },
      },
      {
          .id = "map.restart",
          .label = "Back to the first iteration",
          .menu = "Cage",
          .enabled = converges,
          .run = [](Workspace& w) { w.playback = {0}; },
      },
  };
}

}  // namespace holomorph
