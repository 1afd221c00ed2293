// Each row is a sentence: what it is called, when it can be done, what it does.
#include "edit/actions.h"

#include "core/error.h"
#include "edit/corner_edits.h"
#include "edit/curve_edits.h"
#include "edit/tool.h"
#include "scene/auto_cage.h"

namespace holomorph {
namespace {

constexpr Modifiers kCtrl{true, false, false}, kShift{false, true, false},
    kCtrlShift{true, true, false};

bool always(const Workspace&) {
  return true;
}
bool has_cage(const Workspace& w) {
  return w.scene().has_cage();
}
bool has_surface(const Workspace& w) {
  return w.scene().surface.has_value();
}
bool has_content(const Workspace& w) {
  return w.scene().has_cage() || w.document.image();
}
bool has_image(const Workspace& w) {
  return w.document.image() != nullptr;
}
bool has_cage_selection(const Workspace& w) {
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::cage && handle.control == 0) return true;
  return false;
}
bool has_selection(const Workspace& w) {
  return !w.selection.empty();
}

bool has_keys(const Workspace& w) {
  return !w.document.scene().keyframes.empty();
}
bool plays(const Workspace& w) {
  return playing_keys(w.document.scene()).size() > 1;
}
bool has_copied(const Workspace& w) {
  return w.copied && fits(w.scene(), *w.copied);
}
std::optional<size_t> key_here(const Workspace& w) {
  const size_t key = key_at(w.document.scene(), w.timeline.time);
  return key < w.document.scene().keyframes.size() ? std::optional(key) : std::nullopt;
}
template <int by>
void step_frame(Workspace& w) {
  w.timeline.playing = false;
  const Scene& scene = w.document.scene();
  w.go_to_time(time_of_frame(scene, frame_at(scene, w.timeline.time) + by));
}
template <bool forwards>
void step_key(Workspace& w) {
  w.timeline.playing = false;
  if (const auto time = next_key(w.document.scene(), w.timeline.time, forwards))
    w.go_to_time(*time);
}

template <Request request>
void ask(Workspace& w) {
  w.request = request;
}

template <ToolId tool>
void choose(Workspace& w) {
  w.tool = tool;
}
template <ToolId tool>
bool chosen(const Workspace& w) {
  return w.tool == tool;
}

template <View view>
void look(Workspace& w) {
  w.view = view;
}
template <View view>
bool looks(const Workspace& w) {
  return w.view == view;
}

void zoom_by(Workspace& w, double factor) {
  w.viewport.zoom_at(
      {w.viewport.left + w.viewport.width / 2, w.viewport.top + w.viewport.height / 2}, factor);
}

void frame_selection(Workspace& w) {
  Box box;
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::stroke)
      for (const Complex& z : curve_of(w.scene(), handle.index, w.layer)) box.include(z);
    else
      box.include(position_of(w.scene(), handle, w.layer));
  const double least = 60;  // one point alone is shown with its surroundings
  if (!box.empty()) {
    const Complex center = box.center();
    box.include(center + Complex(least, least));
    box.include(center - Complex(least, least));
  }
  w.viewport.fit(box.empty() ? w.content_box() : box);
}

/// Arrow keys.
template <int dx, int dy, int tenths>
void nudge(Workspace& w) {
  const Complex by(dx * tenths / 10.0, dy * tenths / 10.0);
  w.commit_or_amend("Nudge", moved(w.scene(), w.selection, by, w.layer));
}

void select_all(Workspace& w) {
  const auto all = handles_of(w.scene(), w.layer);
  w.selection = Selection(all.begin(), all.end());
}

template <Refit refit>
void erase_selection(Workspace& w) {
  w.erase(Selection(w.selection), refit);
}

void make_cage(Workspace& w) {
  Cage cage = auto_cage(*w.document.image(),
                        {w.auto_cage_vertices, w.auto_cage_margin, w.auto_cage_curved});
  if (w.commit("Cage from picture", with_cage(w.document.scene(), std::move(cage)))) {
    w.layer = Layer::pose;
    w.tool = ToolId::select;
    w.selection.clear();
  }
}

void switch_layer(Workspace& w) {
  w.layer = w.layer == Layer::pose ? Layer::rest : Layer::pose;
  w.prune_selection();
}

void reset_selection(Workspace& w) {
  w.commit(w.selection.empty() ? "Reset pose" : "Reset selection", reset(w.scene(), w.selection));
}

