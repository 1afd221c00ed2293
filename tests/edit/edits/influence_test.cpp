// Drags that move more than one handle: soft selection, symmetry, and the box around the selection.

#include "edit/actions/actions.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::influence_test {

namespace {

const Points kSquare{{0, 0}, {200, 0}, {200, 200}, {0, 200}};
constexpr Modifiers kShift{false, true, false}, kAlt{false, false, true};
/// A dozen operations on coordinates below 512, each rounded to 2^-45 = 3e-14.
constexpr double kRounding = 1e-12;

Handle vertex(Index i) {
  return {Handle::Kind::cage, i, 0};
}

}  // namespace

TEST_CASE(
    "Soft selection: handles follow less the farther away they are, and not beyond the radius") {
  TestWorkspace desk({{0, 0}, {100, 0}, {200, 0}, {200, 200}, {0, 200}});
  run("edit.soft", desk.workspace);
  desk.workspace.tools.drag.reach = 200;
  desk.drag({0, 0}, {0, -60});
  CHECK(desk.deformation().pose.vertex(0) == Complex(0, -60));
  const double near = 1 - 0.25;  // (1 - (100 / 200)^2)^2, exact in binary
  CHECK(desk.deformation().pose.vertex(1).imag() == -60 * near * near);
  CHECK(desk.deformation().pose.vertex(2) == Complex(200, 0));
  CHECK(desk.deformation().pose.vertex(4) == Complex(0, 200));
  CHECK(desk.deformation().rest.vertex(1) == Complex(100, 0));
  run("edit.undo", desk.workspace);
  CHECK(desk.deformation().pose == desk.deformation().rest);  // one step
  run("edit.soft_less", desk.workspace);
  CHECK(desk.workspace.tools.drag.reach == 160);  // 200 * 4 / 5, all exact
  for (int i = 0; i < 100; ++i) run("edit.soft_less", desk.workspace);
  CHECK(desk.workspace.tools.drag.reach == kMinReach);
  run("edit.soft", desk.workspace);
  desk.drag({0, 0}, {0, -60});
  CHECK(desk.deformation().pose.vertex(1) == Complex(100, 0));
}

TEST_CASE("Symmetry: the other side mirrors the move, and points on the axis stay on it") {
  TestWorkspace desk({{0, 0}, {200, 0}, {200, 200}, {100, 240}, {0, 200}});
  Deformation deformation = desk.deformation();
  deformation.method = "pins";
  deformation.pins = {{{40, 100}, {40, 100}, {}, {}}, {{160, 100}, {160, 100}, {}, {}}};
  desk.workspace.commit("Pins", deformation);
  desk.settle();
  run("edit.symmetry", desk.workspace);
  desk.drag({200, 0}, {230, -20});
  CHECK(desk.deformation().pose.vertex(1) == Complex(230, -20));
  CHECK(desk.deformation().pose.vertex(0) == Complex(-30, -20));
  desk.drag({40, 100}, {50, 120});
  CHECK(std::abs(desk.deformation().pins[1].pose - Complex(150, 120)) < 1e-9);
  desk.drag({100, 240}, {130, 260});
  CHECK(desk.deformation().pose.vertex(3) == Complex(100, 260));
  CHECK(counterparts_of(desk.deformation()).at(vertex(2)) == vertex(4));
  // Both together: soft selection on both sides.
  desk.workspace.tools.drag.soft = true;
  desk.workspace.tools.drag.reach = 150;
  const Displacements displacement_of = displacements(
      at_rest(desk.deformation()), {vertex(0)}, {10, 0}, EditMode::pose, desk.workspace.tools.drag);
  CHECK(displacement_of.at(vertex(0)) == Complex(10, 0));
  CHECK(displacement_of.at(vertex(1)) == Complex(-10, 0));
  const Handle pin{Handle::Kind::pin, 0, 0}, other{Handle::Kind::pin, 1, 0};
  CHECK(displacement_of.at(pin).real() > 0);
  CHECK(displacement_of.at(other) == Complex(-displacement_of.at(pin).real(), 0));
}

