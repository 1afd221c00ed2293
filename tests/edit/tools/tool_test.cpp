// Tools and actions without a window. Gestures are sequences of inputs.
#include <set>

#include "core/error.h"
#include "edit/actions/actions.h"
#include "edit/edits/method_edits.h"
#include "edit/tools/tool.h"
#include "scene/auto_cage.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::tool_test {

namespace {

constexpr Modifiers kAlt{false, false, true}, kShift{false, true, false};

}  // namespace

TEST_CASE(
    "Viewport: window and plane conversions are inverses, and zooming keeps the point under the "
    "pointer") {
  Viewport view{{30, 40}, 2.5, 10, 20, 800, 600};
  const Complex z{12, 99}, px{333, 222};
  CHECK(std::abs(view.plane_at_px(view.px_at_plane(z)) - z) < 1e-12);
  CHECK(view.px_at_plane(z + kI).imag() < view.px_at_plane(z).imag());  // y points up in the plane
  const Complex under = view.plane_at_px(px);
  view.zoom_at(px, 3);
  CHECK(std::abs(view.plane_at_px(px) - under) < 1e-12);
  view.fit(box_of(shapes::l_shape()));
  for (const Complex& v : shapes::l_shape()) CHECK(view.contains_px(view.px_at_plane(v)));
}

TEST_CASE(
    "Select: a drag is one step and follows the pointer exactly; Shift keeps it on one axis") {
  TestWorkspace desk(shapes::l_shape());
  desk.drag({200, 100}, {230, 90});
  CHECK(desk.deformation().pose.vertex(2) == Complex(230, 90));
  CHECK(desk.deformation().rest.vertex(2) == Complex(200, 100));
  CHECK(desk.steps() == 3);
  desk.drag({230, 90}, {260, 95}, kShift);
  CHECK(desk.deformation().pose.vertex(2) == Complex(260, 90));
  desk.press({260, 90});
  desk.move({262, 90});  // below the threshold
  desk.release({262, 90});
  CHECK(desk.steps() == 4);
  run("edit.undo", desk.workspace);
  CHECK(desk.deformation().pose.vertex(2) == Complex(230, 90));
}

TEST_CASE("Select: Escape cancels a drag and restores the scene") {
  TestWorkspace desk(shapes::l_shape());
  desk.press({0, 0});
  desk.move({50, 50});
  CHECK(desk.deformation().pose.vertex(0) == Complex(50, 50));
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  CHECK(desk.deformation().pose.vertex(0) == Complex(0, 0));
  CHECK(desk.steps() == 2);
}

TEST_CASE("Select: a box and Shift select handles, and a drag of one moves all") {
  TestWorkspace desk(shapes::l_shape());
  desk.drag({150, -50}, {250, 150});
  CHECK(desk.workspace.selection.size() == 2);
  desk.click({0, 0}, kShift);
  CHECK(desk.workspace.selection.size() == 3);
  desk.drag({200, 0}, {210, 5});
  CHECK(desk.deformation().pose.vertex(0) == Complex(10, 5));
  CHECK(desk.deformation().pose.vertex(2) == Complex(210, 105));
  CHECK(desk.deformation().pose.vertex(3) == Complex(100, 100));
}

TEST_CASE(
    "Inserting a point keeps rest shape and pose, and deleting leaves at least three points") {
  TestWorkspace desk(shapes::l_shape());
  desk.drag({200, 0}, {200, -40});
  desk.press({100, -20}, {}, true);
  desk.release({100, -20});
  REQUIRE(desk.deformation().rest.size() == 7);
  CHECK(std::abs(desk.deformation().pose.vertex(1) - Complex(100, -20)) < 1e-9);
  CHECK(std::abs(desk.deformation().rest.vertex(1) - Complex(100, 0)) < 5);
  CHECK(desk.deformation().rest.vertex(1).imag() == Approx(0).margin(1e-12));
  desk.click({100, -20}, kAlt);
  CHECK(desk.deformation().rest.size() == 6);
  run("edit.select_all", desk.workspace);
  run("edit.delete", desk.workspace);
  CHECK(desk.deformation().rest.size() == 6);
  CHECK(desk.workspace.messages.toasts.size() == 1);
}

