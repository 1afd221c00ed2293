// Pins that both keys hold stay between them, or the frame says which one slides, and how far.
#include "core/arithmetic.h"
#include "scene/keyframes.h"
#include "scene/motion.h"
#include "scene/prepared_map.h"
#include "scene/timed_map.h"
#include "support/catch.h"
#include "support/random_puppet.h"
#include "support/seeds.h"

namespace holomorph::still_pins_test {

namespace {

/// A random puppet with two keys. Its first two pins have the same place in both.
Deformation random_pair(const std::string& method, std::mt19937& random) {
  const Puppet puppet = random_puppet(random);
  Deformation deformation;
  deformation.rest = deformation.pose = puppet.rest.cage;
  deformation.method = method;
  for (const RestPin& rest : puppet.rest.pins) {
    Pin pin;
    pin.rest = pin.pose = rest.position;
    deformation.pins.push_back(pin);
  }
  for (const double time : {0.0, 1.0}) {
    for (size_t i = 2; i < deformation.pins.size(); ++i) {
      Pin& pin = deformation.pins[i];
      pin.pose = pin.rest + 0.3 * puppet.size * random_complex(random);
    }
    deformation.keyframes.push_back({time, whole_pose_of(deformation), Ease::linear});
  }
  return deformation;
}

/// A bar whose left end is held by two pins, while its right end swings from one side to the other.
Deformation random_swing(const std::string& method, std::mt19937& random) {
  Deformation deformation;
  deformation.rest = deformation.pose = polygon_cage(shapes::rectangle(400, 80));
  deformation.method = method;
  for (const Complex z : {Complex(30, 40), Complex(80, 40), Complex(370, 40)})
    deformation.pins.push_back({z, z, {}, {}});
  const double reach = 0.6 + 0.6 * std::abs(random_complex(random).real());  // radians
  for (const double side : {1.0, -1.0}) {
    Pin& tail = deformation.pins[2];
    const Complex center(80, 40);
    tail.pose = center + std::polar(1.0, side * reach) * (tail.rest - center);
    deformation.keyframes.push_back(
        {side > 0 ? 0.0 : 1.0, whole_pose_of(deformation), Ease::linear});
  }
  return deformation;
}

/// A long bar whose left end is held by two pins, and which curls up to both sides by 3.4 to 4.4
/// radians. On average, the picture turns by more than pi, which is no whole turn.
Deformation random_curl(const std::string& method, std::mt19937& random) {
  Deformation deformation;
  deformation.rest = deformation.pose = polygon_cage(shapes::rectangle(800, 50));
  deformation.method = method;
  for (const double x : {20.0, 80.0, 200.0, 320.0, 440.0, 560.0, 680.0, 780.0})
    deformation.pins.push_back({{x, 25}, {x, 25}, {}, {}});
  const double reach = 3.4 + std::abs(random_complex(random).real());
  for (const double side : {1.0, -1.0}) {
    for (Pin& pin : deformation.pins) {
      const double along = pin.rest.real() - 80, curvature = side * reach / 720;
      if (along > 0)
        pin.pose = Complex(80, 25) + (std::polar(1.0, curvature * along) - 1.0) / (kI * curvature);
    }
    deformation.keyframes.push_back(
        {side > 0 ? 0.0 : 1.0, whole_pose_of(deformation), Ease::linear});
  }
  return deformation;
}

/// The first two pins of a film with two keys, which hold both.
class StillPins {
 public:
  StillPins(TimedMap& timed, const Deformation& film)
      : timed_(timed),
        places_{film.pins[0].rest, film.pins[1].rest},
        from_(timed.at(timed.frame(0), places_).f),
        to_(timed.at(timed.frame(1), places_).f) {}

  /// How far they are from their straight paths at this fraction of the motion.
  VectorXc off(const TimedFrame& at, double share) const {
    return timed_.at(at, places_).f - (1 - share) * from_ - share * to_;
  }

