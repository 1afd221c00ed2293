// Times as ffmpeg, MLT and other hosts pass them.
#include "frei0r/host_time.h"

#include <limits>

#include "support/catch.h"
#include "support/seeds.h"

namespace holomorph::host_time_test {

namespace {

/// Rates of real films.
constexpr double kFilmRates[] = {12, 24000.0 / 1001, 24, 25, 30000.0 / 1001, 30, 50, 60};
/// What ffmpeg passes for a frame without a time.
const double kNoTime = 1000 * -9223372036854775808.0 / 12800;

}  // namespace

TEST_CASE("Frames in milliseconds, exact or rounded, are at whole frames") {
  for (const double rate : kFilmRates)
    for (const bool certain : {false, true})
      for (const bool rounded : {false, true}) {
        HostTime time(rate, certain);
        for (int frame = 0; frame < 3000; ++frame) {
          const double passed = 1000 * frame / rate;
          REQUIRE(time.seconds(rounded ? std::round(passed) : passed) == frame / rate);
        }
      }
}

TEST_CASE("A film in milliseconds may start anywhere") {
  for (const unsigned seed : seeds_of("start in milliseconds", {1})) {
    std::mt19937 random(seed);
    for (const double rate : kFilmRates) {
      HostTime time(rate, true);
      for (int frame = static_cast<int>(1 + random() % 5000), i = 0; i < 50; ++i, ++frame)
        REQUIRE(time.seconds(1000 * frame / rate) == frame / rate);
    }
  }
}

TEST_CASE("A host that passes seconds may seek anywhere") {
  for (const unsigned seed : seeds_of("seek", {1, 2})) {
    std::mt19937 random(seed);
    for (const double rate : kFilmRates)
      for (const bool known : {false, true}) {
        HostTime time(rate, true, known);
        if (!known) time.seconds(0), time.seconds(1 / rate);  // shows that these are seconds
        for (int i = 0; i < 200; ++i) {
          const int frame = static_cast<int>(random() % 100000);
          REQUIRE(time.seconds(frame / rate) == frame / rate);
        }
      }
  }
}

TEST_CASE("A host that is known to pass seconds needs no rate, and may start and step anywhere") {
  for (const unsigned seed : seeds_of("known seconds", {1})) {
    std::mt19937 random(seed);
    HostTime time(24, true, true);
    for (int i = 0; i < 200; ++i) {
      const double wanted = static_cast<double>(random() % 100000) / 30;
      REQUIRE(time.seconds(wanted) == Approx(wanted).margin(0.0006));
    }
  }
}

TEST_CASE("A short first frame or a few irregular ones do not change the unit") {
  HostTime time(25, false);
  time.seconds(0.3);
  REQUIRE(time.seconds(40) == 0.04);
  REQUIRE(time.seconds(80) == 0.08);
  REQUIRE(time.seconds(80.5) == Approx(0.0805).margin(0.0006));
  REQUIRE(time.seconds(4000) == 4);
  HostTime rare(1, false);  // a frame per second, in seconds
  rare.seconds(0), rare.seconds(0.5);
  for (int i = 1; i < 100; ++i) REQUIRE(rare.seconds(i) == i);
}

TEST_CASE("Frames without a time are counted") {
  for (const double rate : kFilmRates) {
    HostTime none(rate, false);
    for (int frame = 0; frame < 100; ++frame) REQUIRE(none.seconds(kNoTime) == frame / rate);
    HostTime some(rate, true);
    for (int frame = 0; frame < 100; ++frame)
      REQUIRE(some.seconds(frame % 3 == 0 ? 1000 * frame / rate : kNoTime) == frame / rate);
    for (const double bad : {-1.0, 1e300, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()})
      REQUIRE(HostTime(rate, false).seconds(bad) == 0);
  }
}

TEST_CASE("Times between frames count only if the rate is certain") {
  HostTime certain(25, true), uncertain(24, false);
  for (int frame = 0; frame < 100; ++frame) {
    // A film of 25 frames per second: the scene's 24 are not the film's.
    REQUIRE(uncertain.seconds(40 * frame) == Approx(frame / 25.0));
    REQUIRE(certain.seconds(40 * frame + 17) == frame / 25.0);
  }
}

}  // namespace holomorph::host_time_test
