// Menus View and Help.
#include "edit/actions/groups.h"
#include "edit/tools/posed_corners.h"

namespace holomorph {
namespace {

template <View view>
void look(Workspace& w) {
  w.display.view = view;
}
template <View view>
bool looks(const Workspace& w) {
  return w.display.view == view;
}

void zoom_by(Workspace& w, double factor) {
  w.display.viewport.zoom_at({w.display.viewport.left + w.display.viewport.width / 2,
                              w.display.viewport.top + w.display.viewport.height / 2},
                             factor);
}

/// Corners with angles are where the picture is, not the cage.
Complex shown_place(const Workspace& w, const Handle& handle) {
  const bool corner = w.tools.active == ToolId::angle && w.mode == EditMode::pose &&
                      handle.kind == Handle::Kind::cage && handle.control == 0;
  return corner ? posed_vertex(w, handle.index)
                : position_of(w.shown.deformation(), handle, w.mode);
}

void frame_selection(Workspace& w) {
  Box box;
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::stroke)
      for (const Complex& z : curve_of(w.shown.deformation(), handle.index, w.mode)) box.include(z);
    else
      box.include(shown_place(w, handle));
  const double least = 60;  // one point alone is shown with its surroundings
  if (!box.empty()) {
    const Complex center = box.center();
    box.include(center + Complex(least, least));
    box.include(center - Complex(least, least));
  }
  w.display.viewport.fit(box.empty() ? content_box(w) : box);
}

// Glyphs of Font Awesome 4.
constexpr const char *kHalves = "\uf042", *kFilm = "\uf008", *kFit = "\uf065", *kHelp = "\uf059",
                     *kSearch = "\uf002";

}  // namespace

std::vector<Action> view_actions() {
  return {
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
         return w.shown.own().has_cage() && w.shown.deformation().method == "bounded";
       },
       ask<Request::compare>},
      {"view.fold",
       "Go to the worst fold, and on to the next",
       "",
       "View",
       {'W'},
       [](const Workspace& w) { return w.map().has_map(); },
       [](Workspace& w) { w.show_next_fold(); }},
      {"view.before_after",
       "Before and after, side by side",
       kHalves,
       "View",
       {{'\\', kShift}, {'|', kShift}},
       has_cage,
       [](Workspace& w) { w.display.split = w.display.split ? std::nullopt : std::optional(0.5); },
       [](const Workspace& w) { return w.display.split.has_value(); }},
      {"view.mesh",
       "Mesh",
       "",
       "View",
       {'M'},
       has_cage,
       [](Workspace& w) { w.display.show_mesh = !w.display.show_mesh; },
       [](const Workspace& w) { return w.display.show_mesh; }},
      {"view.timeline",
       "Timeline",
       kFilm,
       "View",
       {'T'},
       has_cage,
       [](Workspace& w) { w.shown.timeline.visible = !w.shown.timeline.visible; },
       [](const Workspace& w) { return w.shown.timeline.visible; }},
      {"view.surface",
       "Surface in space",
       "",
       "View",
       {},
       has_surface,
       [](Workspace& w) { w.display.show_surface = !w.display.show_surface; },
       [](const Workspace& w) { return w.shows_surface(); }},
      {"view.overlays",
       "Cage and pins",
       "",
       "View",
       {'0'},
       always,
       [](Workspace& w) { w.display.show_cage = !w.display.show_cage; },
       [](const Workspace& w) { return w.display.show_cage; }},
      {"view.frame", "Frame selection", "", "View", {'F'}, has_content, frame_selection},
      {"view.fit",
       "Fit all",
       kFit,
       "View",
       {{'F', kShift}, {'0', kCtrl}},
       has_content,
       [](Workspace& w) { w.display.viewport.fit(content_box(w)); }},
      {"view.actual",
       "100 %",
       "",
       "View",
       {{'1', kCtrl}},
       has_content,
       [](Workspace& w) { zoom_by(w, 1 / w.display.viewport.zoom); }},
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
      {"edit.context_menu",
       "Menu of what is selected",
       "",
       "Edit",
       {{Key::f10, kShift}},
       has_content,
       ask<Request::context_menu>},
      {"view.menu", "Keys go to the menu", "", "View", {Key::f10}, always, ask<Request::menu>},
      {"view.next_panel",
       "Keys go to the next panel",
       "",
       "View",
       {Key::f6},
       always,
       ask<Request::next_panel>},
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

std::vector<Action> held_actions() {
  return {
      {"hold.overlays", "Hold: hide cage and pins", "", "", {'H'}, always, nullptr},
      {"hold.original", "Hold: show the original picture", "", "", {'\\'}, always, nullptr},
      {"hold.alt",
       "Hold: as Alt, where the desktop takes Alt itself",
       "",
       "",
       {'Q'},
       always,
       nullptr},
  };
}

}  // namespace holomorph
