// Maps that a worker solves: the newest answer is displayed, drafts improve, and final maps are the
// same as if they were solved from scratch.

#include "scene/live_map.h"
#include "scene/keyframes.h"
#include "support/catch.h"
#include "support/pinned_bar.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::live_map_test {

namespace {

const MeshOptions kMesh{500};
const EvalOptions kDraft{.derivatives = false, .draft = true};

/// The bar with its right end raised.
Deformation bent(Deformation deformation, double part) {
  deformation.pins[2].pose = Complex(550 - 100 * part, 50 + 200 * part);
  return deformation;
}

VectorXc solved(const Deformation& deformation) {
  return prepared_map(deformation, Precision::single, kMesh)
      ->deformer->deform(pose_of(deformation), {})
      .f;
}

double difference(const VectorXc& a, const VectorXc& b) {
  REQUIRE(a.size() == b.size());
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("A drag never waits, shows what is ready, and ends in the final map") {
  for (const std::string method : {"puppet", "bounded", "arap", "har_arap"}) {
    INFO(method);
    const Deformation start = pinned_bar(method);
    LiveMap map(kMesh);
    map.finish(start, {});
    REQUIRE(map.has_map());
    for (int i = 1; i <= 30; ++i) {
      map.update(bent(start, i / 30.0), kDraft);
      // The displayed map may be that of an earlier pose, and the program knows of which.
      REQUIRE(map.posed());
      CHECK(map.map().f.size() == static_cast<Index>(map.drawn()->vertices.size()));
    }
    const Deformation end = bent(start, 1);
    map.finish(end, kDraft);
    CHECK_FALSE(map.busy());
    CHECK(map.posed() == end);
    // Drafts may use a coarser basis, and the local steps of har_arap converge slowly.
    if (method != "har_arap") CHECK(difference(map.map().f, solved(end)) <= 0.5);
    map.finish(end, {});
    CHECK(difference(map.map().f, solved(end)) == 0);
  }
}

TEST_CASE("A draft improves while the pointer rests") {
  const Deformation start = pinned_bar("puppet"), end = bent(start, 1);
  LiveMap map(kMesh);
  map.finish(start, {});
  map.finish(end, kDraft);
  CHECK(difference(map.map().f, solved(end)) <= 1e-3 * 600);
  CHECK(map.map().status == SampledMap::Status::certified);
}

TEST_CASE("Requests that follow each other closely end in the last one") {
  for (const unsigned seed : seeds_of("live_map_test", {1, 2})) {
    std::mt19937 random(seed);
    const Deformation start = pinned_bar("puppet");
    LiveMap map(kMesh);
    for (int i = 0; i < 40; ++i) {
      Deformation now = bent(start, static_cast<double>(random() % 100) / 100);
      if (random() % 8 == 0) now.method = "arap";
      map.update(now, random() % 2 ? kDraft : EvalOptions{});
      if (random() % 3 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(random() % 30));
      if (random() % 20 == 0) map.clear();
    }
    const Deformation last = bent(start, 0.5);
    map.finish(last, {});
    CHECK_FALSE(map.busy());
    CHECK(difference(map.map().f, solved(last)) == 0);
  }
}

TEST_CASE("The worker finds the maps at keyframes, and a drag does not wait for them") {
  Deformation deformation = pinned_bar("puppet");
  for (const double time : {0.0, 1.0, 2.0})
    deformation.keyframes.push_back(
        {time, whole_pose_of(bent(deformation, time)), Ease::linear, 0, {}});
  LiveMap map(kMesh);
  map.finish(deformation, {});
  CHECK_FALSE(map.follow_keys());
  CHECK(map.busy());
  map.update(bent(deformation, 0.3), kDraft);  // interrupts
  map.finish(bent(deformation, 0.3), kDraft);
  CHECK(map.posed() == bent(deformation, 0.3));
  const auto at = [&](double time) {
    for (int i = 0; i < 2000; ++i) {
      map.update(deformation, {}, {time});
      if (!map.busy() && map.timed()) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    REQUIRE(map.timed());
    return map.map().f;
  };
  CHECK(difference(at(1), solved(bent(deformation, 1))) <= 1e-6 * 600);
  CHECK(difference(at(2), solved(bent(deformation, 2))) <= 1e-6 * 600);
  CHECK(map.follow_keys());
}

}  // namespace holomorph::live_map_test
