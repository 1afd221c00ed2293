// Undo, selection, tools, pins, and the arrow keys.
#include "edit/actions/groups.h"
#include "edit/actions/icons.h"
#include "edit/edits/method_edits.h"
#include "edit/frame.h"
#include "edit/hold_rest.h"

namespace holomorph {
namespace {

template <ToolId tool>
void choose(Workspace& w) {
  w.tools.active = tool;
}
template <ToolId tool>
bool chosen(const Workspace& w) {
  return w.tools.active == tool;
}

/// Moves the selection by (dx, dy) times `tenths` tenths of a pixel of the picture.
template <int dx, int dy, int tenths>
void nudge(Workspace& w) {
  // Up is up on the canvas, also in a layer that another one has rotated.
  const Complex by =
      std::conj(w.layer_view().turn) * Complex(dx * tenths / 10.0, dy * tenths / 10.0);
  w.commit_or_amend("Nudge", displaced(w.shown.deformation(),
                                       displacements(w.shown.deformation(), w.selection, by, w.mode,
                                                     w.tools.drag),
                                       w.mode));
}

template <int up, int down>
void scale_radius(Workspace& w) {
  if (w.tools.active == ToolId::brush) {
    w.tools.brush_radius =
        std::clamp(w.tools.brush_radius * up / down, kMinBrushRadius, kMaxBrushRadius);
    return;
  }
  w.tools.drag.soft = true;
  w.tools.drag.reach = std::clamp(w.tools.drag.reach * up / down, kMinReach, kMaxReach);
}

void select_all(Workspace& w) {
  const auto all = handles_of(w.shown.deformation(), w.mode);
  w.selection = Selection(all.begin(), all.end());
}

bool can_erase(const Workspace& w) {
  return has_selection(w) || !w.shown.timeline.keys.empty();
}
template <Refit refit>
void erase_selection(Workspace& w) {
  if (has_selection(w))
    w.erase(Selection(w.selection), refit);
  else
    run("time.delete_key", w);
}

void reset_selection(Workspace& w) {
  w.commit(w.selection.empty() ? "Reset pose" : "Reset selection",
           reset(w.shown.deformation(), w.selection));
}

void free_pin_angles(Workspace& w) {
  Deformation deformation = w.shown.deformation();
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::pin) deformation.pins[handle.index].angle.reset();
  w.commit("Free rotation", std::move(deformation));
}

bool has_turned_pin(const Workspace& w) {
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::pin && exists(w.shown.deformation(), handle, w.mode) &&
        w.shown.deformation().pins[handle.index].angle)
      return true;
  return false;
}

bool has_turns(const Workspace& w) {
  return std::ranges::any_of(w.shown.deformation().pins,
                             [](const Pin& pin) { return pin.turn.value_or(0) != 0; });
}

void untwist(Workspace& w) {
  Deformation deformation = w.shown.deformation();
  for (Pin& pin : deformation.pins) pin.turn.reset();
  w.commit("Untwist", std::move(deformation));
}

bool can_undo(const Workspace& w) {
  return !w.shown.preview && w.document.history().can_undo();
}
bool can_redo(const Workspace& w) {
  return !w.shown.preview && w.document.history().can_redo();
}
void undo(Workspace& w) {
  w.go_to(w.document.history().index() - 1);
}
void redo(Workspace& w) {
  w.go_to(w.document.history().index() + 1);
}

/// Adds the nudges for one arrow key: by 1 pixel, with Shift by 10, with Ctrl by 0.1.
template <int dx, int dy>
void add_nudges(std::vector<Action>& all, const std::string& where, Key key) {
  const auto add = [&](const char* id, const char* by, Modifiers mods, void (*run)(Workspace&)) {
    all.push_back({.id = "edit.nudge_" + where + id,
                   .label = "Nudge " + where + by,
                   .keys = {{key, mods}},
                   .needs = kNeedsSelection,
                   .enabled = has_selection,
                   .run = run});
  };
  add("", "", {}, nudge<dx, dy, 10>);
  add("_10", " by 10", kShift, nudge<dx, dy, 100>);
  add("_fine", " by 0.1", kCtrl, nudge<dx, dy, 1>);
}

bool has_pin(const Workspace& w) {
  return std::ranges::any_of(w.selection,
                             [](const Handle& handle) { return handle.kind == Handle::Kind::pin; });
}

