// The Angles tool (key A): selecting, turning and opening corners, edge tensions, and corners after
// points are inserted or deleted.

#include "core/error.h"
#include "core/mesh/mesher.h"
#include "edit/actions/actions.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/method_edits.h"
#include "scene/formats/scene_json.h"
#include "scene/keyframes.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::angle_tool_test {

namespace {

const Points kBar{{0, 0}, {300, 0}, {300, 100}, {0, 100}};
/// Error of an angle that is summed over at most 15 moves of the mouse. Pixel coordinates below
/// 1024 have a rounding error of 2^-44 = 6e-14. The pointer is at least 28 pixels from the center,
/// so the angle is off by 3e-15 at each end of a move.
constexpr double kRounding = 1e-12;

void choose_angle_tool(TestWorkspace& desk) {
  desk.workspace.tools.active = ToolId::angle;
}

Index listed(const Deformation& deformation) {
  return static_cast<Index>(deformation.corners.size());
}

}  // namespace

TEST_CASE("Tool A: the ring turns its corner by more than a full turn") {
  TestWorkspace desk(kBar);
  choose_angle_tool(desk);
  desk.click({300, 0});
  REQUIRE(desk.workspace.selection.size() == 1);
  const Complex center(300, 0);
  desk.press(center + 28.0);
  REQUIRE(desk.tool().busy());
  for (int k = 1; k <= 14; ++k) desk.move(center + std::polar(40.0, k * kPi / 6));  // 420 degrees
  desk.release(center + std::polar(40.0, 14 * kPi / 6));
  CHECK(desk.deformation().method == "angles");
  CHECK(listed(desk.deformation()) == 4);
  CHECK_THAT(corner_at(desk.deformation(), 1).before, Catch::WithinAbs(14 * kPi / 6, kRounding));
  CHECK_THAT(corner_at(desk.deformation(), 1).after, Catch::WithinAbs(14 * kPi / 6, kRounding));
  CHECK(corner_at(desk.deformation(), 2) == PoseCorner{});
  CHECK(desk.steps() == 3);  // the cage and one turn
}

TEST_CASE("Tool A: a drag of an arm opens all selected corners on both sides") {
  TestWorkspace desk(kBar);
  choose_angle_tool(desk);
  desk.drag({250, -40}, {340, 140});
  REQUIRE(desk.workspace.selection.size() == 2);
  desk.hover({300, 0});
  const ToolOverlay overlay = desk.tool().overlay();
  REQUIRE(overlay.corner);
  REQUIRE(overlay.corner->vertex == 1);
  const auto plane = [&](Complex px) { return desk.workspace.display.viewport.plane_at_px(px); };
  const Complex arm = plane(overlay.corner->after), center(300, 0);
  // The arm points along the edge that starts at the corner.
  CHECK_THAT(std::arg(arm - center), Catch::WithinAbs(kPi / 2, kRounding));
  desk.press(arm);
  desk.move(center + std::polar(46.0, kPi / 2 - 0.1));
  desk.release(center + std::polar(46.0, kPi / 2 - 0.2));
  for (const Index v : {1, 2}) {
    CHECK_THAT(corner_at(desk.deformation(), v).after, Catch::WithinAbs(-0.2, kRounding));
    CHECK_THAT(corner_at(desk.deformation(), v).before, Catch::WithinAbs(0.2, kRounding));
    CHECK_THAT(corner_opening(desk.deformation(), v), Catch::WithinAbs(0.4, kRounding));
  }
}

TEST_CASE("Tool A: parts are joined, and the drag goes on with the nearest edge or corner") {
  Deformation parts = with_cage({}, Points{{0, 0}, {200, 0}, {200, 100}, {0, 100}});
  add_part(parts.rest,
           polygon_cage(Points{{500, 20}, {600, 0}, {700, 20}, {700, 90}, {600, 100}, {500, 90}}));
  parts.pose = parts.rest;
  parts.method = "sheet";
  for (const bool records : {false, true})
    for (const Index vertex : {1, 4, 6, 7})
      for (const bool is_edge : {false, true}) {
        CAPTURE(records, vertex, is_edge);
        TestWorkspace desk;
        desk.workspace.commit("Parts", parts);
        desk.settle();
        choose_angle_tool(desk);
        const Complex corner = parts.rest.vertex(vertex),
                      middle = 0.5 * (corner + parts.rest.end_vertex(vertex)),
                      from = is_edge ? middle : corner + 28.0;
        if (!is_edge) desk.click(corner);
        desk.update();  // corners stay picked although Puppet has no use for the cage's points
        const Modifiers mods{.ctrl = records};
        desk.press(from, mods);
        for (int k = 1; k <= 10; ++k) {
          desk.now_ms += 100;
          desk.move(is_edge ? from - Complex(0, 6.0 * k) : corner + std::polar(28.0, 0.05 * k),
                    mods);
        }
        desk.release(is_edge ? from - Complex(0, 60) : corner + std::polar(28.0, 0.5), mods);
        const Deformation& own = desk.workspace.shown.own();
        CHECK(own.method == "angles");
        CHECK(own.rest.part_count() == 1);
        CHECK_THAT(desk.workspace.messages.toasts.front().text,
                   Catch::Contains("The parts now share one outline, because Angles needs it"));
        REQUIRE(listed(own) == own.rest.size());
        const Deformation after =
            records ? posed_as(own, own.keyframes.back().pose) : desk.deformation();
        int changed = 0;
        for (Index v = 0; v < after.rest.size(); ++v)
          if (const PoseCorner pose = corner_at(after, v); pose != PoseCorner{}) {
            ++changed;
            CHECK_THAT(is_edge ? pose.tension : pose.before,
                       Catch::WithinAbs(is_edge ? 0.6 : 0.5, 1e-9));
            const Complex there = is_edge ? 0.5 * (after.rest.vertex(v) + after.rest.end_vertex(v))
                                          : after.rest.vertex(v);
            CHECK(std::abs(there - (is_edge ? middle : corner)) < 60);
          }
        CHECK(changed == 1);
        for (const Handle& handle : desk.workspace.selection)
          CHECK(corner_at(after, handle.index) != PoseCorner{});
        run("edit.undo", desk.workspace);
        CHECK(desk.workspace.shown.own().rest == parts.rest);
      }
}