void free_pin_angles(Workspace& w) {
  Scene scene = w.scene();
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::pin) scene.pins[handle.index].angle.reset();
  w.commit("Free pin angle", scene);
}
bool converges(const Workspace& w) {
  return w.map.map().energies.size() > 1;
}
bool has_turned_pin(const Workspace& w) {
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::pin && exists(w.scene(), handle, w.layer) &&
        w.scene().pins[handle.index].angle)
      return true;
  return false;
}

bool can_undo(const Workspace& w) {
  return !w.preview && w.document.history().can_undo();
}
bool can_redo(const Workspace& w) {
  return !w.preview && w.document.history().can_redo();
}
void undo(Workspace& w) {
  w.go_to(w.document.history().index() - 1);
}
void redo(Workspace& w) {
  w.go_to(w.document.history().index() + 1);
}

// Glyphs of Font Awesome 4.
constexpr const char *kNew = "\uf016", *kOpen = "\uf07c", *kSave = "\uf0c7", *kExport = "\uf1c5",
                     *kUndo = "\uf0e2", *kRedo = "\uf01e", *kTrash = "\uf1f8", *kPointer = "\uf245",
                     *kPen = "\uf040", *kPin = "\uf08d", *kOutline = "\uf044", *kAngle = "\uf01e",
                     *kPlay = "\uf04b", *kBack = "\uf048", *kForward = "\uf051", *kFirst = "\uf049",
                     *kLast = "\uf050", *kKey = "\uf084", *kRecord = "\uf111", *kLoop = "\uf079",
                     *kOnion = "\uf24d", *kFilm = "\uf008", *kStroke = "\uf1fc", *kMagic = "\uf0d0",
                     *kFit = "\uf065", *kHelp = "\uf059", *kReset = "\uf0e2", *kSearch = "\uf002";

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

