// Poses that nobody should ask for: every frame is proved, and none takes long.
#include <cstdio>
#include <cstdlib>

#include "core/clock.h"
#include "core/maps/distortion.h"
#include "core/maps/injectivity.h"
#include "core/maps/method.h"
#include "support/catch.h"
#include "support/random_puppet.h"
#include "support/seeds.h"

namespace holomorph::adversarial_poses_test {

namespace {

enum class Kind { collapsed, exchanged, far, wound, mirrored, count };

/// The targets of the pins after a part of the way, from 0 at rest to 1.
Pose posed(const Puppet& puppet, Kind kind, double part, const std::vector<size_t>& order,
           Complex way) {
  Pose pose{puppet.rest.cage, {}};
  const std::vector<RestPin>& pins = puppet.rest.pins;
  const Complex first = pins[0].position;
  for (size_t i = 0; i < pins.size(); ++i) {
    const Complex z = pins[i].position;
    Complex to = z;
    if (kind == Kind::collapsed) to = first;
    if (kind == Kind::exchanged) to = pins[order[i]].position;
    if (kind == Kind::far && i % 2 == 1) to = z + 10 * puppet.size * way;
    if (kind == Kind::mirrored) to = std::conj(z - first) + first;
    Complex at = (1 - part) * z + part * to;
    if (kind == Kind::wound && i > 0)
      at = first + (z - first) * std::polar(1.0, part * 4 * kPi * (i % 2 == 0 ? 1 : -1));
    pose.pins.push_back({at});
  }
  return pose;
}

}  // namespace

TEST_CASE("Puppets: every frame of adversarial poses is proved") {
  // HOLOMORPH_POSES sets another number of poses for each kind, for measurements.
  const char* given = std::getenv("HOLOMORPH_POSES");
  const int count = given ? std::atoi(given) : 1;
  double slowest_draft = 0, slowest_final = 0;
  int poses = 0;
  for (const std::string& method : puppet_methods())
    for (const unsigned seed : seeds_of("adversarial poses", {1}))
      for (int i = 0; i < count * static_cast<int>(Kind::count); ++i) {
        std::mt19937 random(seed + 1000003u * static_cast<unsigned>(i));
        const Kind kind = static_cast<Kind>(i % static_cast<int>(Kind::count));
        INFO(method << ", seed " << seed << ", pose " << i << ", kind " << static_cast<int>(kind));
        Puppet puppet = random_puppet(random);
        std::vector<size_t> order(puppet.rest.pins.size());
        for (size_t k = 0; k < order.size(); ++k) order[k] = k;
        std::shuffle(order.begin(), order.end(), random);
        const Complex way = std::polar(1.0, static_cast<double>(random() % 1000));
        const auto deformer = method_named(method).prepare(puppet.rest, nullptr);
        SampledMap map = deformer->deform(posed(puppet, kind, 0, order, way), {});
        constexpr int kFrames = 12;
        for (int frame = 1; frame <= kFrames + 3; ++frame) {
          const Pose pose = posed(puppet, kind, std::min(1.0, 1.0 * frame / kFrames), order, way);
          const double start = now_ms();
          map = deformer->deform(pose, {.derivatives = true, .draft = true}, map.solution.get());
          slowest_draft = std::max(slowest_draft, now_ms() - start);
          CHECK(map.status == SampledMap::Status::certified);
          CHECK(map.f.allFinite());
          for (Index k = 0; k < map.f.size(); ++k)
            if (!(std::abs(map.fz[k]) > std::abs(map.fzbar[k]))) FAIL("a fold at vertex " << k);
        }
        Pose pose = posed(puppet, kind, 1, order, way);
        for (size_t k = 0; k < pose.pins.size(); ++k) pose.pins[k].turn = map.turns[k];
        // Without flipped triangles, nothing folds, however thinly a limb is wound up.
        if (flipped_triangles(*puppet.rest.mesh, map.f) == 0)
          CHECK_FALSE(injectivity_of(*puppet.rest.mesh, map.f).folds());
        const double start = now_ms();
        const SampledMap found = deformer->deform(pose, {});
        slowest_final = std::max(slowest_final, now_ms() - start);
        CHECK(found.status == SampledMap::Status::certified);
        ++poses;
      }
  if (given)
    std::printf("%d poses: slowest draft %.1f ms, slowest final %.0f ms\n", poses, slowest_draft,
                slowest_final);
}

}  // namespace holomorph::adversarial_poses_test