TEST_CASE("Tool A: dragging an edge changes its tension and nothing else") {
  TestWorkspace desk(kBar);
  choose_angle_tool(desk);
  desk.press({150, 0});
  desk.move({150, -40});
  desk.release({150, -75});  // down by half of the length for a tension of 0
  CHECK(corner_at(desk.deformation(), 0).tension == 0.5);  // 1 - 75 / 150, exact
  CHECK(corner_at(desk.deformation(), 1).tension == 1);
  desk.settle();
  CHECK((desk.workspace.map().map().f -
         Eigen::Map<const VectorXc>(desk.workspace.map().prepared()->mesh->vertices.data(),
                                    desk.workspace.map().map().f.size()))
            .isZero(0));  // without turns, the map is still the identity
}

TEST_CASE("Tool A: clicks make points corners or plain points, but at least three corners remain") {
  TestWorkspace desk(kBar);
  choose_angle_tool(desk);
  desk.click({300, 0}, {false, false, true});
  CHECK(listed(desk.deformation()) == 3);
  CHECK_FALSE(is_corner(desk.deformation(), 1));
  desk.click({300, 100}, {false, false, true});
  CHECK(listed(desk.deformation()) == 3);
  REQUIRE(desk.workspace.messages.toasts.size() == 1);
  CHECK(desk.workspace.messages.toasts[0].text.find("three corners") != std::string::npos);
  desk.click({300, 0});
  CHECK(is_corner(desk.deformation(), 1));
}

TEST_CASE("Corners: an added corner gets the turn of its edge, and nothing moves") {
  Deformation deformation = with_method(with_cage(Deformation{}, kBar), "angles");
  deformation = without_corner(deformation, 1);
  deformation = corner_turned(deformation, 0, 0.3);
  deformation = corner_turned(deformation, 2, 0.9);
  const Deformation more = with_corner(deformation, 1);
  // At 300 of the 400 px between its neighbors. Four operations on angles below 1, each rounded to
  // 2^-54 = 6e-17.
  CHECK_THAT(corner_at(more, 1).before, Catch::WithinAbs(0.3 + 0.75 * 0.6, 1e-15));
  const auto posed = [](const Deformation& s) {
    Rest rest = rest_of(s, Precision::full);
    rest.mesh = std::make_shared<const Mesh>(domain_mesh(s.rest, {400}));
    rest.samples = rest.mesh->vertices;
    SampledMap map = method_named("angles").prepare(rest, nullptr)->deform(pose_of(s), {});
    return map.f;
  };
  CHECK((posed(deformation) - posed(more)).cwiseAbs().maxCoeff() <= 0.3);
}

TEST_CASE("Corners: corner indices are updated when points are inserted or deleted") {
  Deformation deformation = with_all_corners(with_method(with_cage(Deformation{}, kBar), "angles"));
  deformation = corner_turned(deformation, 2, 0.5);
  deformation = inserted(deformation, 0, 0.5);
  CHECK(deformation.rest.size() == 5);
  CHECK(corner_at(deformation, 3).before == 0.5);
  CHECK_FALSE(is_corner(deformation, 1));
  deformation = erased(deformation, {{Handle::Kind::cage, 1, 0}});
  CHECK(corner_at(deformation, 2).before == 0.5);
  CHECK(at_rest(deformation).corners[2].pose == PoseCorner{});
  CHECK(corner_at(reset(deformation, {{Handle::Kind::cage, 2, 0}}), 2) == PoseCorner{});
  const Deformation again = scene_from_json(json_of(scene_of(deformation)), "test").deformation();
  CHECK(again == deformation);
}

TEST_CASE("Corners: opening works for a clockwise cage, too") {
  Points clockwise(kBar.rbegin(), kBar.rend());
  Deformation deformation = with_method(with_cage(Deformation{}, clockwise), "angles");
  deformation = corner_opened(deformation, 1, 0.2);
  CHECK(corner_opening(deformation, 1) == 0.2 + 0.2);
  Rest rest = rest_of(deformation, Precision::full);
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(deformation.rest, {600}));
  rest.samples = rest.mesh->vertices;
  SampledMap map = method_named("angles").prepare(rest, nullptr)->deform(pose_of(deformation), {});
  const auto f = [&](size_t v) { return map.f[rest.mesh->cage_vertices[v]]; };
  const auto angle = [](Complex a, Complex b, Complex c) {
    return std::abs(std::arg((a - b) / (c - b)));
  };
  CHECK(angle(f(0), f(1), f(2)) > angle(clockwise[0], clockwise[1], clockwise[2]) + 0.1);
}

}  // namespace holomorph::angle_tool_test