std::vector<Action> table() {
  return {
      {"file.new", "New", kNew, "File", {{'N', kCtrl}}, always, ask<Request::new_scene>},
      {"file.open", "Open...", kOpen, "File", {{'O', kCtrl}}, always, ask<Request::open>},
      {"file.save", "Save", kSave, "File", {{'S', kCtrl}}, has_content, ask<Request::save>},
      {"file.save_as",
       "Save as...",
       "",
       "File",
       {{'S', kCtrlShift}},
       has_content,
       ask<Request::save_as>},
      {"file.export",
       "Export PNG...",
       kExport,
       "File",
       {{'E', kCtrl}},
       has_content,
       ask<Request::export_picture>},
      {"file.export_again",
       "Export again",
       "",
       "File",
       {{'E', kCtrlShift}},
       has_content,
       ask<Request::export_again>},
      {"file.import_cage", "Cage from SVG...", "", "File", {}, always, ask<Request::import_cage>},
      {"file.import_outline",
       "Outline from SVG, picture or OBJ...",
       "",
       "File",
       {},
       has_cage,
       ask<Request::import_outline>},
      {"file.import_pose",
       "Posed cage from SVG...",
       "",
       "File",
       {},
       has_cage,
       ask<Request::import_pose>},
      {"file.export_film",
       "Export film of the keyframes...",
       "",
       "File",
       {},
       plays,
       ask<Request::export_film>},
      {"file.export_svg",
       "Export cage as SVG...",
       "",
       "File",
       {},
       has_cage,
       ask<Request::export_svg>},
      {"file.export_surface",
       "Export textured surface...",
       "",
       "File",
       {},
       has_surface,
       ask<Request::export_surface>},
      {"file.quit", "Quit", "", "File", {{'Q', kCtrl}}, always, ask<Request::quit>},

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
       has_selection,
       erase_selection<Refit::curve>},
      {"edit.delete_plain",
       "Delete, keep the neighbours' tangents",
       "",
       "Edit",
       {{Key::del, kShift}},
       has_selection,
       erase_selection<Refit::tangents>},
      {"edit.reset", "Reset to rest", kReset, "Edit", {'R'}, has_cage, reset_selection},
      {"edit.remove_outline",
       "Remove the outline",
       "",
       "Edit",
       {},
       [](const Workspace& w) { return !w.scene().outline.empty(); },
       [](Workspace& w) {
         Scene scene = w.document.scene();
         scene.outline.clear();
         scene.surface.reset();
         if (scene.method == "outline") scene = with_method(std::move(scene), "pins");
         w.commit("Remove outline", scene);
       }},
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
       {'O'},
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

      {"cage.from_picture", "Make from picture", kMagic, "Cage", {}, has_image, make_cage},
      {"cage.rest",
       "Show and edit the rest shape",
       "",
       "Cage",
       {Key::tab},
       has_cage,
       switch_layer,
       [](const Workspace& w) { return w.layer == Layer::rest; }},

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
       [](const Workspace& w) { return !w.scene().corners.empty(); },
       [](Workspace& w) { w.commit("All corners", with_all_corners(w.scene())); }},
      {"cage.bake",
       "Pose the cage as the pins do",
       "",
       "Cage",
       {},
       [](const Workspace& w) {
         return w.scene().has_cage() && method_named(w.scene().method).uses_pins &&
                !w.scene().pins.empty();
       },
       [](Workspace& w) { w.commit("Pose by pins", baked(w.scene())); }},
      {"cage.raise",
       "Raise the curves' degree",
       "",
       "Cage",
       {},
       has_cage,
       [](Workspace& w) { w.commit("Raise degree", raised(w.scene(), w.selection, w.layer)); }},
      {"cage.lower",
       "Lower the curves' degree",
       "",
       "Cage",
       {},
       has_cage,
       [](Workspace& w) { w.commit("Lower degree", lowered(w.scene(), w.selection, w.layer)); }},

      {"map.fold_free",
       "Make it fold-free",
       "",
       "Cage",
       {},
       [](const Workspace& w) {
         return w.document.scene().has_cage() && w.scene().method != "bounded";
       },
       [](Workspace& w) { w.commit("Make fold-free", fold_free(w.scene())); }},
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
         const int last = static_cast<int>(w.map.map().energies.size()) - 1,
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

      {"time.play",
       "Play",
       kPlay,
       "Time",
       {Key::space},
       plays,
       [](Workspace& w) {
         w.preview.reset();
         w.timeline.playing = !w.timeline.playing;
         w.timeline.clock_ms.reset();
         if (w.timeline.time >= length_of(w.document.scene()) - 1e-6) w.timeline.time = 0;
       },
       [](const Workspace& w) { return w.timeline.playing; }},
      {"time.back", "One frame back", kBack, "Time", {','}, has_keys, step_frame<-1>},
      {"time.forward", "One frame on", kForward, "Time", {'.'}, has_keys, step_frame<1>},
      {"time.previous_key",
       "Previous key",
       kFirst,
       "Time",
       {{',', kShift}, {'<', kShift}},
       has_keys,
       step_key<false>},
      {"time.next_key",
       "Next key",
       kLast,
       "Time",
       {{'.', kShift}, {'>', kShift}},
       has_keys,
       step_key<true>},
      {"time.key", "Set a key", kKey, "Time", {'I'}, has_cage, [](Workspace& w) { w.set_key(); }},
      {"time.delete_key",
       "Delete the key at this time",
       "",
       "Time",
       {},
       [](const Workspace& w) { return key_here(w).has_value(); },
       [](Workspace& w) { w.commit("Delete key", without_key(w.document.scene(), *key_here(w))); }},
      {"time.auto_key",
       "Auto-key: edits of the pose set keys",
       kRecord,
       "Time",
       {'K'},
       has_cage,
       [](Workspace& w) {
         w.timeline.auto_key = !w.timeline.auto_key;
         w.timeline.visible = w.timeline.visible || w.timeline.auto_key;
       },
       [](const Workspace& w) { return w.timeline.auto_key; }},
      {"time.loop",
       "Loop",
       kLoop,
       "Time",
       {},
       has_cage,
       [](Workspace& w) { w.timeline.loop = !w.timeline.loop; },
       [](const Workspace& w) { return w.timeline.loop; }},
      {"time.onion",
       "Onion skin: the keys before and after",
       kOnion,
       "Time",
       {},
       has_cage,
       [](Workspace& w) { w.timeline.onion = !w.timeline.onion; },
       [](const Workspace& w) { return w.timeline.onion; }},
      {"time.copy",
       "Copy pose",
       "",
       "Time",
       {{'C', kCtrl}},
       has_cage,
       [](Workspace& w) {
         w.copied = whole_pose_of(w.scene());
         w.say("The pose is copied.");
       }},
      {"time.paste",
       "Paste pose",
       "",
       "Time",
       {{'V', kCtrl}},
       has_copied,
       [](Workspace& w) { w.commit("Paste pose", posed_as(w.scene(), *w.copied)); }},
      {"time.paste_mirrored",
       "Paste pose, mirrored",
       "",
       "Time",
       {{'V', kCtrlShift}},
       has_copied,
       [](Workspace& w) {
         w.commit("Paste mirrored pose", posed_as(w.scene(), mirrored(w.scene(), *w.copied)));
       }},

      {"view.image", "Picture", "", "View", {'1'}, always, look<View::image>, looks<View::image>},
      {"view.angle",
       "Angle distortion",
       "",
       "View",
       {'2'},
       has_cage,
       look<View::angle>,
       looks<View::angle>},
      {"view.area", "Area", "", "View", {'3'}, has_cage, look<View::area>, looks<View::area>},
      {"view.stretch",
       "Largest stretch",
       "",
       "View",
       {'4'},
       has_cage,
       look<View::stretch>,
       looks<View::stretch>},
      {"view.checker",
       "Checker",
       "",
       "View",
       {'5'},
       has_cage,
       look<View::checker>,
       looks<View::checker>},
      {"view.compare",
       "Compare with other projections",
       "",
       "View",
       {},
       [](const Workspace& w) {
         return w.document.scene().has_cage() && w.scene().method == "bounded";
       },
       ask<Request::compare>},
      {"view.mesh",
       "Mesh",
       "",
       "View",
       {'M'},
       has_cage,
       [](Workspace& w) { w.show_mesh = !w.show_mesh; },
       [](const Workspace& w) { return w.show_mesh; }},
      {"view.timeline",
       "Timeline",
       kFilm,
       "View",
       {'T'},
       has_cage,
       [](Workspace& w) { w.timeline.visible = !w.timeline.visible; },
       [](const Workspace& w) { return w.timeline.visible; }},
      {"view.surface",
       "Surface in space",
       "",
       "View",
       {},
       has_surface,
       [](Workspace& w) { w.show_surface = !w.show_surface; },
       [](const Workspace& w) { return w.shows_surface(); }},
      {"view.overlays",
       "Cage and pins",
       "",
       "View",
       {'0'},
       always,
       [](Workspace& w) { w.show_cage = !w.show_cage; },
       [](const Workspace& w) { return w.show_cage; }},
      {"view.frame", "Frame selection", "", "View", {'F'}, has_content, frame_selection},
      {"view.fit",
       "Fit all",
       kFit,
       "View",
       {{'F', kShift}, {'0', kCtrl}},
       has_content,
       [](Workspace& w) { w.viewport.fit(w.content_box()); }},
      {"view.actual",
       "100 %",
       "",
       "View",
       {{'1', kCtrl}},
       has_content,
       [](Workspace& w) { zoom_by(w, 1 / w.viewport.zoom); }},
      {"view.zoom_in",
       "Zoom in",
       "",
       "View",
       {'+', '=', {'=', kCtrl}, {'+', kCtrl}, {'=', kCtrlShift}},
       has_content,
       [](Workspace& w) { zoom_by(w, 1.25); }},
      {"view.zoom_out",
       "Zoom out",
       "",
       "View",
       {'-', {'-', kCtrl}},
       has_content,
       [](Workspace& w) { zoom_by(w, 0.8); }},

      {"help.palette",
       "Find an action...",
       kSearch,
       "Help",
       {{'P', kCtrlShift}},
       always,
       ask<Request::palette>},
      {"help.keys",
       "Keys and mouse",
       kHelp,
       "Help",
       {Key::f1, '?', {'?', kShift}},
       always,
       ask<Request::help>},
  };
}

}  // namespace

const std::vector<Action>& actions() {
  static const std::vector<Action> all = [] {
    std::vector<Action> rows = table();
    add_nudges<-1, 0>(rows, "left", Key::left);
    add_nudges<1, 0>(rows, "right", Key::right);
    add_nudges<0, 1>(rows, "up", Key::up);
    add_nudges<0, -1>(rows, "down", Key::down);
    return rows;
  }();
  return all;
}

const Action& action_named(const std::string& id) {
  for (const Action& action : actions())
    if (action.id == id) return action;
  check(false, "an action is asked for that the table does not have");
  return actions()[0];
}

const Action* action_for(const Shortcut& shortcut, const Workspace& workspace) {
  for (const Action& action : actions())
    for (const Shortcut& key : action.keys)
      if (key == shortcut && action.enabled(workspace)) return &action;
  return nullptr;
}

void run(const Action& action, Workspace& workspace) {
  if (!action.enabled(workspace)) return;
  try {
    action.run(workspace);
  } catch (const Error& error) {
    workspace.complain(error);
  }
}

std::string label_with_keys(const Action& action) {
  if (action.keys.empty()) return action.label;
  return action.label + " (" + text_of(action.keys[0]) + ")";
}

}  // namespace holomorph