 private:
  TimedMap& timed_;
  Points places_;
  VectorXc from_, to_;
};

/// Checks that notes name the pins that slide. Returns the number of pairs in which some do.
int check_pairs(const std::string& method, const std::vector<unsigned>& seeds) {
  int pairs = 0, sliding = 0;
  for (const unsigned seed : seeds) {
    INFO(method << ", seed " << seed);
    std::mt19937 random(seed);
    Deformation deformation = random_pair(method, random);
    const bool is_smooth = seed % 2 == 0;
    if (is_smooth) deformation.keyframes[0].ease = Ease::smooth;
    TimedMap timed(deformation);
    const double size = box_of(timed.mesh().vertices).diagonal();
    const StillPins still(timed, deformation);
    if (timed.on_mesh(timed.frame(0)).status != SampledMap::Status::certified ||
        timed.on_mesh(timed.frame(1)).status != SampledMap::Status::certified)
      continue;
    ++pairs;
    const int frames = few_or_many(4, 10);
    bool slides = false;
    for (int frame = 1; frame < frames; ++frame) {
      const double u = static_cast<double>(frame) / frames, share = is_smooth ? smoothstep(u) : u;
      const TimedFrame at = timed.frame(u);
      if (at.between.status != SampledMap::Status::certified) continue;
      const VectorXc off = still.off(at, share);
      const auto names = [&](Index pin) {
        const std::string text = "Pin " + std::to_string(pin + 1) + " slides";
        return at.between.note.find(text) != std::string::npos;
      };
      Index worst = 0;
      INFO("at " << u << ": " << at.between.note);
      const double most = off.cwiseAbs().maxCoeff(&worst);
      if (most > 1e-4 * size) {
        slides = true;
        // With two pins on different paths, the picture is placed between them.
        const bool is_tie = std::abs(off[1 - worst]) > 0.999 * most;
        CHECK((names(worst) || (is_tie && names(1 - worst))));
      } else {
        CHECK_THAT(at.between.note, !Catch::Contains("slides"));
      }
    }
    sliding += slides;
  }
  INFO(method << ": pins slide in " << sliding << " of " << pairs << " pairs");
  CHECK(pairs > 0);
  if (pairs >= 50) CHECK(sliding <= pairs / 50);
  return sliding;
}

}  // namespace

TEST_CASE("A bar that swings from side to side keeps its held end") {
  for (const unsigned seed : seeds_of("swings", {1}))
    for (const std::string method : {"puppet", "bounded"}) {
      INFO(method << ", seed " << seed);
      std::mt19937 random(seed);
      const Deformation swing = random_swing(method, random);
      TimedMap timed(swing);
      const StillPins still(timed, swing);
      for (const double u : {0.25, 0.5}) {
        const TimedFrame at = timed.frame(u);
        INFO("at " << u << ": " << at.between.note);
        CHECK(at.between.status == SampledMap::Status::certified);
        const VectorXc off = still.off(at, u);
        CHECK(off.cwiseAbs().maxCoeff() <= 1e-4 * 408);
      }
    }
}

TEST_CASE("A bar that curls up to one side and then to the other keeps its held end") {
  for (const unsigned seed : seeds_of("curls", {1}))
    for (const std::string method : {"puppet", "bounded", "sheet"}) {
      INFO(method << ", seed " << seed);
      std::mt19937 random(seed);
      const Deformation curl = random_curl(method, random);
      TimedMap timed(curl);
      REQUIRE(timed.on_mesh(timed.frame(0)).extremes);
      REQUIRE(timed.on_mesh(timed.frame(1)).extremes);
      const StillPins still(timed, curl);
      for (const double u : {0.25, 0.5}) {
        const TimedFrame at = timed.frame(u);
        INFO("at " << u << ": " << at.between.note);
        CHECK(at.between.status == SampledMap::Status::certified);
        CHECK(still.off(at, u).cwiseAbs().maxCoeff() <= 1e-4 * 802);
        CHECK_THAT(at.between.note, !Catch::Contains("slides"));
        const Complex tip = timed.at(at, Points{{780, 25}}).f[0];
        if (u == 0.5) CHECK(tip.real() > 600);  // it has not gone around the held end
      }
    }
}

TEST_CASE("A keyframe in the middle of a far swing keeps the way around") {
  for (const unsigned seed : seeds_of("keys in curls", {1}))
    for (const std::string method : {"puppet", "bounded", "sheet"}) {
      INFO(method << ", seed " << seed);
      std::mt19937 random(seed);
      const Deformation curl = random_curl(method, random);
      const std::shared_ptr<PreparedMap> prepared = prepared_map(curl, Precision::full, {});
      Motion motion;
      motion.follow(curl, false, prepared, {});
      Deformation more = curl;
      const double time = 0.5 + 0.3 * random_complex(random).real();
      const Deformation there = motion.deformation_at(curl, time, motion.map_at(time));
      more.keyframes.insert(more.keyframes.begin() + 1, {time, whole_pose_of(there), Ease::linear});
      preserve_turns(more, curl, motion);
      CHECK(more.keyframes[1].turns == 0);
      CHECK(more.keyframes[2].turns == 0);
      Motion again;
      again.follow(more, false, prepared, {});
      for (const double u : {0.2, 0.4, 0.6, 0.8})
        CHECK((again.map_at(u) - motion.map_at(u)).cwiseAbs().maxCoeff() <= 0.1 * 802);
    }
}

TEST_CASE("Frames between keys are finite and grow little, also where the picture turns around") {
  for (const unsigned seed : seeds_of("turns between keys", {1}))
    for (const std::string method : {"puppet", "bounded", "sheet"}) {
      INFO(method << ", seed " << seed);
      std::mt19937 random(seed);
      Deformation pair = random_pair(method, random);
      pair.keyframes[1].turns = 1 + static_cast<int>(seed % 2);
      TimedMap timed(pair);
      const auto largest_at = [&](double time) {
        return timed.on_mesh(timed.frame(time)).extremes->largest;
      };
      if (!timed.on_mesh(timed.frame(0)).extremes || !timed.on_mesh(timed.frame(1)).extremes)
        continue;
      const double keys = std::max(largest_at(0), largest_at(1));
      for (int frame = 1; frame < few_or_many(4, 16); ++frame) {
        const SampledMap map = timed.frame(frame / static_cast<double>(few_or_many(4, 16))).between;
        INFO("frame " << frame << ": " << map.note);
        CHECK(map.f.allFinite());
        if (map.status != SampledMap::Status::certified || method == "sheet") continue;
        REQUIRE(map.extremes);
        CHECK(map.extremes->largest <= 1.31 * keys);
      }
    }
}

TEST_CASE("A picture that makes whole turns holds one pin, and the note names another") {
  for (const unsigned seed : seeds_of("whole turns with still pins", {1}))
    for (const std::string method : {"puppet", "bounded", "sheet"}) {
      INFO(method << ", seed " << seed);
      std::mt19937 random(seed);
      Deformation swing = random_swing(method, random);
      swing.keyframes[1].turns = 1;
      TimedMap timed(swing);
      const StillPins still(timed, swing);
      for (const double u : {0.2, 0.5}) {
        const TimedFrame at = timed.frame(u);
        INFO("at " << u << ": " << at.between.note);
        REQUIRE(at.between.status == SampledMap::Status::certified);
        const VectorXc off = still.off(at, u);
        CHECK(std::abs(off[0]) <= 1e-4 * 408);
        CHECK(std::abs(off[1]) > 1e-4 * 408);
        CHECK_THAT(at.between.note,
                   Catch::Contains("Pin 2 slides") && Catch::Contains("whole turns"));
      }
    }
}

TEST_CASE("A picture that makes whole turns between equal keys turns rigidly around a still pin") {
  for (const unsigned seed : seeds_of("rigid turns", {1, 2}))
    for (const std::string method : {"puppet", "bounded", "sheet"}) {
      std::mt19937 random(seed);
      const auto number = [&] { return std::abs(random_complex(random).real()); };
      const double width = 150 + 700 * number(), height = 60 + 200 * number();
      INFO(method << ", seed " << seed << ", " << width << " x " << height);
      Deformation spin;
      spin.rest = spin.pose = polygon_cage(shapes::rectangle(width, height));
      spin.method = method;
      for (int i = 0; i < 3; ++i) {
        const double x = width * (0.05 + 0.9 * number()), y = height * (0.1 + 0.8 * number());
        spin.pins.push_back({{x, y}, {x, y}, {}, {}});
      }
      for (const double time : {0.0, 1.0})
        spin.keyframes.push_back({time, whole_pose_of(spin), Ease::linear});
      spin.keyframes[1].turns = 1;
      TimedMap timed(spin);
      const Complex held = spin.pins[0].rest;
      const Points places{
          held, spin.pins[1].rest, spin.pins[2].rest, {1, 1}, {width - 1, height - 1}};
      for (const double u : {0.15, 0.5, 0.75}) {
        const TimedFrame at = timed.frame(u);
        INFO("at " << u << ": " << at.between.note);
        CHECK(at.between.status == SampledMap::Status::certified);
        const VectorXc f = timed.at(at, places).f;
        for (size_t i = 0; i < places.size(); ++i)
          CHECK(std::abs(f[static_cast<Index>(i)] - held -
                         std::polar(1.0, 2 * kPi * u) * (places[i] - held)) <= 1e-3 * width);
      }
    }
}

TEST_CASE("Notes count all pins that slide in a picture that makes whole turns") {
  for (const std::string method : {"puppet", "bounded", "sheet"}) {
    INFO(method);
    std::mt19937 random(3);
    Deformation swing = random_swing(method, random);
    swing.pins.insert(swing.pins.begin() + 2, Pin{{140, 30}, {140, 30}, {}, {}});
    for (Keyframe& key : swing.keyframes)
      key.pose.pins.insert(key.pose.pins.begin() + 2, PosePin{{140, 30}});
    swing.keyframes[1].turns = 1;
    TimedMap timed(swing);
    const TimedFrame at = timed.frame(0.5);
    CHECK_THAT(at.between.note, Catch::Contains("Pin 3 slides") &&
                                    Catch::Contains("and another pin by less: a picture"));
  }
}

TEST_CASE("Pins that move are not said to slide, exact or not, whatever turns are asked for") {
  for (const unsigned seed : seeds_of("moving pins", {1}))
    for (const bool exact : {false, true})
      for (const bool turns_back : {false, true}) {
        INFO("exact " << exact << ", turns back " << turns_back << ", seed " << seed);
        std::mt19937 random(seed);
        Deformation swing = random_swing("sheet", random);
        swing.parameters["exact"] = exact;
        if (turns_back) {  // the pins ask for a turn, and the key for one back
          for (PosePin& pin : swing.keyframes[0].pose.pins) pin.turn = 0;
          for (PosePin& pin : swing.keyframes[1].pose.pins) pin.turn = 2 * kPi;
          swing.keyframes[1].turns = -1;
        }
        TimedMap timed(swing);
        for (const double u : {0.25, 0.5}) {
          const TimedFrame at = timed.frame(u);
          INFO("at " << u << ": " << at.between.note);
          CHECK(at.between.status == SampledMap::Status::certified);
          CHECK_THAT(at.between.note, !Catch::Contains("slides"));
        }
      }
}

TEST_CASE("Still pins of sheets move straight, and their maps are continuous at keys") {
  int frames = 0, sliding = 0;
  for (const unsigned seed : seeds_of("still pins of sheets", {1, 2}))
    for (const double roundness : {0.0, 0.5}) {
      INFO("roundness " << roundness << ", seed " << seed);
      std::mt19937 random(seed);
      Deformation pair = random_pair("sheet", random);
      pair.parameters["roundness"] = roundness;
      TimedMap timed(pair);
      const double size = box_of(timed.mesh().vertices).diagonal();
      Points places;
      for (const Pin& pin : pair.pins) places.push_back(pin.rest);
      const auto images = [&](double time) { return timed.at(timed.frame(time), places).f; };
      const VectorXc from = images(0), to = images(1);
      const auto is_certified = [&](double time) {
        return timed.on_mesh(timed.frame(time)).status == SampledMap::Status::certified;
      };
      if (!is_certified(0) || !is_certified(1)) continue;
      for (const double u : {1e-6, 0.3, 0.7, 1 - 1e-6}) {
        const TimedFrame at = timed.frame(u);
        INFO("at " << u << ": " << at.between.note);
        if (at.between.status != SampledMap::Status::certified) continue;
        ++frames;
        const VectorXc off = timed.at(at, places).f - (1 - u) * from - u * to;
        // A proof may need triangles at the pin to be straightened; the note then tells.
        Index worst = 0;
        const double most = off.head(2).cwiseAbs().maxCoeff(&worst);
        const bool slides = at.between.note.find("slides") != std::string::npos;
        sliding += slides;
        if (most <= 1e-4 * size) {
          CHECK_FALSE(slides);
        } else {
          const std::string name = "Pin " + std::to_string(worst + 1) + " slides";
          CHECK_THAT(at.between.note, Catch::Contains(name));
        }
        if (std::min(u, 1 - u) < 1e-5) CHECK(off.cwiseAbs().maxCoeff() <= 1e-4 * size);
      }
    }
  CHECK(frames > 0);
  CHECK(sliding <= frames / 10);
}

TEST_CASE("Still pins of puppets move straight from key to key, or the note names one") {
  check_pairs("puppet", seeds_of("still pins of puppets", {41}));  // one that slides
}

// Halfway, two branches of seed 27 look the same. In seed 1001, the picture swirls around a pin.
TEST_CASE("Pins that both keys hold stay where rotations are misleading") {
  CHECK(check_pairs("puppet", {27, 1001}) == 0);
}

TEST_CASE("Still pins of bounded maps move straight from key to key, or the note names one") {
  check_pairs("bounded", seeds_of("still pins of bounded maps", {1039, 7}));  // one that slides
}

}  // namespace holomorph::still_pins_test
