// Menus Edit and Tools, and the arrow keys.
#include "edit/actions/groups.h"

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

/// Arrow keys.
template <int dx, int dy, int tenths>
void nudge(Workspace& w) {
  const Complex by(dx * tenths / 10.0, dy * tenths / 10.0);
  w.commit_or_amend("Nudge", displaced(w.shown.deformation(),
                                       displacements(w.shown.deformation(), w.selection, by, w.mode,
                                                     w.tools.drag),
                                       w.mode));
}

template <int up, int down>
void reach(Workspace& w) {
  if (w.tools.active == ToolId::brush) {
    w.tools.brush_radius = std::clamp(w.tools.brush_radius * up / down, kLeastBrush, kMostBrush);
    return;
  }
  w.tools.drag.soft = true;
  w.tools.drag.reach = std::clamp(w.tools.drag.reach * up / down, kLeastReach, kMostReach);
}

void select_all(Workspace& w) {
  const auto all = handles_of(w.shown.deformation(), w.mode);
  w.selection = Selection(all.begin(), all.end());
}

bool has_chosen_key(const Workspace& w) {
  const Deformation& own = w.shown.own();
  return w.shown.timeline.chosen && key_at(own, w.shown.timeline.time) < own.keyframes.size();
}
bool can_erase(const Workspace& w) {
  return has_selection(w) || has_chosen_key(w);
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
  w.commit("Free pin angle", std::move(deformation));
}

bool has_turned_pin(const Workspace& w) {
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::pin && exists(w.shown.deformation(), handle, w.mode) &&
        w.shown.deformation().pins[handle.index].angle)
      return true;
  return false;
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

/// Arrow keys in one direction: by 1, with Shift by 10, with Ctrl by 0.1.
template <int dx, int dy>
void add_nudges(std::vector<Action>& all, const std::string& where, Key key) {
  const auto add = [&](const char* id, const char* by, Modifiers mods, void (*run)(Workspace&)) {
    all.push_back({"edit.nudge_" + where + id,
                   "Nudge " + where + by,
                   "",
                   "",
                   {{key, mods}},
                   has_selection,
                   run});
  };
  add("", "", {}, nudge<dx, dy, 10>);
  add("_10", " by 10", kShift, nudge<dx, dy, 100>);
  add("_fine", " by 0.1", kCtrl, nudge<dx, dy, 1>);
}

// Glyphs of Font Awesome 4.
constexpr const char *kSoft = "\uf192", *kSymmetry = "\uf0ec", *kSnap = "\uf076", *kUndo = "\uf0e2",
                     *kRedo = "\uf01e", *kTrash = "\uf1f8", *kPointer = "\uf245", *kPen = "\uf040",
                     *kPin = "\uf08d", *kOutline = "\uf044", *kAngle = "\uf14e",
                     *kShield = "\uf132", *kStroke = "\uf1fc", *kReset = "\uf0e2";

}  // namespace

namespace {

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
      depth = std::clamp(depth + by, -kMostDepth, kMostDepth);
    }
  w.commit_or_amend(by > 0 ? "Pin up" : "Pin down", std::move(deformation));
}

}  // namespace

