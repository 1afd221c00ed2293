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

}  // namespace holomorph::hold_rest_test
