// Holes are drawn with the pen, moved, deleted and filled, in one step each, and keyframes follow.
#include "edit/edits/hole_edits.h"

#include "edit/actions/actions.h"
#include "scene/keyframes.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::hole_edits_test {

namespace {

void draw_hole(TestWorkspace& desk, const Points& loop) {
  desk.workspace.tools.active = ToolId::pen;
  for (const Complex& z : loop) desk.click(z);
  CHECK(desk.tool().key(Key::enter, desk.workspace));
  desk.settle();
}

const Points kHole{{60, 40}, {120, 40}, {120, 90}, {60, 90}};

}  // namespace

TEST_CASE("Pen: a path that starts inside the cage becomes a hole, one outside a new cage") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  size_t steps = desk.steps();
  draw_hole(desk, kHole);
  REQUIRE(desk.deformation().rest.starts == std::vector<Index>{4});
  CHECK(desk.steps() == ++steps);
  CHECK(desk.deformation().pose == desk.deformation().rest);
  CHECK(desk.workspace.tools.active == ToolId::pen);
  CHECK(desk.workspace.map().prepared()->mesh->starts.size() == 1);
  // A second one.
  draw_hole(desk, {{150, 30}, {180, 30}, {165, 60}});
  CHECK(desk.deformation().rest.starts == std::vector<Index>{4, 8});
  CHECK(desk.steps() == ++steps);
  // Holes that cross something are refused with its name, and their paths are kept.
  for (const auto& [path, expected] :
       {std::pair<Points, const char*>({{30, 30}, {-30, 30}, {-30, 60}},
                                       "hole 3 crosses the outer loop"),
        {{{30, 30}, {90, 60}, {30, 80}}, "holes 1 and 3"},
        {{{20, 20}, {50, 50}, {50, 20}, {20, 50}}, "hole 3 of the rest cage crosses itself"},
        {{{50, 30}, {130, 30}, {130, 100}, {50, 100}}, "hole 1 lies inside hole 3"}}) {
    for (const Complex& z : path) desk.click(z);
    CHECK(desk.tool().key(Key::enter, desk.workspace));
    CHECK(desk.steps() == steps);
    CHECK(desk.tool().busy());
    CHECK_THAT(desk.workspace.messages.toasts.back().text, Catch::Contains(expected));
    desk.tool().key(Key::escape, desk.workspace);
  }
  // Nor does a path begin in a hole.
  desk.click({90, 60});
  CHECK_FALSE(desk.tool().busy());
  run("edit.undo", desk.workspace);
  CHECK(desk.deformation().rest.starts == std::vector<Index>{4});
  // A path that starts outside replaces the cage.
  desk.settle();
  for (const Complex z : {Complex(-50, -50), Complex(300, -50), Complex(300, 300)}) desk.click(z);
  desk.tool().key(Key::enter, desk.workspace);
  CHECK(desk.deformation().rest.starts.empty());
  CHECK(desk.deformation().rest.size() == 3);
}

TEST_CASE("Pen: a hole in a posed picture is drawn at rest, and the pose and keyframes get it") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  desk.workspace.commit("Key", with_key(desk.deformation(), 0));
  desk.drag({200, 150}, {240, 190});
  desk.workspace.commit("Key", with_key(desk.deformation(), 1));
  desk.settle();
  const Complex probe{150, 110}, before = posed_at(desk.workspace.map(), probe);
  desk.workspace.tools.active = ToolId::pen;
  desk.click({80, 60});  // on the posed picture
  CHECK(desk.workspace.mode == EditMode::rest);
  CHECK_FALSE(desk.tool().busy());
  desk.settle();
  draw_hole(desk, kHole);
  if (desk.deformation().rest.starts.empty()) {  // the keyframes' maps were not ready yet
    desk.workspace.map().follow_keys();
    for (int wait = 0; wait < 200 && !desk.workspace.map().follow_keys(); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK(desk.tool().key(Key::enter, desk.workspace));
    desk.settle();
  }
  REQUIRE(desk.deformation().rest.starts == std::vector<Index>{4});
  CHECK(desk.workspace.mode == EditMode::pose);
  CHECK(desk.deformation().pose.vertex(6) != desk.deformation().rest.vertex(6));
  CHECK(playing_keys(desk.deformation()).size() == 2);
  CHECK(desk.deformation().keyframes[0].pose.cage.vertex(6) == kHole[2]);
  CHECK(std::abs(desk.deformation().keyframes[1].pose.cage.vertex(6) -
                 desk.deformation().pose.vertex(6)) < 1e-6);
  // The picture moves only as much as a straight-edged hole allows.
  CHECK(std::abs(posed_at(desk.workspace.map(), probe) - before) < 6);
}

