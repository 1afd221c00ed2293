// Springs that give way: their force has a limit, and their derivatives are those of the energy.
#include "core/sheet/spring.h"

#include <random>

#include "support/catch.h"
#include "support/seeds.h"

namespace holomorph::spring_test {

TEST_CASE("Springs: forces are linear near the target and limited far away") {
  const Spring spring{20, 1 / 3.0, 0.001};
  const auto force = [&](double r) { return 2 * r * spring.slope(r * r); };
  CHECK(force(1e-4) == Approx(2 * 20 * 1e-4).epsilon(1e-3));
  CHECK(force(50) == Approx(3 + 2 * 0.001 * 50).epsilon(1e-4));
  for (double r = 0.01; r < 100; r *= 1.5) CHECK(force(1.5 * r) > force(r));
  const Spring firm = spring.firm();
  for (const double r : {0.1, 10.0}) {
    CHECK(firm.value(r * r) == Approx(20 * r * r));
    CHECK(firm.slope(r * r) == 20);
    CHECK(firm.curvature(r * r) == 0);
    CHECK((0.3 * spring).value(r * r) == Approx(0.3 * spring.value(r * r)));
    CHECK((0.3 * spring).slope(r * r) == Approx(0.3 * spring.slope(r * r)));
  }
}

TEST_CASE("Springs: derivatives agree with differences") {
  for (const unsigned seed : seeds_of("springs", {1, 2, 3})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<> uniform(0.1, 3);
    for (int i = 0; i < 20; ++i) {
      const double weight = uniform(random), most = uniform(random), far = 0.1 * uniform(random);
      const Spring spring{weight, 1 / most, far};
      const double at = uniform(random) * uniform(random), h = 1e-5;
      const auto difference = [&](auto value) { return (value(at + h) - value(at - h)) / (2 * h); };
      CHECK(spring.slope(at) ==
            Approx(difference([&](double q) { return spring.value(q); })).epsilon(1e-6));
      CHECK(spring.curvature(at) ==
            Approx(difference([&](double q) { return spring.slope(q); })).epsilon(1e-5));
    }
  }
}

}  // namespace holomorph::spring_test
