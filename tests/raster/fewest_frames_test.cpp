// Chosen frames give the motion between all of them.
#include "raster/fewest_frames.h"

#include "support/catch.h"
#include "support/seeds.h"

namespace holomorph::fewest_frames_test {
namespace {

/// The largest distance between a motion and its frames at many times, except in jumps.
double distance_of(const Frames& frames, const std::function<std::vector<Points>(double)>& exact) {
  double farthest = 0;
  for (size_t i = 0; i + 1 < frames.times.size(); ++i) {
    if (is_jump(frames.times[i], frames.times[i + 1])) continue;
    for (const double u : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const auto at = exact((1 - u) * frames.times[i] + u * frames.times[i + 1]);
      for (size_t k = 0; k < at.size(); ++k)
        for (size_t v = 0; v < at[k].size(); ++v)
          farthest = std::max(farthest, std::abs((1 - u) * frames.positions[i][k][v] +
                                                 u * frames.positions[i + 1][k][v] - at[k][v]));
    }
  }
  return farthest;
}

std::vector<double> frames_of(double seconds, double rate) {
  std::vector<double> times;
  for (int k = 0; k <= seconds * rate; ++k) times.push_back(k / rate);
  return times;
}

TEST_CASE("The fewest frames are close to the motion at all times") {
  for (const unsigned seed : seeds_of("fewest frames", {1, 2, 3, 4})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    std::vector<std::pair<Complex, double>> waves;  // amplitude and frequency
    for (int k = 0; k < 6; ++k)
      waves.emplace_back(100.0 * random_complex(random), 10 * random_complex(random).real());
    const auto exact = [&](double time) {
      std::vector<Points> all(2);
      for (size_t k = 0; k < waves.size(); ++k)
        all[k % 2].push_back(waves[k].first * std::polar(1.0, waves[k].second * time));
      return all;
    };
    for (const double tolerance : {0.05, 0.5, 5.0}) {
      const Frames frames = fewest_frames(frames_of(3, 24), tolerance, exact);
      CHECK(frames.times.front() == 0);
      CHECK(frames.times.back() == 3);
      CHECK(std::ranges::is_sorted(frames.times));
      CHECK(distance_of(frames, exact) <= 1.2 * tolerance);
      for (size_t i = 0; i < frames.times.size(); ++i)
        CHECK(frames.positions[i] == exact(frames.times[i]));
    }
  }
}

TEST_CASE("The fewest frames of straight motion are its ends and corners") {
  const auto zigzag = [](double time) {
    return std::vector<Points>{{Complex(100 * std::abs(time - 1), 0), Complex(0, 7)}};
  };
  CHECK(fewest_frames(frames_of(2, 24), 0.1, zigzag).times == std::vector<double>{0, 1, 2});
  CHECK(fewest_frames({0.5}, 0.1, zigzag).times == std::vector<double>{0.5});
  // A jump has a frame on each side, and nothing is added inside of it.
  const auto jump = [](double time) {
    return std::vector<Points>{{Complex(time < 1 ? 0 : 50, 0)}};
  };
  CHECK(fewest_frames({0, 0.5, 0.9995, 1, 2}, 0.1, jump).times ==
        std::vector<double>{0, 0.9995, 1, 2});
}

}  // namespace
}  // namespace holomorph::fewest_frames_test
