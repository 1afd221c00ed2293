// Declarations that the files of the action table share.
#pragma once

#include "core/maps/method.h"
#include "edit/actions/actions.h"
#include "edit/workspace.h"

namespace holomorph {

std::vector<Action> file_actions();
std::vector<Action> edit_actions();
std::vector<Action> cage_actions();
std::vector<Action> layer_actions();
std::vector<Action> time_actions();
std::vector<Action> view_actions();
/// Actions that last while a key is held. They have no `run`: the window checks their keys.
std::vector<Action> held_actions();

inline constexpr Modifiers kCtrl{true, false, false}, kShift{false, true, false},
    kCtrlShift{true, true, false}, kCtrlAlt{true, false, true};

inline bool always(const Workspace&) {
  return true;
}
// Texts for several actions that are disabled.
inline constexpr char kNeedsPicture[] = "Needs a picture: open one first";
inline constexpr char kNeedsCage[] = "Needs a cage: draw one, or set a pin on a picture";
inline constexpr char kNeedsSelection[] = "Needs a selection";
inline constexpr char kNeedsSurface[] = "Needs a surface: open an OBJ file";

inline bool has_cage(const Workspace& w) {
  return w.shown.deformation().has_cage();
}
/// Whether there are other methods to compare the deformation's method with.
inline bool can_be_compared(const Deformation& deformation) {
  const Method& method = method_named(deformation.method);
  return method.follows_others || (method.comparable && !deformation.pins.empty());
}
inline bool has_surface(const Workspace& w) {
  return w.shown.deformation().surface.has_value();
}
inline bool has_content(const Workspace& w) {
  return !w.document.empty();
}
inline bool has_selection(const Workspace& w) {
  return !w.selection.empty();
}
inline bool plays(const Workspace& w) {
  return plays(w.document.scene());
}
template <Request request>
void ask(Workspace& w) {
  w.request = request;
}

}  // namespace holomorph
