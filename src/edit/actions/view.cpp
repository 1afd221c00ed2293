// The View and Help menus.
#include "edit/actions/groups.h"
#include "edit/actions/icons.h"
#include "edit/content.h"
#include "edit/tools/posed_corners.h"

namespace holomorph {
namespace {

template <View view>
void set_view(Workspace& w) {
  w.display.view = view;
}
template <View view>
bool has_view(const Workspace& w) {
  return w.display.view == view;
}

void zoom_by(Workspace& w, double factor) {
  w.display.viewport.zoom_at({w.display.viewport.left + w.display.viewport.width / 2,
                              w.display.viewport.top + w.display.viewport.height / 2},
                             factor);
}

/// The plane position at which a handle is drawn. The angle tool draws corners at their images
/// under the map, not at the points of the posed cage.
Complex displayed_position(const Workspace& w, const Handle& handle) {
  const bool corner = w.tools.active == ToolId::angle && w.mode == EditMode::pose &&
                      handle.kind == Handle::Kind::cage && handle.control == 0;
  return corner ? posed_vertex(w, handle.index)
                : position_of(w.shown.deformation(), handle, w.mode);
}

void frame_selection(Workspace& w) {
  Box box;
  const Similarity placed = w.at_rest() ? Similarity{} : w.placement(w.document.scene().edited);
  for (const Handle& handle : w.selection)
    if (handle.kind == Handle::Kind::stroke)
      for (const Complex& z : curve_of(w.shown.deformation(), handle.index, w.mode))
        box.include(placed(z));
    else
      box.include(placed(displayed_position(w, handle)));
  const double least = 60;  // also shows the surroundings of a single point
  if (!box.empty()) {
    const Complex center = box.center();
    box.include(center + Complex(least, least));
    box.include(center - Complex(least, least));
  }
  w.display.viewport.fit(box.empty() ? content_box(w) : box);
}

}  // namespace

std::vector<Action> view_actions() {
  return {
      {
          .id = "view.image",
          .label = "Picture",
          .keys = {'1'},
          .enabled = always,
          .run = set_view<View::image>,
          .checked = has_view<View::image>,
      },
      {
          .id = "view.angle",
          .label = "Angle distortion",
          .hint = "Color the picture by how much angles change",
          .keys = {'2'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = set_view<View::angle>,
          .checked = has_view<View::angle>,
      },
      {
          .id = "view.area",
          .label = "Area",
          .hint = "Color the picture by how much areas change",
          .keys = {'3'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = set_view<View::area>,
          .checked = has_view<View::area>,
      },
      {
          .id = "view.stretch",
          .label = "Largest stretch",
          .hint = "Color the picture by how much lengths grow",
          .keys = {'4'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = set_view<View::stretch>,
          .checked = has_view<View::stretch>,
      },
      {
          .id = "view.checker",
          .label = "Checker",
          .keys = {'5'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = set_view<View::checker>,
          .checked = has_view<View::checker>,
      },
      {
          .id = "view.compare",
          .label = "Compare methods",
          .hint = "Run other methods on the same pose and compare their figures",
          .needs = "Needs pins, and a method that can be compared",
          .enabled =
              [](const Workspace& w) {
                return has_cage(w) && can_be_compared(w.shown.deformation());
              },
          .run = ask<Request::compare>,
      },
      {
          .id = "view.fold",
          .label = "Next fold",
          .hint = "Go to the worst fold, then to the next one",
          .keys = {'W'},
          .needs = "Needs a map: set a pin, or draw a cage",
          .enabled = [](const Workspace& w) { return w.map().has_map(); },
          .run = [](Workspace& w) { w.show_next_fold(); },
      },
      {
          .id = "view.before_after",
          .label = "Before and after",
          .hint = "Show the original and the pose side by side",
          .icon = icon_named("compare"),
          .keys = {{'\\', kShift}, {'|', kShift}},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run =
              [](Workspace& w) {
                w.display.split = w.display.split ? std::nullopt : std::optional(0.5);
              },
          .checked = [](const Workspace& w) { return w.display.split.has_value(); },
      },
      {
          .id = "view.mesh",
          .label = "Mesh",
          .icon = icon_named("mesh"),
          .keys = {'M'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = [](Workspace& w) { w.display.show_mesh = !w.display.show_mesh; },
          .checked = [](const Workspace& w) { return w.display.show_mesh; },
      },
      {
          .id = "view.timeline",
          .label = "Timeline",
          .icon = icon_named("film"),
          .keys = {'T'},
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = [](Workspace& w) { w.shown.timeline.visible = !w.shown.timeline.visible; },
          .checked = [](const Workspace& w) { return w.shown.timeline.visible; },
      },
      {
          .id = "view.surface",
          .label = "Surface in space",
          .hint = "Show the surface with the picture on it",
          .needs = kNeedsSurface,
          .enabled = has_surface,
          .run = [](Workspace& w) { w.display.show_surface = !w.display.show_surface; },
          .checked = [](const Workspace& w) { return w.shows_surface(); },
      },
      {
          .id = "view.overlays",
          .label = "Cage and pins",
          .icon = icon_named("cage"),
          .keys = {'0'},
          .enabled = always,
          .run = [](Workspace& w) { w.display.show_cage = !w.display.show_cage; },
          .checked = [](const Workspace& w) { return w.display.show_cage; },
          .during_gesture = true,
      },
      {
          .id = "view.frame",
          .label = "Frame selection",
          .keys = {'F'},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = frame_selection,
          .during_gesture = true,
      },
      {
          .id = "view.fit",
          .label = "Fit all",
          .icon = icon_named("fit"),
          .keys = {{'F', kShift}, {'0', kCtrl}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = [](Workspace& w) { w.display.viewport.fit(content_box(w)); },
          .during_gesture = true,
      },
      {
          .id = "view.actual",
          .label = "100 %",
          .keys = {{'1', kCtrl}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = [](Workspace& w) { zoom_by(w, 1 / w.display.viewport.zoom); },
          .during_gesture = true,
      },
      {
          .id = "view.zoom_in",
          .label = "Zoom in",
          .keys = {'+', '=', {'=', kCtrl}, {'+', kCtrl}, {'=', kCtrlShift}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = [](Workspace& w) { zoom_by(w, 1.25); },
          .during_gesture = true,
      },
      {
          .id = "view.zoom_out",
          .label = "Zoom out",
          .keys = {'-', {'-', kCtrl}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = [](Workspace& w) { zoom_by(w, 0.8); },
          .during_gesture = true,
      },
      {
          .id = "edit.context_menu",
          .label = "Context menu",
          .hint = "Open the menu of what is selected",
          .keys = {{Key::f10, kShift}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = ask<Request::context_menu>,
      },
      {
          .id = "view.menu",
          .label = "Focus menu",
          .hint = "Move the keyboard focus to the menu",
          .keys = {Key::f10},
          .enabled = always,
          .run = ask<Request::menu>,
      },
      {
          .id = "view.next_panel",
          .label = "Focus next panel",
          .hint = "Move the keyboard focus from panel to panel",
          .keys = {Key::f6},
          .enabled = always,
          .run = ask<Request::next_panel>,
      },
      {
          .id = "help.palette",
          .label = "Find action...",
          .hint = "Search actions, methods and settings by name",
          .icon = icon_named("search"),
          .keys = {{'P', kCtrlShift}},
          .enabled = always,
          .run = ask<Request::palette>,
      },
      {
          .id = "help.keys",
          .label = "Keys and mouse",
          .hint = "List all keys and mouse gestures, and change keys",
          .icon = icon_named("help"),
          .keys = {Key::f1, '?', {'?', kShift}},
          .enabled = always,
          .run = ask<Request::help>,
      },
  };
}

std::vector<Action> held_actions() {
  return {
      {
          .id = "hold.overlays",
          .label = "Hide cage and pins (hold)",
          .keys = {'H'},
          .enabled = always,
      },
      {
          .id = "hold.original",
          .label = "Show original (hold)",
          .keys = {'\\'},
          .enabled = always,
      },
      {
          .id = "hold.alt",
          .label = "Act as Alt (hold)",
          .hint = "For desktops that reserve Alt-drag for moving windows",
          .keys = {'Q'},
          .enabled = always,
      },
  };
}

}  // namespace holomorph
