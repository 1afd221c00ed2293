// Editing curved segments: tangents, smooth points, degrees, drawing.

#include "edit/actions/actions.h"
#include "edit/edits/curve_edits.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::curve_test {

namespace {

Deformation smooth_square() {
  Deformation deformation = with_cage(Deformation{}, shapes::rectangle(200, 200));
  for (Index v = 0; v < 4; ++v) deformation = smoothed(std::move(deformation), v, EditMode::pose);
  return deformation;
}

/// The largest distance between two posed cages at the same parameters.
double largest_distance(const Cage& a, const Cage& b) {
  double most = 0;
  for (Index e = 0; e < a.size(); ++e)
    for (double t = 0; t < 1; t += 0.05)
      most =
          std::max(most, std::abs(bezier_point(a.controls(e), t) - bezier_point(b.controls(e), t)));
  return most;
}

}  // namespace

TEST_CASE("Smooth points have tangents on one line; corners do not") {
  const Deformation deformation = smooth_square();
  for (Index v = 0; v < 4; ++v) {
    CHECK(is_smooth(deformation, v, EditMode::pose));
    CHECK_FALSE(is_smooth(deformation, v, EditMode::rest));
  }
  CHECK(deformation.rest == polygon_cage(shapes::rectangle(200, 200)));
  Deformation corner = cornered(deformation, 1, EditMode::pose);
  CHECK_FALSE(is_smooth(corner, 1, EditMode::pose));
  CHECK(is_smooth(corner, 0, EditMode::pose));
  const Selection two{{Handle::Kind::cage, 0, 0}, {Handle::Kind::cage, 1, 0}};
  corner = toggled_corners(corner, two, EditMode::pose);  // one is a corner, so both become smooth
  CHECK(is_smooth(corner, 1, EditMode::pose));
  corner = toggled_corners(corner, two, EditMode::pose);
  CHECK_FALSE(is_smooth(corner, 0, EditMode::pose));
}

TEST_CASE(
    "Moving a tangent rotates the opposite one and keeps its length, unless Alt breaks the pair") {
  const Deformation deformation = smooth_square();
  const auto [before, after] = tangents_of(deformation, 1, EditMode::pose);
  const Complex z = deformation.pose.vertex(1);
  const double length = std::abs(position_of(deformation, *before, EditMode::pose) - z);
  const Deformation bent =
      tangent_moved(deformation, *after, z + Complex(70, 10), EditMode::pose, false);
  CHECK(is_smooth(bent, 1, EditMode::pose));
  // A rotation about z: a few operations on coordinates below 512, each rounded to 3e-14.
  CHECK_THAT(std::abs(position_of(bent, *before, EditMode::pose) - z),
             Catch::WithinAbs(length, 1e-12));
  CHECK(position_of(bent, *after, EditMode::pose) == z + Complex(70, 10));
  const Deformation broken =
      tangent_moved(deformation, *after, z + Complex(70, 10), EditMode::pose, true);
  CHECK(position_of(broken, *before, EditMode::pose) ==
        position_of(deformation, *before, EditMode::pose));
  CHECK_FALSE(is_smooth(broken, 1, EditMode::pose));
}

TEST_CASE("Raising the degree keeps the curve, and lowering it again restores the curve") {
  const Deformation deformation = smooth_square();
  Deformation high = deformation;
  for (int i = 0; i < 9; ++i) high = raised(std::move(high), {}, EditMode::pose);
  CHECK(high.pose.degree(0) == kHighestDegree);
  CHECK(largest_distance(high.pose, deformation.pose) < 1e-10);
  for (int i = 0; i < 5; ++i) high = lowered(std::move(high), {}, EditMode::pose);
  CHECK(high.pose.degree(0) == 3);
  CHECK(largest_distance(high.pose, deformation.pose) < 1e-8);
  const Deformation one = raised(deformation, {{Handle::Kind::cage, 2, 0}}, EditMode::pose);
  CHECK(one.pose.degree(2) == 4);
  CHECK(one.pose.degree(1) == 3);
  Deformation straight = deformation;
  for (int i = 0; i < 5; ++i) straight = lowered(std::move(straight), {}, EditMode::pose);
  CHECK(straight.pose.degree(0) == 1);
}

