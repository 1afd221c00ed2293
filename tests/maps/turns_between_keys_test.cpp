// Whole turns between two keys: a key that is set between them does not change the motion.
#include "scene/keyframes.h"
#include "scene/motion.h"
#include "scene/prepared_map.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::turns_between_keys_test {

namespace {

/// A bar that makes whole turns between two keys with the same pose, or with poses that differ by a
/// rotation.
struct Spin {
  std::string method;
  bool fixes_angle = false;
  int turns = 1;
  double angle = 0;  ///< of the second key
};

Deformation film_of(const Spin& spin) {
  Deformation film;
  film.rest = film.pose = polygon_cage(shapes::rectangle(600, 100));
  film.method = spin.method;
  const bool has_pins = method_named(spin.method).uses_pins;
  const Complex center(50, 50);
  if (has_pins)
    for (const double x : {50.0, 550.0}) film.pins.push_back({{x, 50}, {x, 50}, {}, {}});
  if (has_pins && spin.fixes_angle) film.pins[0].angle = 0.0;
  for (const double time : {0.0, 1.0}) {
    const auto posed = [&](Complex rest) {
      return center + std::polar(1.0, time * spin.angle) * (rest - center);
    };
    for (Pin& pin : film.pins) {
      pin.pose = posed(pin.rest);
      if (pin.angle) pin.angle = time * spin.angle;
    }
    for (Index v = 0; v < film.pose.size(); ++v)
      film.pose.segments[static_cast<size_t>(v)][0] = posed(film.rest.vertex(v));
    if (method_named(spin.method).uses_corners) {
      film.corners.clear();
      for (Index v = 0; v < film.rest.size(); ++v)
        film.corners.push_back({v, {time * spin.angle, time * spin.angle, 1}, {}});
    }
    film.keyframes.push_back({time, whole_pose_of(film), Ease::linear});
  }
  film.keyframes[1].turns = spin.turns;
  return film;
}

void check_key(const Spin& spin, double time) {
  INFO(spin.method << ", angle fixed " << spin.fixes_angle << ", turns " << spin.turns << " and "
                   << spin.angle << ", key at " << time);
  const Deformation film = film_of(spin);
  const std::shared_ptr<PreparedMap> prepared = prepared_map(film, Precision::full, {600});
  Motion motion;
  motion.follow(film, false, prepared, {});
  REQUIRE(motion.plays());
  Deformation more = film;
  const Deformation there = motion.deformation_at(film, time, motion.map_at(time));
  more.keyframes.insert(more.keyframes.begin() + 1, {time, whole_pose_of(there), Ease::linear});
  preserve_turns(more, film, motion);
  Motion again;
  again.follow(more, false, prepared, {});
  for (const double u : {time, 0.1, 0.4, 0.6, 0.9}) {
    INFO("at " << u);
    CHECK((again.map_at(u) - motion.map_at(u)).cwiseAbs().maxCoeff() <= 0.003 * 600);
  }
}

}  // namespace

TEST_CASE("A key that is set before the first one makes no turns") {
  Deformation film = film_of({"arap"});  // the second key makes a turn
  film.keyframes.erase(film.keyframes.begin());
  Motion motion;
  motion.follow(film, false, prepared_map(film, Precision::full, {600}), {});
  Deformation more = film;
  more.keyframes.insert(more.keyframes.begin(), {0, film.keyframes[0].pose, Ease::linear});
  preserve_turns(more, film, motion);
  CHECK(more.keyframes[1].turns == 0);
}

TEST_CASE("A key that is set while the picture makes whole turns does not change the motion") {
  for (const unsigned seed : seeds_of("keys in turns", {1})) {
    std::mt19937 random(seed);
    const auto number = [&] { return std::abs(random_complex(random).real()); };
    for (const std::string method :
         {"sheet", "puppet", "bounded", "arap", "har_arap", "pins", "cage", "harmonic", "angles"})
      for (const bool fixes_angle : {false, true})
        for (const double time : {0.5, 0.05 + 0.9 * number()}) {
          const int turns = (number() < 0.5 ? -1 : 1) * (number() < 0.7 ? 1 : 2);
          const double angle = number() < 0.5 ? 0 : 2 * number() - 1;
          check_key({method, fixes_angle, turns, angle}, time);
        }
  }
}

}  // namespace holomorph::turns_between_keys_test