template <int by>
void change_depth(Workspace& w) {
  Deformation deformation = w.shown.deformation();
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::pin && exists(deformation, handle, w.mode)) {
      int& depth = deformation.pins[static_cast<size_t>(handle.index)].depth;
      depth = std::clamp(depth + by, -kMaxDepth, kMaxDepth);
    }
  w.commit_or_amend(by > 0 ? "Bring pin forward" : "Send pin back", std::move(deformation));
}

}  // namespace

std::vector<Action> edit_actions() {
  std::vector<Action> all{
      {
          .id = "edit.undo",
          .label = "Undo",
          .icon = icon_named("undo"),
          .keys = {{'Z', kCtrl}},
          .needs = "There is nothing to undo",
          .enabled = can_undo,
          .run = undo,
      },
      {
          .id = "edit.redo",
          .label = "Redo",
          .icon = icon_named("redo"),
          .keys = {{'Z', kCtrlShift}, {'Y', kCtrl}},
          .needs = "There is nothing to redo",
          .enabled = can_redo,
          .run = redo,
      },
      {
          .id = "edit.select_all",
          .label = "Select all",
          .keys = {{'A', kCtrl}},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = select_all,
      },
      {
          .id = "edit.select_none",
          .label = "Select none",
          .keys = {{'D', kCtrl}},
          .needs = kNeedsSelection,
          .enabled = has_selection,
          .run = [](Workspace& w) { w.selection.clear(); },
      },
      {
          .id = "edit.delete",
          .label = "Delete",
          .hint = "Delete the selected points, pins, strokes or keyframe",
          .icon = icon_named("trash"),
          .keys = {Key::del, Key::backspace},
          .needs = kNeedsSelection,
          .enabled = can_erase,
          .run = erase_selection<Refit::curve>,
      },
      {
          .id = "edit.delete_plain",
          .label = "Delete, keep tangents",
          .hint = "Delete points without refitting the curve; the neighbors keep their tangents",
          .keys = {{Key::del, kShift}},
          .needs = kNeedsSelection,
          .enabled = has_selection,
          .run = erase_selection<Refit::tangents>,
      },
      {
          .id = "edit.soft",
          .label = "Soft selection",
          .hint = "Nearby points follow a drag, less the farther away they are",
          .icon = icon_named("soft"),
          .keys = {'O'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = [](Workspace& w) { w.tools.drag.soft = !w.tools.drag.soft; },
          .checked = [](const Workspace& w) { return w.tools.drag.soft; },
      },
      {
          .id = "edit.soft_less",
          .label = "Smaller radius",
          .hint = "Shrink the brush, or the radius of soft selection",
          .keys = {'['},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = scale_radius<4, 5>,
      },
      {
          .id = "edit.soft_more",
          .label = "Larger radius",
          .hint = "Enlarge the brush, or the radius of soft selection",
          .keys = {']'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = scale_radius<5, 4>,
      },
      {
          .id = "edit.symmetry",
          .label = "Symmetry",
          .hint = "The counterpart on the other side moves as a mirror image",
          .icon = icon_named("symmetry"),
          .keys = {'X'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = [](Workspace& w) { w.tools.drag.symmetric = !w.tools.drag.symmetric; },
          .checked = [](const Workspace& w) { return w.tools.drag.symmetric; },
      },
      {
          .id = "edit.snap",
          .label = "Snap",
          .hint = "Dragged points stop where they line up",
          .icon = icon_named("snap"),
          .keys = {'G'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = [](Workspace& w) { w.tools.snaps = !w.tools.snaps; },
          .checked = [](const Workspace& w) { return w.tools.snaps; },
      },
      {
          .id = "edit.reset",
          .label = "Reset to rest",
          .hint = "Reset the selection, or everything if nothing is selected",
          .icon = icon_named("reset"),
          .keys = {'R'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = reset_selection,
      },
      {
          .id = "edit.untwist",
          .label = "Untwist",
          .hint =
              "Discard the stored rotations of parts and use the pose with the least distortion",
          .needs = "Needs pins that have turned",
          .enabled = has_turns,
          .run = untwist,
      },
      {
          .id = "edit.remove_stiffness",
          .label = "Remove stiffness",
          .hint = "Clear everything that the brush painted",
          .needs = "Needs painted stiffness",
          .enabled = [](const Workspace& w) { return !w.shown.deformation().stiffness.empty(); },
          .run =
              [](Workspace& w) {
                Deformation deformation = w.shown.own();
                deformation.stiffness.clear();
                w.commit("Remove stiffness", std::move(deformation), EditBase::document);
              },
      },
      {
          .id = "edit.remove_outline",
          .label = "Remove outline",
          .hint = "Return to the cage and pins",
          .needs = "Needs a drawn outline",
          .enabled = [](const Workspace& w) { return !w.shown.deformation().outline.empty(); },
          .run =
              [](Workspace& w) {
                Deformation deformation = w.shown.own();
                deformation.outline.clear();
                deformation.surface.reset();
                if (deformation.method == usual_method(MethodUse::outline).id)
                  deformation = with_method_for(std::move(deformation), MethodUse::pins);
                w.commit("Remove outline", std::move(deformation), EditBase::document);
              },
      },
      {
          .id = "edit.pin_up",
          .label = "Bring pin forward",
          .hint = "Draw the parts near the pin over other parts",
          .keys = {{Key::page_up, kShift}},
          .needs = "Needs a selected pin",
          .enabled = has_pin,
          .run = change_depth<1>,
      },
      {
          .id = "edit.pin_down",
          .label = "Send pin back",
          .hint = "Draw the parts near the pin under other parts",
          .keys = {{Key::page_down, kShift}},
          .needs = "Needs a selected pin",
          .enabled = has_pin,
          .run = change_depth<-1>,
      },
      {
          .id = "edit.hold_rest",
          .label = "Hold the rest",
          .hint = "Set pins far from a single one. In a photograph, hold what is far from all pins",
          .icon = icon_named("pin"),
          .needs = "Needs a single pin, or pins in a photograph, in pose mode",
          .enabled = can_hold_rest,
          .run = hold_rest,
      },
      {
          .id = "edit.let_go",
          .label = "Let the rest go",
          .hint = "Let the pins move all of the photograph again",
          .icon = icon_named("pin"),
          .needs = "Needs a photograph in which pins hold the rest",
          .enabled =
              [](const Workspace& w) {
                return can_choose_frame(w) && w.shown.deformation().held_beyond.has_value();
              },
          .run = let_go,
      },
      {
          .id = "edit.free_angle",
          .label = "Free rotation",
          .hint = "The selected pins no longer fix rotation and scale",
          .needs = "Needs a selected pin whose rotation is fixed",
          .enabled = has_turned_pin,
          .run = free_pin_angles,
      },
      {
          .id = "tool.select",
          .label = "Select and move",
          .icon = icon_named("select"),
          .keys = {'V'},
          .enabled = always,
          .run = choose<ToolId::select>,
          .checked = chosen<ToolId::select>,
      },
      {
          .id = "tool.pen",
          .label = "Pen",
          .hint = "Draw a cage, or insert points into it",
          .icon = icon_named("pen"),
          .keys = {'P'},
          .enabled = always,
          .run = choose<ToolId::pen>,
          .checked = chosen<ToolId::pen>,
      },
      {
          .id = "tool.pin",
          .label = "Pin",
          .hint = "Set pins and drag them",
          .icon = icon_named("pin"),
          .keys = {'N'},
          .enabled = always,
          .run = choose<ToolId::pin>,
          .checked = chosen<ToolId::pin>,
      },
      {
          .id = "tool.stroke",
          .label = "Stroke",
          .hint = "Draw lines on the picture and reshape them",
          .icon = icon_named("stroke"),
          .keys = {'S'},
          .enabled = always,
          .run = choose<ToolId::stroke>,
          .checked = chosen<ToolId::stroke>,
      },
      {
          .id = "tool.outline",
          .label = "Outline",
          .hint = "Draw the shape that the cage takes",
          .icon = icon_named("outline"),
          .keys = {'U'},
          .enabled = always,
          .run = choose<ToolId::outline>,
          .checked = chosen<ToolId::outline>,
      },
      {
          .id = "tool.angle",
          .label = "Angles",
          .hint = "Turn corners, and open or close them",
          .icon = icon_named("angle"),
          .keys = {'A'},
          .enabled = always,
          .run = choose<ToolId::angle>,
          .checked = chosen<ToolId::angle>,
      },
      {
          .id = "tool.brush",
          .label = "Stiffness brush",
          .hint = "Paint parts that keep their shape",
          .icon = icon_named("brush"),
          .keys = {'B'},
          .enabled = always,
          .run = choose<ToolId::brush>,
          .checked = chosen<ToolId::brush>,
      },
  };
  add_nudges<-1, 0>(all, "left", Key::left);
  add_nudges<1, 0>(all, "right", Key::right);
  add_nudges<0, 1>(all, "up", Key::up);
  add_nudges<0, -1>(all, "down", Key::down);
  return all;
}

}  // namespace holomorph