std::vector<Action> edit_actions() {
  std::vector<Action> all{
      {"edit.undo", "Undo", kUndo, "Edit", {{'Z', kCtrl}}, can_undo, undo},
      {"edit.redo", "Redo", kRedo, "Edit", {{'Z', kCtrlShift}, {'Y', kCtrl}}, can_redo, redo},
      {"edit.select_all", "Select all", "", "Edit", {{'A', kCtrl}}, has_cage, select_all},
      {"edit.select_none",
       "Select none",
       "",
       "Edit",
       {{'D', kCtrl}},
       has_selection,
       [](Workspace& w) { w.selection.clear(); }},
      {"edit.delete",
       "Delete selection",
       kTrash,
       "Edit",
       {Key::del, Key::backspace},
       can_erase,
       erase_selection<Refit::curve>},
      {"edit.delete_plain",
       "Delete, keep the neighbours' tangents",
       "",
       "Edit",
       {{Key::del, kShift}},
       has_selection,
       erase_selection<Refit::tangents>},
      {"edit.soft",
       "Soft selection: drags take what is near along",
       kSoft,
       "Edit",
       {'O'},
       has_cage,
       [](Workspace& w) { w.tools.drag.soft = !w.tools.drag.soft; },
       [](const Workspace& w) { return w.tools.drag.soft; }},
      {"edit.soft_less",
       "Softness, or the brush, reaches less far",
       "",
       "Edit",
       {'['},
       has_cage,
       reach<4, 5>},
      {"edit.soft_more",
       "Softness, or the brush, reaches farther",
       "",
       "Edit",
       {']'},
       has_cage,
       reach<5, 4>},
      {"edit.symmetry",
       "Symmetry: the other side goes along, mirrored",
       kSymmetry,
       "Edit",
       {'X'},
       has_cage,
       [](Workspace& w) { w.tools.drag.symmetric = !w.tools.drag.symmetric; },
       [](const Workspace& w) { return w.tools.drag.symmetric; }},
      {"edit.snap",
       "Snap: drags stop where things line up",
       kSnap,
       "Edit",
       {'G'},
       has_cage,
       [](Workspace& w) { w.tools.snaps = !w.tools.snaps; },
       [](const Workspace& w) { return w.tools.snaps; }},
      {"edit.reset", "Reset to rest", kReset, "Edit", {'R'}, has_cage, reset_selection},
      {"edit.remove_stiffness",
       "Remove the painted stiffness",
       "",
       "Edit",
       {},
       [](const Workspace& w) { return !w.shown.deformation().stiffness.empty(); },
       [](Workspace& w) {
         Deformation deformation = w.shown.own();
         deformation.stiffness.clear();
         w.commit("Remove stiffness", std::move(deformation), EditBase::document);
       }},
      {"edit.remove_outline",
       "Remove the outline",
       "",
       "Edit",
       {},
       [](const Workspace& w) { return !w.shown.deformation().outline.empty(); },
       [](Workspace& w) {
         Deformation deformation = w.shown.own();
         deformation.outline.clear();
         deformation.surface.reset();
         if (deformation.method == usual_method(MethodUse::outline).id)
           deformation = with_method_for(std::move(deformation), MethodUse::pins);
         w.commit("Remove outline", std::move(deformation), EditBase::document);
       }},
      {"edit.pin_up",
       "Pin up: what is around it over the rest",
       "",
       "Edit",
       {{Key::page_up, kShift}},
       has_pin,
       change_depth<1>},
      {"edit.pin_down",
       "Pin down: what is around it under the rest",
       "",
       "Edit",
       {{Key::page_down, kShift}},
       has_pin,
       change_depth<-1>},
      {"edit.free_angle", "Let pin turn freely", "", "Edit", {}, has_turned_pin, free_pin_angles},
      {"tool.select",
       "Select and move",
       kPointer,
       "Tools",
       {'V'},
       always,
       choose<ToolId::select>,
       chosen<ToolId::select>},
      {"tool.pen",
       "Pen: draw a cage, insert points",
       kPen,
       "Tools",
       {'P'},
       always,
       choose<ToolId::pen>,
       chosen<ToolId::pen>},
      {"tool.pin", "Pin", kPin, "Tools", {'N'}, always, choose<ToolId::pin>, chosen<ToolId::pin>},
      {"tool.stroke",
       "Stroke: draw lines on the picture and reshape them",
       kStroke,
       "Tools",
       {'S'},
       always,
       choose<ToolId::stroke>,
       chosen<ToolId::stroke>},
      {"tool.outline",
       "Outline: draw the shape that the picture goes onto",
       kOutline,
       "Tools",
       {'U'},
       always,
       choose<ToolId::outline>,
       chosen<ToolId::outline>},
      {"tool.angle",
       "Angles: turn corners, open and shut them",
       kAngle,
       "Tools",
       {'A'},
       always,
       choose<ToolId::angle>,
       chosen<ToolId::angle>},
      {"tool.brush",
       "Stiffness: paint what keeps its shape",
       kShield,
       "Tools",
       {'B'},
       always,
       choose<ToolId::brush>,
       chosen<ToolId::brush>},
  };
  add_nudges<-1, 0>(all, "left", Key::left);
  add_nudges<1, 0>(all, "right", Key::right);
  add_nudges<0, 1>(all, "up", Key::up);
  add_nudges<0, -1>(all, "down", Key::down);
  return all;
}

}  // namespace holomorph