TEST_CASE(
    "Editing the rest shape keeps the pose; a self-crossing one is refused with its position") {
  TestWorkspace desk(shapes::l_shape());
  desk.drag({200, 100}, {230, 120});
  run("cage.rest", desk.workspace);
  const Cage pose = desk.deformation().pose;
  desk.drag({200, 100}, {210, 90});
  CHECK(desk.deformation().rest.vertex(2) == Complex(210, 90));
  CHECK(desk.deformation().pose == pose);
  const size_t before = desk.steps();
  desk.drag({210, 90}, {-80, 50});
  CHECK(desk.steps() == before);
  CHECK(desk.deformation().rest.vertex(2) == Complex(210, 90));
  REQUIRE(desk.workspace.messages.toasts.size() == 1);
  CHECK(desk.workspace.messages.toasts[0].where);
}

TEST_CASE(
    "Pen: Backspace removes points; the first point, Enter and a double-click close the cage") {
  for (const int closing : {0, 1, 2}) {
    TestWorkspace desk;
    desk.workspace.tools.active = ToolId::pen;
    for (const Complex z : shapes::rectangle(200, 150)) desk.click(z);
    desk.click({-50, 60});
    CHECK(desk.tool().key(Key::backspace, desk.workspace));
    if (closing == 0) desk.click({0, 0});
    if (closing == 1) CHECK(desk.tool().key(Key::enter, desk.workspace));
    if (closing == 2) desk.press({0, 150}, {}, true);
    REQUIRE(desk.deformation().rest.size() == 4);
    CHECK(desk.deformation().pose == desk.deformation().rest);
    CHECK(desk.workspace.tools.active == ToolId::select);
  }
}

TEST_CASE("Each method keeps its own parameters") {
  Deformation deformation = with_cage(Deformation{}, shapes::rectangle(200, 150));
  deformation = with_method(deformation, "pins");
  deformation.parameters["pin_weight"] = 0.01;
  const Deformation outline = with_method(deformation, "outline");
  CHECK(outline.parameters.empty());
  CHECK(with_method(outline, "pins") == deformation);
  Deformation soft = outline;
  soft.parameters["softness"] = 0.5;
  CHECK(with_method(with_method(soft, "bounded"), "outline").parameters == soft.parameters);
}

TEST_CASE("Pen: Escape cancels only the drawing; a self-crossing drawing is kept for correction") {
  TestWorkspace desk(shapes::l_shape());
  desk.drag({200, 100}, {230, 90});
  const Deformation before = desk.deformation();
  desk.workspace.tools.active = ToolId::pen;
  desk.click({-300, -300});
  desk.click({-200, -300});
  CHECK(desk.workspace.mode == EditMode::rest);
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  CHECK(desk.deformation() == before);
  for (const Complex z :
       {Complex(-300, -300), Complex(-200, -200), Complex(-200, -300), Complex(-300, -200)})
    desk.click(z);
  CHECK(desk.tool().key(Key::enter, desk.workspace));
  CHECK(desk.deformation() == before);
  CHECK(desk.tool().busy());
}

TEST_CASE("Pen: a click on an edge inserts a point there") {
  TestWorkspace desk(shapes::l_shape());
  desk.workspace.tools.active = ToolId::pen;
  desk.hover({60, 3});
  CHECK(desk.tool().overlay().insertion);
  desk.click({60, 3});
  CHECK(desk.deformation().rest.size() == 7);
}

TEST_CASE(
    "Pin: a click sets a pin at the rest position under it and switches the method without a "
    "jump") {
  TestWorkspace desk(shapes::l_shape());
  desk.drag({200, 100}, {240, 130});
  desk.settle();
  const VectorXc before = desk.workspace.map().map().f;
  const Complex image = before[before.size() / 2],
                rest = desk.workspace.map().prepared()->mesh->vertices[before.size() / 2];
  desk.workspace.tools.active = ToolId::pin;
  desk.click(image);
  REQUIRE(desk.deformation().pins.size() == 1);
  CHECK(desk.deformation().method == "pins");
  CHECK(std::abs(desk.deformation().pins[0].rest - rest) < 0.5);
  CHECK(desk.deformation().pins[0].pose == image);
  desk.settle();
  CHECK((desk.workspace.map().map().f - before).cwiseAbs().maxCoeff() < 0.2);
  desk.drag(image, image + Complex(20, 10));
  desk.settle();
  CHECK(desk.deformation().pins[0].pose == image + Complex(20, 10));
  desk.click({-300, -300});
  CHECK(desk.deformation().pins.size() == 1);  // outside the picture, no pin is set
  desk.click(image + Complex(20, 10), kAlt);
  CHECK(desk.deformation().pins.empty());
}

