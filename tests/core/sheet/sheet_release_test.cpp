// What sheets do when the pointer lets go of them, and where rings turn farther than the picture.
#include <cmath>

#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "support/catch.h"
#include "support/pinned_rest.h"
#include "support/random_puppet.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::sheet_release_test {

namespace {

const EvalOptions kDraft{.derivatives = false, .draft = true};

/// A deformer and what it shows while a pose is dragged.
struct Drag {
  explicit Drag(const Rest& rest)
      : rest(rest),
        deformer(method_named("sheet").prepare(rest, nullptr)),
        pose(at_rest(rest)),
        shown(deformer->deform(pose, {})) {}

  void step() { shown = deformer->deform(pose, kDraft, shown.solution.get()); }
  void settle() {
    for (int i = 0; i < 60; ++i) step();
  }
  void store_turns() {
    for (size_t i = 0; i < pose.pins.size(); ++i) pose.pins[i].turn = stored_turn(*shown.turns[i]);
  }
  SampledMap released() { return deformer->deform(pose, {.released = true}, shown.solution.get()); }
  /// The largest distance from what is shown, in units of the size.
  double apart(const SampledMap& map) const {
    return (map.f - shown.f).cwiseAbs().maxCoeff() / box_of(rest.samples).diagonal();
  }

  Rest rest;
  std::unique_ptr<Deformer> deformer;
  Pose pose;
  SampledMap shown;
};

}  // namespace

TEST_CASE("Releases: turns that lead away from the draft are replaced by those that lead to it") {
  size_t replaced = 0;
  const std::vector<unsigned> seeds = seeds_of("releases", {1, 2, 6});
  for (const unsigned seed : seeds) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Drag drag(rest_of(polygon_cage(shapes::rectangle(900, 90)), {{50, 45}, {450, 45}, {850, 45}}));
    // The bar has slack, and so may form loops.
    const Complex way = -400.0 + 150.0 * random_complex(random);
    for (int k = 1; k <= 40; ++k) {
      drag.pose.pins[2].position = drag.rest.pins[2].position + k / 40.0 * way;
      drag.step();
    }
    drag.settle();
    drag.store_turns();
    // The draft's own turns lead to it.
    const SampledMap right = drag.released();
    CHECK(right.better_turns.empty());
    CHECK(drag.apart(right) <= 1e-3);
    // These often lead to a map that is wound up.
    PosePin& pin = drag.pose.pins[2];
    pin.turn = stored_turn(*pin.turn + (random() % 2 == 0 ? 2 : -2) * kPi);
    const double away = drag.apart(drag.deformer->deform(drag.pose, {}));
    const SampledMap released = drag.released();
    CHECK(drag.apart(released) <= 1e-3);
    CHECK(released.better_turns.empty() == (away <= 1e-3));
    if (away <= 1e-3) continue;
    ++replaced;
    REQUIRE(released.better_turns.size() == 3);
    for (size_t i = 0; i < 3; ++i) drag.pose.pins[i].turn = released.better_turns[i];
    const auto elsewhere = method_named("sheet").prepare(drag.rest, nullptr);
    CHECK((elsewhere->deform(drag.pose, {}).f - released.f).cwiseAbs().maxCoeff() <= 1e-6);
  }
  CHECK(replaced >= seeds.size() / 8);
}

TEST_CASE("Drafts come to rest in a few steps") {
  int steps = 0;
  constexpr int kDrags = 12;
  for (unsigned i = 0; i < kDrags; ++i) {
    std::mt19937 random(7 + 1000003u * i);
    const Puppet puppet = random_puppet(random);
    Drag drag(puppet.rest);
    const Complex way = 0.25 * puppet.size * std::polar(1.0, 0.01 * (random() % 628));
    for (int k = 1; k <= 25; ++k) {
      drag.pose.pins[0].position = puppet.rest.pins[0].position + k / 25.0 * way;
      drag.step();
    }
    for (double apart = 1; apart > 1e-9 && steps < 1000; ++steps) {
      const SampledMap before = drag.shown;
      drag.step();
      apart = drag.apart(before);
    }
  }
  CHECK(steps <= 14 * kDrags);  // 18 with projected steps only
}