TEST_CASE("Holes: points are moved, inserted and deleted; too few points delete the hole") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  draw_hole(desk, kHole);
  desk.workspace.tools.active = ToolId::select;
  desk.drag({120, 90}, {130, 100});
  CHECK(std::abs(desk.deformation().pose.vertex(6) - Complex(130, 100)) < 1e-9);
  CHECK(desk.deformation().rest.vertex(6) == Complex(120, 90));
  desk.workspace.commit("Insert", inserted(desk.deformation(), 7, 0.5));
  CHECK(desk.deformation().rest.size() == 9);
  CHECK(desk.deformation().rest.vertex(8) == Complex(60, 65));
  const auto vertex = [](Index i) { return Handle{Handle::Kind::cage, i, 0}; };
  Deformation fewer = erased(desk.deformation(), {vertex(4), vertex(8)});
  CHECK(fewer.rest.starts == std::vector<Index>{4});
  CHECK(fewer.rest.size() == 7);
  fewer = erased(fewer, {vertex(5)});
  CHECK(fewer.rest.starts.empty());
  CHECK(fewer.rest == polygon_cage(shapes::rectangle(200, 150)));
  CHECK(fewer.pose.starts.empty());
  // The outer loop keeps three points, whatever the holes have.
  CHECK_THROWS(erased(desk.deformation(), {vertex(0), vertex(1)}));
}

TEST_CASE("Filling a hole with corners keeps the keyframes playing") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  draw_hole(desk, kHole);
  Deformation cornered = desk.deformation();
  for (const Index v : {0, 1, 2, 5, 7}) cornered.corners.push_back({v});
  cornered = with_key(cornered, 0);
  cornered.keyframes[0].pose.corners[4].before = 0.7;
  cornered.keyframes[0].pose.corners[1].before = 0.3;
  REQUIRE(fits(cornered, cornered.keyframes[0].pose));
  const Deformation full = filled(cornered, {});
  CHECK(full.rest.starts.empty());
  CHECK(full.corners.size() == 3);
  const Pose& key = full.keyframes[0].pose;
  REQUIRE(fits(full, key));
  CHECK(key.cage.starts.empty());
  REQUIRE(key.corners.size() == 3);
  CHECK(key.corners[1].before == 0.3);
}

TEST_CASE("Fill holes removes the selected holes, or all") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  draw_hole(desk, kHole);
  draw_hole(desk, {{150, 30}, {180, 30}, {165, 60}});
  desk.workspace.commit("Key", with_key(desk.deformation(), 0));
  const Deformation both = desk.deformation();
  desk.workspace.selection = {{Handle::Kind::cage, 5, 0}};
  run("cage.fill", desk.workspace);
  CHECK(desk.deformation().rest.starts == std::vector<Index>{4});
  CHECK(loop_of(desk.deformation().rest, 1) == loop_of(both.rest, 2));
  CHECK(fits(desk.deformation(), desk.deformation().keyframes[0].pose));
  run("edit.undo", desk.workspace);
  desk.workspace.selection.clear();
  run("cage.fill", desk.workspace);
  CHECK(desk.deformation().rest.starts.empty());
  CHECK_FALSE(desk.workspace.actions.named("cage.fill").enabled(desk.workspace));
}

}  // namespace holomorph::hole_edits_test