TEST_CASE("The ring of a selected pin rotates the picture by more than a full turn") {
  TestWorkspace desk(shapes::l_shape());
  desk.workspace.tools.active = ToolId::pin;
  desk.click({50, 50});
  desk.settle();
  desk.workspace.tools.active = ToolId::select;
  const double radius = kRingRadius * desk.workspace.display.handle_px;
  const auto on_ring = [&](double angle) { return Complex(50, 50) + std::polar(radius, angle); };
  desk.press(on_ring(0));
  for (double angle = 0.2; angle < 7.01; angle += 0.2) desk.move(on_ring(angle));
  desk.release(on_ring(7.0));
  REQUIRE(desk.deformation().pins[0].angle);
  CHECK(*desk.deformation().pins[0].angle == Approx(7.0).margin(0.05));
  CHECK(desk.deformation().pins[0].pose == Complex(50, 50));
  const size_t steps = desk.steps();
  for (int i = 0; i < 5; ++i) {
    Input input = desk.at(on_ring(1.0));
    input.wheel = 2;
    CHECK(desk.tool().scroll(input, desk.workspace));
  }
  constexpr double kRounding = 1e-14;  // five powers and five products, about 2^-53 each
  CHECK(desk.deformation().pins[0].scale == Approx(std::pow(1.05, 10)).epsilon(kRounding));
  CHECK(desk.steps() == steps + 1);  // consecutive scrolls are one step
  Input aside = desk.at({120, 50});
  aside.wheel = 2;
  CHECK_FALSE(desk.tool().scroll(aside, desk.workspace));
  run("edit.free_angle", desk.workspace);
  CHECK_FALSE(desk.deformation().pins[0].angle);
}

TEST_CASE("Deleting a point refits curved neighbors, or with Shift keeps their tangents") {
  Deformation deformation = with_cage(Deformation{}, shapes::l_shape());
  deformation.pose.segments[1] = {{200, 0}, {230, 30}, {230, 70}};
  deformation.pose.segments[2] = {{200, 100}, {170, 130}, {130, 130}};
  const Handle vertex{Handle::Kind::cage, 2, 0};
  const Deformation refitted = erased(deformation, {vertex}),
                    kept = erased(deformation, {vertex}, Refit::tangents);
  CHECK(refitted.pose.size() == deformation.pose.size() - 1);
  CHECK(refitted.rest == kept.rest);
  CHECK(refitted.pose.degree(1) == 3);
  CHECK(kept.pose.controls(1) ==
        Points{{200, 0}, {230, 30}, {130, 130}, deformation.pose.vertex(3)});
  CHECK(refitted.pose != kept.pose);
}

TEST_CASE("Resetting every handle of a curved pose gives the rest shape") {
  TestWorkspace desk(shapes::l_shape());
  Deformation deformation = desk.deformation();
  deformation.rest.segments[2] =
      deformation.pose.segments[2] = {{200, 100}, {170, 130}, {130, 130}};
  deformation.pose.segments[1] = {{210, 5}, {230, 30}, {230, 70}};
  deformation.pose.segments[2][1] += 9.0;
  desk.workspace.commit("Curves", deformation);
  run("edit.select_all", desk.workspace);
  run("edit.reset", desk.workspace);
  const Deformation& after = desk.deformation();
  CHECK(after.pose.segments[2] == after.rest.segments[2]);
  for (Index e = 0; e < after.rest.size(); ++e) {
    const Points rest = elevated(after.rest.controls(e), after.pose.degree(e)),
                 pose = after.pose.controls(e);
    for (size_t m = 0; m < rest.size(); ++m) CHECK(std::abs(rest[m] - pose[m]) < 1e-12);
  }
}

TEST_CASE("Drawing another cage over a bent picture switches to the rest shape") {
  TestWorkspace desk(shapes::l_shape());
  desk.workspace.tools.active = ToolId::pin;
  desk.drag({50, 50}, {70, 60});
  CHECK(desk.steps() == 3);  // setting and dragging a pin in one gesture is one step
  desk.settle();
  desk.workspace.tools.active = ToolId::pen;
  desk.click({400, 400});
  CHECK(desk.workspace.mode == EditMode::rest);
}

TEST_CASE("Consecutive nudges of a selection merge into one step, but not with other steps") {
  TestWorkspace desk(shapes::l_shape());
  Workspace& w = desk.workspace;
  desk.click({0, 0});
  for (int i = 0; i < 3; ++i) run("edit.nudge_right", w);
  CHECK(desk.steps() == 3);
  desk.click({200, 0});
  run("edit.nudge_right", w);
  CHECK(desk.steps() == 4);
  desk.click({3, 0});
  w.go_to(2);
  run("edit.nudge_up", w);
  CHECK(desk.steps() == 4);  // a separate step after the first nudges
  CHECK(desk.deformation().pose.vertex(0) == Complex(3, 1));
  run("edit.undo", w);
  CHECK(desk.deformation().pose.vertex(0) == Complex(3, 0));
}