TEST_CASE("Symmetry: if the rest shape is not symmetric, a drag moves only one side") {
  TestWorkspace desk({{0, 0}, {200, 0}, {230, 170}, {0, 200}});
  run("edit.symmetry", desk.workspace);
  desk.drag({230, 170}, {260, 200});
  CHECK(desk.deformation().pose.vertex(2) == Complex(260, 200));
  CHECK(desk.deformation().pose.vertex(3) == Complex(0, 200));
}

TEST_CASE("Snap: drags stop where they line up with columns and rows") {
  TestWorkspace desk({{0, 0}, {100, 0}, {203, 7}, {200, 200}, {0, 200}});
  run("edit.snap", desk.workspace);
  desk.press({100, 0});
  desk.move({197, -40});
  desk.move({197, 205});  // the fourth point's column and row, 3 and 5 px away
  CHECK(desk.deformation().pose.vertex(1) == Complex(200, 200));
  CHECK(desk.tool().overlay().guides.size() == 2);
  desk.move({150, 90});
  CHECK(desk.deformation().pose.vertex(1) == Complex(150, 90));  // nothing is near
  CHECK(desk.tool().overlay().guides.empty());
  desk.move({150, 6});  // the third point's row; the row of its own rest position is farther away
  CHECK(desk.deformation().pose.vertex(1) == Complex(150, 7));
  desk.release({97, 60});
  CHECK(desk.deformation().pose.vertex(1) == Complex(100, 60));  // its own column at rest
  CHECK(desk.tool().overlay().guides.empty());
  run("edit.snap", desk.workspace);
  desk.drag({100, 60}, {197, 205});
  CHECK(desk.deformation().pose.vertex(1) == Complex(197, 205));
  // Snapping to the picture's edges and middle.
  std::vector<Guide> guides;
  const Complex by = snapped(desk.deformation(), {vertex(0)}, vertex(0), {497, 303}, EditMode::pose,
                             {6, Box{0, 0, 1000, 600}}, guides);
  CHECK(by == Complex(500, 300));
  CHECK(guides.size() == 2);
}

TEST_CASE("The box scales about the opposite side, and corner grips scale uniformly") {
  TestWorkspace desk(kSquare);
  desk.workspace.selection = {vertex(1), vertex(2), vertex(3), vertex(0)};
  desk.hover({100, 100});
  const auto mark = desk.tool().overlay().box;
  REQUIRE(mark);
  const auto plane = [&](int grip) {
    return desk.workspace.display.viewport.plane_at_px(mark->grip(grip));
  };
  // Drag the right side to twice the width.
  const Complex right = plane(3);
  desk.drag(right, right + Complex(200, 0));
  CHECK(desk.deformation().pose.vertex(0) == desk.deformation().rest.vertex(0));
  CHECK(desk.deformation().pose.vertex(1).imag() == Approx(0).margin(1e-9));
  CHECK_THAT(desk.deformation().pose.vertex(1).real() - desk.deformation().pose.vertex(0).real(),
             Catch::WithinAbs(400, kRounding));
  CHECK_THAT(desk.deformation().pose.vertex(2).imag(), Catch::WithinAbs(200, kRounding));
  run("edit.undo", desk.workspace);
  CHECK(desk.deformation().pose == desk.deformation().rest);
  // A corner scales uniformly about the opposite corner, freely with Shift, and about the center
  // with Alt.
  const Complex corner = plane(4), half(100, 100);
  desk.drag(corner, corner - half);
  CHECK_THAT(desk.deformation().pose.vertex(2).real() - desk.deformation().pose.vertex(0).real(),
             Catch::WithinAbs(100, kRounding));
  CHECK_THAT(desk.deformation().pose.vertex(2).imag() - desk.deformation().pose.vertex(0).imag(),
             Catch::WithinAbs(100, kRounding));
  run("edit.undo", desk.workspace);
  desk.drag(corner, corner - Complex(half.real(), 0), kShift);
  CHECK_THAT(desk.deformation().pose.vertex(2).real() - desk.deformation().pose.vertex(0).real(),
             Catch::WithinAbs(100, kRounding));
  CHECK_THAT(desk.deformation().pose.vertex(2).imag() - desk.deformation().pose.vertex(0).imag(),
             Catch::WithinAbs(200, kRounding));
  run("edit.undo", desk.workspace);
  desk.drag(corner, corner - 0.5 * half, kAlt);
  CHECK(std::abs(desk.deformation().pose.vertex(2) - Complex(150, 150)) < 1e-9);
  CHECK(std::abs(desk.deformation().pose.vertex(0) - Complex(50, 50)) < 1e-9);
}