TEST_CASE("Dragging a tangent is one step; Ctrl-click and C toggle smooth points") {
  TestWorkspace desk(shapes::rectangle(200, 200));
  desk.click({200, 0}, {true, false, false});
  REQUIRE(is_smooth(desk.deformation(), 1, EditMode::pose));
  const size_t steps = desk.steps();
  const Handle tangent = *tangents_of(desk.deformation(), 1, EditMode::pose).after;
  const Complex from = position_of(desk.deformation(), tangent, EditMode::pose);
  desk.drag(from, from + Complex(40, 5));
  CHECK(desk.steps() == steps + 1);
  CHECK(is_smooth(desk.deformation(), 1, EditMode::pose));
  const Complex there = position_of(desk.deformation(), tangent, EditMode::pose);
  desk.drag(there, there + Complex(-80, 30), {false, false, true});  // Alt breaks the pair
  CHECK_FALSE(is_smooth(desk.deformation(), 1, EditMode::pose));
  desk.click({200, 0});
  CHECK(desk.workspace.selection.size() == 1);
  run("cage.corner", desk.workspace);
  CHECK(is_smooth(desk.deformation(), 1, EditMode::pose));
  desk.settle();
  CHECK(desk.workspace.map().has_map());
  CHECK_FALSE(desk.workspace.map().error());
}

TEST_CASE("Pen: dragging makes smooth points, and the drawn cage is curved at rest") {
  TestWorkspace desk;
  desk.workspace.tools.active = ToolId::pen;
  desk.click({0, 0});
  desk.press({200, 0});
  desk.move({240, 30});
  desk.release({240, 30});
  desk.click({200, 200});
  desk.click({0, 200});
  desk.click({0, 0});
  REQUIRE(desk.deformation().rest.size() == 4);
  CHECK(desk.deformation().rest.degree(0) == 3);
  CHECK(desk.deformation().rest.degree(1) == 3);
  CHECK(desk.deformation().rest.degree(2) == 1);
  CHECK(desk.deformation().rest.segments[1][1] == Complex(240, 30));
  CHECK(is_smooth(desk.deformation(), 1, EditMode::rest));
  desk.settle();
  REQUIRE(desk.workspace.map().has_map());
  const Mesh& mesh = *desk.workspace.map().prepared()->mesh;
  const VectorXc& f = desk.workspace.map().map().f;
  for (size_t i = 0; i < mesh.vertices.size(); ++i)
    CHECK(f[static_cast<Index>(i)] == mesh.vertices[i]);  // the identity at rest
}

TEST_CASE("Pins can be applied to the posed cage, which gives the same map") {
  TestWorkspace desk(shapes::rectangle(200, 200));
  run("cage.raise", desk.workspace);
  run("cage.raise", desk.workspace);
  desk.workspace.tools.active = ToolId::pin;
  for (const Complex z : {Complex(40, 40), Complex(160, 50), Complex(100, 160)}) {
    desk.settle();
    desk.drag(z, z + Complex(9, -6) * (z.real() / 100));
  }
  run("cage.bake", desk.workspace);
  CHECK(desk.deformation().method == "pins");  // refused, and a toast says why
  REQUIRE_FALSE(desk.workspace.messages.toasts.empty());
  Deformation deformation = desk.deformation();
  deformation.parameters["own_controls"] = 1;
  desk.workspace.commit("Own points", deformation);
  desk.settle();
  const VectorXc before = desk.workspace.map().map().f;
  run("cage.bake", desk.workspace);
  CHECK(desk.deformation().method == "cage");
  desk.settle();
  CHECK((desk.workspace.map().map().f - before).cwiseAbs().maxCoeff() < 1e-2);  // single precision
}

TEST_CASE("Curves of the rest shape are edited like posed ones, and an unposed picture follows") {
  TestWorkspace desk(shapes::rectangle(200, 200));
  run("cage.rest", desk.workspace);
  desk.click({200, 0}, {true, false, false});
  CHECK(is_smooth(desk.deformation(), 1, EditMode::rest));
  CHECK(desk.deformation().pose == desk.deformation().rest);
  const Handle tangent = *tangents_of(desk.deformation(), 1, EditMode::rest).after;
  const Complex from = position_of(desk.deformation(), tangent, EditMode::rest);
  const size_t steps = desk.steps();
  desk.drag(from, {-900, 100});  // past the opposite side
  CHECK(desk.steps() == steps);  // refused
  CHECK_FALSE(desk.workspace.messages.toasts.empty());
}

}  // namespace holomorph::curve_test
