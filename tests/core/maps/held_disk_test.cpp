// The disks that pins with a frame hold.
#include "core/maps/held_disk.h"

#include <random>

#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::held_disk_test {

namespace {

/// The largest deviation from a rotation near the middle of a bar of 600 x 100, whose middle pin is
/// turned by `angle` while pins at the ends stay.
double deviation(const Method& method, double angle, std::optional<double> radius) {
  Rest rest;
  rest.cage = polygon_cage(shapes::rectangle(600, 100));
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {2000}));
  rest.samples = rest.mesh->vertices;
  rest.precision = Precision::full;
  Pose pose{rest.cage, {}};
  for (const double x : {50.0, 300.0, 550.0}) {
    const bool turned = x == 300;
    rest.pins.push_back({{x, 50}, turned, turned ? radius : std::nullopt});
    pose.pins.push_back({{x, 50}, turned ? angle : 0});
  }
  const VectorXc f = method.prepare(used_by(method, rest), nullptr)->deform(pose, {}).f;
  const Complex center(300, 50);
  double largest = 0;
  for (Index i = 0; i < f.size(); ++i) {
    const Complex off = rest.samples[static_cast<size_t>(i)] - center;
    if (std::abs(off) < 40)
      largest = std::max(largest, std::abs(f[i] - center - std::polar(1.0, angle) * off));
  }
  return largest;
}

}  // namespace

TEST_CASE("Held disks: they do not reach over a gap") {
  // Two legs that are 20 apart and joined at the top.
  const Cage legs = polygon_cage(
      Points{{0, 0}, {40, 0}, {40, 200}, {60, 200}, {60, 0}, {100, 0}, {100, 240}, {0, 240}});
  for (const unsigned seed : seeds_of("held disks", {1, 2, 3, 4})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> along(60, 110), wide(45, 80);
    const double y = along(random);
    const RestPin pin{{20, y}, true, wide(random)};
    const Points disk = held_disk(legs, pin);
    CHECK(disk.front() == pin.position);
    CHECK(disk.size() > 8);
    CHECK(disk.size() <= 91);
    for (const Complex& z : disk) {
      CHECK(std::abs(z - pin.position) <= *pin.radius * (1 + 1e-12));
      CHECK(z.real() < 40);
    }
  }
}

TEST_CASE("Held disks: without a radius, 3 % of the cage's diagonal") {
  const Cage bar = polygon_cage(shapes::rectangle(400, 300));
  CHECK(held_radius(bar, {{50, 50}, true}) == Approx(15));
  CHECK(held_radius(bar, {{50, 50}, true, 40}) == 40);
  CHECK(held_disk(bar, {{50, 50}, true}).size() == 7);
}

TEST_CASE("Held disks: a larger disk is closer to a rotation") {
  for (const unsigned seed : seeds_of("larger disks", {1, 2})) {
    std::mt19937 random(seed);
    const double angle = std::uniform_real_distribution<double>(0.5, 1.1)(random);
    for (const Method& method : methods()) {
      if (!method.holds_disks) continue;
      INFO(method.id << ", seed " << seed << ", angle " << angle);
      const double usual = deviation(method, angle, {}), large = deviation(method, angle, 45);
      CHECK(usual > 0.3);
      CHECK(large < 0.6 * usual);
    }
  }
}

TEST_CASE("Held disks: a radius without effect needs no new preparation") {
  for (const Method& method : methods()) {
    if (!method.uses_pins || method.follows_others) continue;
    INFO(method.id);
    Rest rest;
    rest.pins = {{{50, 50}, true}, {{300, 50}, false}};
    const Rest before = used_by(method, rest);
    rest.pins[1].radius = 30;  // a free pin holds no disk
    CHECK(used_by(method, rest) == before);
    rest.pins[0].radius = 30;
    CHECK((used_by(method, rest) == before) == !method.holds_disks);
  }
}

}  // namespace holomorph::held_disk_test