TEST_CASE("A drag inside the box moves the selection, and a click there clears it") {
  TestWorkspace desk(kSquare);
  const Selection all{vertex(0), vertex(1), vertex(2), vertex(3)};
  desk.workspace.selection = all;
  desk.drag({60, 70}, {90, 110});
  for (Index i = 0; i < 4; ++i)
    CHECK(std::abs(desk.deformation().pose.vertex(i) - desk.deformation().rest.vertex(i) -
                   Complex(30, 40)) < 1e-9);
  CHECK(desk.workspace.selection == all);
  run("edit.undo", desk.workspace);
  desk.drag({60, 70}, {90, 80}, kShift);
  CHECK(desk.deformation().pose.vertex(0) - desk.deformation().rest.vertex(0) == Complex(30, 0));
  run("edit.undo", desk.workspace);
  desk.draw({{60, 70}, {90, 80}}, kShift);  // if Shift is held from the start, the drag selects
  CHECK(desk.deformation().pose == desk.deformation().rest);
  CHECK(desk.workspace.selection == all);
  const size_t steps = desk.workspace.document.history().index();
  desk.click({60, 70});
  CHECK(desk.workspace.selection.empty());
  CHECK(desk.workspace.document.history().index() == steps);
}

TEST_CASE("The knob of the box rotates handles, and the angles of pins, by more than half a turn") {
  TestWorkspace desk(kSquare);
  Deformation deformation = desk.deformation();
  deformation.method = "pins";
  deformation.pins = {{{50, 100}, {50, 100}, 0.25, {}}, {{150, 100}, {150, 100}, {}, {}}};
  desk.workspace.commit("Pins", deformation);
  desk.settle();
  desk.workspace.selection = {{Handle::Kind::pin, 0, 0}, {Handle::Kind::pin, 1, 0}};
  desk.hover({100, 60});
  const auto mark = desk.tool().overlay().box;
  REQUIRE(mark);
  const Complex knob = desk.workspace.display.viewport.plane_at_px(mark->knob), center(100, 100);
  Points path;
  for (int i = 0; i <= 18; ++i)
    path.push_back(center + (knob - center) * std::polar(1.0, kPi / 12 * i));
  desk.draw(path);
  CHECK(std::abs(desk.deformation().pins[0].pose - Complex(100, 150)) < 1e-6);  // 270 degrees
  CHECK(std::abs(desk.deformation().pins[1].pose - Complex(100, 50)) < 1e-6);
  CHECK_THAT(desk.deformation().pins[0].angle.value(),
             Catch::WithinAbs(0.25 + 1.5 * kPi, kRounding));
  CHECK_FALSE(desk.deformation().pins[1].angle);
  run("edit.undo", desk.workspace);
  CHECK(desk.deformation() == deformation);
  // Escape cancels the drag.
  desk.hover({100, 60});
  desk.press(knob);
  desk.move(knob + Complex(60, -40));
  CHECK(desk.tool().busy());
  desk.tool().key(Key::escape, desk.workspace);
  CHECK(desk.deformation() == deformation);
}

