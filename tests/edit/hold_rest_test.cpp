// One click pins what is far from a single pin.
#include "edit/hold_rest.h"

#include "core/mesh/mesher.h"
#include "edit/actions/actions.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/seeds.h"

namespace holomorph::hold_rest_test {

namespace {

/// A star with this many arms around (0, 0).
Points arms(int count) {
  Points polygon;
  for (int i = 0; i < count; ++i) {
    const auto at = [&](double radius, double turn) {
      polygon.push_back(std::polar(radius, 2 * kPi * (i + turn) / count));
    };
    at(60, 0.35);
    at(300, 0.45);
    at(300, 0.55);
    at(60, 0.65);
  }
  return polygon;
}

}  // namespace

TEST_CASE("Far points are in the arms that have no pin, inside of the picture") {
  for (const unsigned seed : seeds_of("hold the rest", {1, 2, 3})) {
    std::mt19937 random(seed);
    const int count = 3 + static_cast<int>(random() % 4), first = static_cast<int>(random() % 3);
    INFO("seed " << seed << ", " << count << " arms");
    const Points polygon = arms(count);
    const Mesh mesh = domain_mesh(polygon_cage(polygon), {1500});
    const auto arm_of = [&](Complex z) {
      const double turn = std::arg(z) / (2 * kPi) * count;
      return ((static_cast<int>(std::floor(turn)) % count) + count) % count;
    };
    const Complex pin = std::polar(250.0, 2 * kPi * (first + 0.5) / count);
    const Points far = far_points(mesh, std::vector{pin});
    REQUIRE(far.size() >= static_cast<size_t>(count - 1));
    std::set<int> held;
    for (const Complex& z : far) {
      CHECK(nearest_on_polygon(polygon, z).distance > 5);
      CHECK(std::abs(z - pin) > 100);
      if (std::abs(z) > 150) held.insert(arm_of(z));
    }
    CHECK(held.size() == static_cast<size_t>(count - 1));
    CHECK_FALSE(held.contains(first % count));
    // Another part of the picture follows, and needs no pin.
    Cage two = polygon_cage(polygon);
    add_part(two, polygon_cage(Points{{400, 0}, {600, 0}, {600, 200}, {400, 200}}));
    const Points again = far_points(domain_mesh(two, {2000}), std::vector{pin});
    CHECK(again.size() >= static_cast<size_t>(count - 1));
    for (const Complex& z : again) CHECK(std::abs(z) < 310);
  }
}

TEST_CASE("Hold the rest is offered with a single pin, and moves nothing") {
  TestWorkspace desk(arms(4));
  Workspace& w = desk.workspace;
  CHECK_FALSE(can_hold_rest(w));
  Deformation deformation = desk.deformation();
  deformation.method = "puppet";
  deformation.pins = {{{250, 0}, {280, 40}, {}, {}}};
  w.commit("Pin", deformation);
  desk.settle();
  REQUIRE(can_hold_rest(w));
  const VectorXc before = w.map().map().f;
  const size_t steps = desk.steps();
  run("edit.hold_rest", w);
  CHECK(desk.steps() == steps + 1);
  CHECK(desk.deformation().pins.size() >= 4);
  CHECK_FALSE(can_hold_rest(w));
  desk.settle();
  CHECK((w.map().map().f - before).cwiseAbs().maxCoeff() < 0.5);
}

TEST_CASE("In a photograph, the rest is what is beyond a circle, which can be dragged") {
  TestWorkspace desk(Points{{0, 0}, {600, 0}, {600, 400}, {0, 400}});
  Workspace& w = desk.workspace;
  Deformation deformation = desk.deformation();
  deformation.method = "sheet";
  deformation.frame = Frame::slide;
  deformation.pins = {{{300, 200}, {300, 200}, {}, {}}};
  w.commit("Photograph", deformation);
  desk.settle();
  REQUIRE(can_hold_rest(w));
  run("edit.hold_rest", w);
  REQUIRE(desk.deformation().held_beyond);
  CHECK_FALSE(can_hold_rest(w));
  const double before = *desk.deformation().held_beyond;
  // A moved pin moves nothing beyond it.
  deformation = desk.deformation();
  deformation.pins[0].pose += 40;
  w.commit("Move", deformation);
  desk.settle();
  const SampledMap& map = w.map().map();
  CHECK(map.status == SampledMap::Status::certified);
  const Mesh& mesh = *w.map().prepared()->mesh;
  const double edge = 0.04 * std::hypot(600, 400);
  double moved = 0;
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double off = std::abs(map.f[static_cast<Index>(v)] - mesh.vertices[v]);
    moved = std::max(moved, off);
    if (std::abs(mesh.vertices[v] - Complex(300, 200)) > before + 2 * edge) CHECK(off < 1e-9);
  }
  CHECK(moved > 35);
  // The circle is around the pin at rest.
  w.tools.active = ToolId::pin;
  const Complex on = Complex(300, 200) + std::polar(before, 2.0),
                to = Complex(300, 200) + std::polar(before + 50, 2.0);
  desk.press(on);
  for (int i = 1; i <= 5; ++i) desk.move(on + (to - on) * (i / 5.0));
  desk.release(to);
  CHECK(*desk.deformation().held_beyond == Approx(before + 50).margin(1));
  CHECK(desk.deformation().pins.size() == 1);
  run("edit.let_go", w);
  CHECK_FALSE(desk.deformation().held_beyond);
  run("edit.undo", w);
  CHECK(*desk.deformation().held_beyond == Approx(before + 50).margin(1));
}

}  // namespace holomorph::hold_rest_test