TEST_CASE("The tip of a thin limb is where many more steps would take it") {
  for (const unsigned seed : seeds_of("thin limbs", {1, 2})) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const double length = 600 + 200 * random_complex(random).real();
    const Points outline{{0, 0},     {200, 0},   {200, 90}, {200 + length, 110},
                         {200, 130}, {200, 200}, {0, 200}};
    Rest rest = rest_of(polygon_cage(outline), {{132, 16}});
    rest.pins[0].has_frame = true;
    Drag drag(rest);
    drag.pose.pins[0].angle = 0.3 * random_complex(random).real();
    drag.pose.pins[0].scale = 1.1;
    const SampledMap found = drag.deformer->deform(drag.pose, {});
    drag.shown = found;
    drag.settle();
    CHECK(drag.apart(found) <= 1e-5);
  }
}

TEST_CASE("Rings: a photograph that cannot follow a ring stops, and does not snap back") {
  for (const unsigned seed : seeds_of("rings in photographs", {1, 2})) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const double x = 350 + 45 * static_cast<double>(random() % 20),
                 y = 250 + 25 * static_cast<double>(random() % 20);
    Rest rest = rest_of(polygon_cage(shapes::rectangle(1600, 1000)), {{x, y}});
    rest.frame = random() % 2 == 0 ? Frame::slide : Frame::fixed;
    rest.pins[0].has_frame = true;
    Drag drag(rest);
    double before = 0, most = 0;
    for (int degrees = 5; degrees <= 540; degrees += 5) {
      drag.pose.pins[0].angle = degrees * kPi / 180;
      drag.step();
      const double turn = *drag.shown.turns[0];
      CHECK(turn <= drag.pose.pins[0].angle + 0.1);
      CHECK(turn > before - 0.2);
      most = std::max(most, turn);
      before = turn;
    }
    CHECK(most > 1.7);
    drag.settle();
    const SampledMap settled = drag.shown;
    drag.step();
    CHECK(drag.apart(settled) < 1e-5);
    drag.store_turns();
    const SampledMap released = drag.released();
    CHECK(released.status == SampledMap::Status::certified);
    CHECK(drag.apart(released) <= 1e-3);
  }
}

TEST_CASE("Rings: a whole turn twists a limb, but turns all of a picture back to rest") {
  Rest rest = rest_of(polygon_cage(shapes::rectangle(1600, 200)), {{1400, 100}, {200, 100}});
  rest.pins[0].has_frame = true;
  Drag drag(rest);
  for (int degrees = 5; degrees <= 360; degrees += 5) {
    drag.pose.pins[0].angle = degrees * kPi / 180;
    drag.step();
    CHECK(std::abs(*drag.shown.turns[0] - drag.pose.pins[0].angle) < 0.2);
  }
  CHECK(drag.apart(drag.deformer->deform(at_rest(rest), {})) > 0.02);

  rest.pins.pop_back();
  Drag alone(rest);
  alone.pose.pins[0].angle = 2 * kPi;
  alone.step();
  for (size_t i = 0; i < rest.samples.size(); ++i)
    CHECK(std::abs(alone.shown.f[static_cast<Index>(i)] - rest.samples[i]) < 1e-9);
  // It turns on from there.
  alone.pose.pins[0].angle += 0.1;
  alone.step();
  CHECK(std::abs(*alone.shown.turns[0] - alone.pose.pins[0].angle) < 1e-9);
}

TEST_CASE("Rings: a bar that turns as a whole stays a bar, whichever pins have rings") {
  for (const double degrees : {170.0, 200.0, -300.0, 560.0})
    for (const int framed : {0, 2, 5, 7}) {
      CAPTURE(degrees, framed);
      Rest rest = rest_of(polygon_cage(shapes::rectangle(1600, 200)),
                          {{200, 100}, {800, 100}, {1400, 100}});
      for (size_t i = 0; i < 3; ++i) rest.pins[i].has_frame = (framed >> i) % 2 == 1;
      const double turn = degrees * kPi / 180;
      Pose pose = at_rest(rest);
      for (PosePin& pin : pose.pins) {
        pin.position =
            Complex(800, 100) + (pin.position - Complex(800, 100)) * std::polar(1.0, turn);
        pin.angle = turn;
        pin.turn = turn;
      }
      const auto deformer = method_named("sheet").prepare(rest, nullptr);
      const SampledMap rigid = deformer->deform(pose, {});
      CHECK(rigid.extremes.value().smallest == 1);
      for (const auto& each : rigid.turns) CHECK(std::abs(*each - turn) < 1e-9);
      // A little off, it is bent a little.
      pose.pins[1].position += Complex(9, 12);
      const SampledMap bent = deformer->deform(pose, {});
      CHECK(bent.extremes.value().smallest > 0.9);
      CHECK(bent.extremes.value().largest < 1.1);
      for (const auto& each : bent.turns) CHECK(std::abs(*each - turn) < 0.2);
    }
}

}  // namespace holomorph::sheet_release_test
