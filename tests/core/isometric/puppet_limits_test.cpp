// The puppet with limits on its distortion.

#include "core/maps/distortion.h"
#include "core/maps/method.h"
#include "support/catch.h"
#include "support/random_puppet.h"
#include "support/seeds.h"

namespace holomorph::puppet_limits_test {

namespace {

const Method& puppet_method_row() {
  return method_named("puppet");
}

/// Random targets; the farthest ones cannot be reached.
Pose random_pose(const Puppet& puppet, double reach, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Pose pose{puppet.rest.cage, {}};
  for (const RestPin& pin : puppet.rest.pins) {
    const double right = uniform(random), up = uniform(random);
    pose.pins.push_back({pin.position + reach * puppet.size * Complex(right, up)});
  }
  return pose;
}

}  // namespace

TEST_CASE("Puppet: limits hold everywhere, in drafts and in final answers, at rest and far away") {
  for (const unsigned seed : seeds_of("puppet_limits_test", {1, 2, 3})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    Puppet puppet = random_puppet(random);
    const double k = 0.1 + 0.8 * uniform(random), sigma = 0.2 + 0.6 * uniform(random),
                 Sigma = 1.1 + 2 * uniform(random);
    puppet.rest.parameters = {{"limited", 1}, {"k", k}, {"sigma", sigma}, {"Sigma", Sigma}};
    INFO("seed " << seed << ", k " << k << ", sigma " << sigma << ", Sigma " << Sigma);
    const auto deformer = puppet_method_row().prepare(puppet.rest, nullptr);
    const SampledMap still = deformer->deform(random_pose(puppet, 0, random), {});
    CHECK(still.f == Eigen::Map<const VectorXc>(puppet.rest.samples.data(), still.f.size()));

    SampledMap last = still;
    for (const double reach : {0.05, 0.2, 1.0}) {
      const Pose pose = random_pose(puppet, reach, random);
      INFO("reach " << reach);
      for (int frame = 0; frame < 10; ++frame) {
        last = deformer->deform(pose, {.derivatives = true, .draft = true}, last.solution.get());
        CHECK(last.status == SampledMap::Status::certified);
        for (Index i = 0; i < last.f.size(); ++i) {
          const double size = std::abs(last.fz[i]), shear = std::abs(last.fzbar[i]);
          REQUIRE(shear <= (k + 1e-6) * size);
          REQUIRE(size + shear <= Sigma + 1e-6);
          REQUIRE(size - shear >= sigma - 1e-6);
        }
      }
      const SampledMap found = deformer->deform(pose, {});
      CHECK(found.status == SampledMap::Status::certified);
      REQUIRE(found.extremes);
      // Proved values are up to 1 % and 1e-4 beyond those that are attained.
      CHECK(found.extremes->shear <= 1.01 * k + 1e-4);
      CHECK(found.extremes->largest <= 1.01 * Sigma + 1e-4);
      CHECK(found.extremes->smallest >= sigma / 1.01 - 1e-4);
    }
  }
}

TEST_CASE("Puppet: wide limits change little, and narrow ones are reached before pins are missed") {
  for (const unsigned seed : seeds_of("puppet limits", {1, 2, 3})) {
    std::mt19937 random(seed);
    Puppet puppet = random_puppet(random);
    INFO("seed " << seed);
    const Pose gentle = random_pose(puppet, 0.03, random), far = random_pose(puppet, 0.5, random);
    const auto found = [&](const std::map<std::string, double>& parameters, const Pose& pose) {
      puppet.rest.parameters = parameters;
      return puppet_method_row().prepare(puppet.rest, nullptr)->deform(pose, {});
    };
    const VectorXc free = found({}, gentle).f,
                   wide =
                       found({{"limited", 1}, {"k", 0.99}, {"sigma", 0.01}, {"Sigma", 100}}, gentle)
                           .f;
    CHECK((free - wide).cwiseAbs().maxCoeff() <= 1e-4 * puppet.size);
    const SampledMap narrow =
        found({{"limited", 1}, {"k", 0.3}, {"sigma", 0.7}, {"Sigma", 1.4}}, far);
    REQUIRE(narrow.extremes);
    const bool reached = narrow.extremes->shear > 0.28 || narrow.extremes->largest > 1.3 ||
                         narrow.extremes->smallest < 0.74;
    CHECK(reached);
  }
}

}  // namespace holomorph::puppet_limits_test
