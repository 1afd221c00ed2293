// Maps between keyframes: what one moment costs, and that it does not depend on other moments.
#include "scene/motion.h"

#include <algorithm>
#include <random>

#include "scene/keyframes.h"
#include "scene/timed_map.h"
#include "support/catch.h"
#include "support/seeds.h"

namespace holomorph::motion_test {

namespace {

const Points kBar{{0, 0}, {300, 0}, {300, 100}, {0, 100}};

/// A bar with two pins and a keyframe every half second, with random poses, eases and turns. Some
/// successive poses are equal.
Deformation film_of(const char* method, size_t keys, std::mt19937& random) {
  Deformation deformation = with_cage(Deformation{}, kBar);
  deformation.method = method;
  deformation.pins.push_back({{50, 50}, {50, 50}, 0.0, {}});
  deformation.pins.push_back({{250, 50}, {250, 50}, {}, {}});
  for (size_t k = 0; k < keys; ++k) {
    if (random() % 8 != 0) {
      deformation.pins[0].angle = random_complex(random).real();
      for (Pin& pin : deformation.pins) pin.pose = pin.rest + 20.0 * random_complex(random);
    }
    deformation = with_key(std::move(deformation), 0.5 * static_cast<double>(k));
    Keyframe& key = deformation.keyframes.back();
    key.ease = std::array{Ease::smooth, Ease::smooth, Ease::linear, Ease::hold}[random() % 4];
    key.turns = random() % 3 == 0 ? static_cast<int>(random() % 5) - 2 : 0;
  }
  return deformation;
}

/// Counts the poses that a deformer solves.
class Counting : public Deformer {
 public:
  Counting(std::unique_ptr<Deformer> deformer, int& count)
      : deformer_(std::move(deformer)), count_(count) {}
  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) override {
    ++count_;
    return deformer_->deform(pose, options, from);
  }
  std::shared_ptr<const ProvedMotion> motion() const override { return deformer_->motion(); }

 private:
  std::unique_ptr<Deformer> deformer_;
  int& count_;
};

}  // namespace

TEST_CASE("Motion: one moment needs the maps of at most four keyframes") {
  for (const unsigned seed : seeds_of("moments of a motion", {1, 2})) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const Deformation film = film_of("pins", 40, random);
    int count = 0;
    const std::shared_ptr<PreparedMap> prepared =
        prepared_map(film, Precision::single, MeshOptions{300});
    prepared->deformer = std::make_unique<Counting>(std::move(prepared->deformer), count);
    for (int i = 0; i < 6; ++i) {
      const double time = std::uniform_real_distribution<double>(-1, 21)(random);
      Motion one, all;
      count = 0;
      one.follow_at(time, film, false, prepared);
      const VectorXc alone = one.map_at(time);
      CHECK(count <= 4);
      one.deformation_at(film, time, alone);
      all.follow(film, false, prepared);
      CHECK(alone == all.map_at(time));
      // The next moment needs no more than the maps that are still unknown.
      count = 0;
      one.follow_at(time + 0.5, film, false, prepared);
      CHECK(count <= 4);
    }
    count = 0;
    Motion all;
    all.follow(film, false, prepared);
    CHECK(count > 25);
  }
}

TEST_CASE("Motion: moments have the same bits, whichever others were asked for before") {
  for (const char* method : first_of<const char*>({"pins", "sheet", "puppet", "arap"}, 2))
    for (const unsigned seed : seeds_of("bits of moments", {1})) {
      CAPTURE(method, seed);
      std::mt19937 random(seed);
      const Deformation film = film_of(method, 5, random);
      std::vector<double> times;
      for (int i = 0; i < few_or_many(1, 5); ++i)
        times.push_back(std::uniform_real_distribution<double>(0, 2)(random));
      TimedMap in_order(film);
      for (double time = 0; time < 2; time += 0.4) in_order.frame(time);
      for (const double time : times) {
        CAPTURE(time);
        TimedMap alone(film);
        CHECK(alone.on_mesh(alone.frame(time)).f == in_order.on_mesh(in_order.frame(time)).f);
      }
    }
}

TEST_CASE("Motion: a keyframe without a map matters only to the moments that need it") {
  std::mt19937 random(5);
  Deformation film = film_of("pins", 12, random);
  for (Keyframe& key : film.keyframes) key.ease = Ease::linear;
  for (PosePin& pin : film.keyframes[8].pose.pins) pin.position = {NAN, 0};
  TimedMap timed(film);
  CHECK_NOTHROW(timed.frame(1.3));
  CHECK_THROWS_WITH(timed.frame(3.8), Catch::Contains("the keyframe at 4.00 s"));
  CHECK_NOTHROW(timed.frame(4.8));
}

}  // namespace holomorph::motion_test