TEST_CASE("The box transforms tangents and strokes, too") {
  TestWorkspace desk(kSquare);
  Deformation deformation = desk.deformation();
  deformation.pose.segments[0] = {{0, 0}, {60, -30}, {140, -30}};
  const Affine twice = Affine::scaling(2, 2, 0);
  const Deformation after =
      transformed(deformation, {vertex(0), vertex(1)}, twice, 0, EditMode::pose);
  CHECK(after.pose.segments[0][0] == Complex(0, 0));
  CHECK(after.pose.segments[0][1] == Complex(120, -60));
  CHECK(after.pose.segments[0][2] == Complex(280, -60));
  CHECK(after.pose.vertex(1) == Complex(400, 0));
  CHECK(after.pose.vertex(2) == Complex(200, 200));
  deformation.method = "strokes";
  deformation.strokes = {{{{20, 20}, {180, 20}}, {{20, 20}, {100, 40}, {180, 20}}, {}}};
  const Deformation turned = transformed(deformation, {{Handle::Kind::stroke, 0, 0}},
                                         Affine::turning(kPi / 2, 0), kPi / 2, EditMode::pose);
  CHECK(std::abs(turned.strokes[0].pose[1] - Complex(-40, 100)) < 1e-9);
  CHECK(turned.strokes[0].rest == deformation.strokes[0].rest);
}

TEST_CASE("The brush paints rest positions in one step and switches to a method with stiffness") {
  TestWorkspace desk(kSquare);
  Workspace& w = desk.workspace;
  desk.drag({200, 200}, {260, 200});
  desk.settle();
  run("tool.brush", w);
  w.tools.brush_radius = 20;
  const size_t steps = desk.steps();
  desk.draw({{40, 100}, {60, 100}, {80, 100}, {100, 100}});
  CHECK(desk.steps() == steps + 1);
  CHECK(w.shown.deformation().method == "arap");
  const std::vector<BrushDab> painted = w.shown.deformation().stiffness;
  REQUIRE(painted.size() >= 3);
  for (const BrushDab& dab : painted) {
    CHECK(dab.level > 0);
    CHECK(dab.radius == 20);
  }
  desk.settle();
  desk.draw({{60, 100}, {80, 100}}, {true, false, false});
  CHECK(w.shown.deformation().stiffness.back().level < 0);
  desk.settle();
  desk.draw({{20, 100}, {40, 100}, {60, 100}, {80, 100}, {100, 100}, {120, 100}}, kShift);
  CHECK(w.shown.deformation().stiffness.size() < painted.size());
  run("edit.undo", w);
  run("edit.undo", w);
  CHECK(w.shown.deformation().stiffness == painted);
  const double radius = w.tools.brush_radius;
  run("edit.soft_more", w);
  CHECK(w.tools.brush_radius > radius);
  CHECK_FALSE(w.tools.drag.soft);
  run("edit.remove_stiffness", w);
  CHECK(w.shown.deformation().stiffness.empty());
  desk.press({60, 100});
  desk.tool().key(Key::escape, w);
  desk.release({60, 100});
  CHECK(w.shown.deformation().stiffness.empty());
}

TEST_CASE("Pins are brought forward and sent back, and repeated changes are one step") {
  TestWorkspace desk(kSquare);
  Deformation deformation = desk.deformation();
  deformation.method = "pins";
  deformation.pins = {{{40, 100}, {40, 100}, {}, {}}, {{160, 100}, {160, 100}, {}, {}}};
  desk.workspace.commit("Pins", deformation);
  desk.workspace.selection = {{Handle::Kind::pin, 0, 0}};
  const size_t steps = desk.steps();
  for (int i = 0; i < 3; ++i) run("edit.pin_up", desk.workspace);
  CHECK(desk.deformation().pins[0].depth == 3);
  CHECK(desk.deformation().pins[1].depth == 0);
  CHECK(desk.steps() == steps + 1);
  run("edit.pin_down", desk.workspace);
  CHECK(desk.deformation().pins[0].depth == 2);
}

}  // namespace holomorph::influence_test
