// The Cage menu: actions on the cage and on the map that it controls.
#include "edit/actions/groups.h"
#include "edit/actions/icons.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/curve_edits.h"
#include "edit/edits/hole_edits.h"
#include "edit/edits/method_edits.h"
#include "edit/method_choice.h"
#include "edit/picture_cage.h"
#include "edit/tools/layer_drag.h"
#include "edit/tools/tool.h"

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

void cage_from_picture(Workspace& w) {
  make_picture_cage(w, method_named(w.shown.own().method), false, [&w](Cage cage) {
    if (!w.commit("Cage from picture", with_cage(w.shown.own(), std::move(cage)),
                  EditBase::document))
      return false;
    w.mode = EditMode::pose;
    w.tools.active = ToolId::select;
    w.selection.clear();
    return true;
  });
}

/// Makes the picture's rectangle the cage and selects all its points: the box around the selection
/// then moves, scales and rotates the whole picture.
void make_box(Workspace& w) {
  // The original behind a picture fills the gaps of bent parts. Behind a moved picture, it would be
  // a second one.
  Scene scene = without_original(
      with_deformation(w.document.scene(), with_box(w.shown.own(), *w.document.image())));
  if (!w.commit_layers("Place picture", std::move(scene))) return;
  w.mode = EditMode::pose;
  w.tools.active = ToolId::select;
  const std::vector<Handle> all = handles_of(w.shown.deformation(), w.mode);
  w.selection = Selection(all.begin(), all.end());
}

void switch_mode(Workspace& w) {
  w.mode = w.mode == EditMode::pose ? EditMode::rest : EditMode::pose;
  w.prune_selection();
}

bool converges(const Workspace& w) {
  return w.map().map().energies.size() > 1;
}

}  // namespace

std::vector<Action> cage_actions() {
  return {
      {
          .id = "cage.from_picture",
          .label = "Make from picture",
          .hint = "Fit a cage to the outline of the picture",
          .icon = icon_named("outline"),
          .needs = kNeedsPicture,
          .enabled = has_image,
          .run = cage_from_picture,
      },
      {
          .id = "cage.box",
          .label = "Place",
          .hint = "Put a box around the picture, to move, scale and rotate it",
          .icon = icon_named("fit"),
          .needs = kNeedsPicture,
          .enabled = has_image,
          .run = make_box,
      },
      {
          .id = "cage.rest",
          .label = "Edit rest shape",
          .hint = "Posed points stay while you edit the rest shape; others follow it",
          .keys = {Key::tab},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = switch_mode,
          .checked = [](const Workspace& w) { return w.mode == EditMode::rest; },
      },
      {
          .id = "cage.corner",
          .label = "Smooth or corner",
          .hint = "Make the selected points smooth, or corners if all are smooth",
          .keys = {'C'},
          .needs = "Needs a selected point of the cage",
          .enabled = has_cage_selection,
          .run = toggle_corners,
      },
      {
          .id = "cage.all_corners",
          .label = "All points as corners",
          .hint = "Let the Angles tool turn and open every point",
          .needs = "Needs a cage with points that are not corners",
          .enabled =
              [](const Workspace& w) {
                const Deformation& deformation = w.shown.deformation();
                const auto listed = static_cast<Index>(deformation.corners.size());
                return listed > 0 && listed < deformation.rest.size();
              },
          .run =
              [](Workspace& w) {
                w.commit("All points as corners", with_all_corners(w.shown.deformation()));
              },
      },
      {
          .id = "cage.fill",
          .label = "Fill holes",
          .hint = "Remove the holes with selected points, or all holes of the cage",
          .needs = "Needs a cage with a hole",
          .enabled = [](const Workspace& w) { return w.shown.deformation().rest.has_holes(); },
          .run =
              [](Workspace& w) {
                w.commit("Fill holes", filled(w.shown.deformation(), w.selection));
                w.prune_selection();
              },
      },
      {
          .id = "cage.bake",
          .label = "Apply pins to cage",
          .hint = "Give the cage the pose made by the pins, and switch to the Cage method",
          .needs = "Needs pins, and the method Elastic, whose pins can move the cage",
          .enabled =
              [](const Workspace& w) {
                const Deformation& deformation = w.shown.deformation();
                const std::vector<ParameterSpec>& settings =
                    method_named(deformation.method).parameters;
                return deformation.has_cage() && !deformation.pins.empty() &&
                       std::ranges::find(settings, "own_controls", &ParameterSpec::key) !=
                           settings.end();
              },
          .run = [](Workspace& w) { w.commit("Apply pins to cage", baked(w.shown.deformation())); },
      },
      {
          .id = "cage.raise",
          .label = "Raise degree",
          .hint = "For the selected curves, or for all; they keep their shape",
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run =
              [](Workspace& w) {
                w.commit("Raise degree", raised(w.shown.deformation(), w.selection, w.mode));
              },
      },
      {
          .id = "cage.lower",
          .label = "Lower degree",
          .hint = "Fit curves of lower degree to the selected ones, or to all",
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run =
              [](Workspace& w) {
                w.commit("Lower degree", lowered(w.shown.deformation(), w.selection, w.mode));
              },
      },
      {
          .id = "map.fold_free",
          .label = "Prevent folds",
          .hint = "Keep the picture within limits of size and shape, so that nothing folds",
          .icon = icon_named("check"),
          .needs = "Needs a cage, and a method that may fold",
          .enabled =
              [](const Workspace& w) {
                return has_cage(w) && can_prevent_folds(chosen_method(w.shown.deformation()));
              },
          .run = [](Workspace& w) { prevent_folds(w, !prevents_folds(w.shown.deformation())); },
          .checked = [](const Workspace& w) { return prevents_folds(w.shown.deformation()); },
      },
      {
          .id = "map.play",
          .label = "Play iterations",
          .hint = "Watch the map converge",
          .needs = "Needs a method that iterates",
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
          .label = "Next iteration",
          .needs = "Play the iterations first, or go to the first one",
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
          .label = "First iteration",
          .needs = "Needs a method that iterates",
          .enabled = converges,
          .run = [](Workspace& w) { w.playback = {0}; },
      },
  };
}

}  // namespace holomorph