TEST_CASE(
    "A selection never refers to another point after undo, or to a pin that the method hides") {
  TestWorkspace desk(shapes::l_shape());
  Workspace& w = desk.workspace;
  w.tools.active = ToolId::pen;
  desk.click({100, 0});
  CHECK(w.selection.size() == 1);
  run("edit.undo", w);
  CHECK(w.selection.empty());
  w.tools.active = ToolId::pin;
  desk.settle();
  desk.click({50, 50});
  CHECK(w.selection.size() == 1);
  w.commit("Method", with_method(desk.deformation(), "cage"));
  CHECK(w.selection.empty());
}

TEST_CASE("Hidden handles cannot be grabbed") {
  TestWorkspace desk(shapes::l_shape());
  desk.workspace.display.show_cage = false;
  CHECK_FALSE(handle_at(desk.workspace, desk.workspace.display.viewport.px_at_plane({0, 0})));
  desk.workspace.display.show_cage = true;
  CHECK(handle_at(desk.workspace, desk.workspace.display.viewport.px_at_plane({0, 0})));
}

TEST_CASE("Moving several handles moves their center") {
  const Deformation deformation = with_cage(Deformation{}, shapes::l_shape());
  const Selection two{{Handle::Kind::cage, 0, 0}, {Handle::Kind::cage, 2, 0}};
  CHECK(center_of(deformation, two, EditMode::pose) == Complex(100, 50));
  CHECK(center_of(moved(deformation, two, {5, -3}, EditMode::pose), two, EditMode::pose) ==
        Complex(105, 47));
}

TEST_CASE("Nudging, resetting and switching methods change the scene as expected") {
  TestWorkspace desk(shapes::l_shape());
  desk.click({0, 0});
  for (const char* id : {"edit.nudge_right", "edit.nudge_up_10", "edit.nudge_left_fine"})
    run(id, desk.workspace);
  CHECK(std::abs(desk.deformation().pose.vertex(0) - Complex(0.9, 10)) < 1e-12);
  run("edit.reset", desk.workspace);
  CHECK(desk.deformation().pose == desk.deformation().rest);
  Deformation deformation = with_method(desk.deformation(), "pins");
  deformation.parameters["smoothness"] = 1e-4;
  CHECK(with_method(deformation, "cage").parameters.empty());
}

TEST_CASE("With a pin selected, the wheel still zooms in tools that show no ring") {
  TestWorkspace desk(shapes::rectangle(200, 200));
  Workspace& w = desk.workspace;
  w.commit("Pin", with_pin(desk.deformation(), {100, 100}, {100, 100}));
  desk.settle();
  w.selection = {{Handle::Kind::pin, 0, 0}};
  const size_t steps = desk.steps();
  Input on_ring = desk.at(Complex(100, 100) + kRingRadius * w.display.handle_px);
  on_ring.wheel = 1;
  for (const ToolId id : {ToolId::pen, ToolId::stroke}) {
    w.tools.active = id;
    CHECK_FALSE(desk.tool().scroll(on_ring, w));
    CHECK(desk.steps() == steps);
  }
  for (const ToolId id : {ToolId::select, ToolId::pin}) {
    w.tools.active = id;
    CHECK(desk.tool().scroll(on_ring, w));
  }
}

TEST_CASE("The action table: ids and keys are unique, and every action has a label") {
  TestWorkspace desk(shapes::l_shape());
  std::set<std::string> ids, keys;
  for (const Action& action : desk.workspace.actions.rows()) {
    CHECK(ids.insert(action.id).second);
    CHECK_FALSE(action.label.empty());
    for (const Shortcut& key : action.keys) {
      INFO(action.id << " " << text_of(key));
      CHECK(keys.insert(text_of(key) + (key.mods.shift ? "S" : "")).second);
    }
  }
  CHECK(desk.workspace.actions.for_key(Shortcut('V'), desk.workspace) ==
        &desk.workspace.actions.named("tool.select"));
  CHECK(desk.workspace.actions.for_key(Shortcut('Z', {true, false, false}), desk.workspace) ==
        &desk.workspace.actions.named("edit.undo"));
  CHECK(desk.workspace.actions.for_key(Shortcut(Key::del), desk.workspace) ==
        nullptr);  // nothing is selected
  CHECK(label_with_keys(desk.workspace.actions.named("edit.undo")) == "Undo (Ctrl+Z)");
}

}  // namespace holomorph::tool_test
