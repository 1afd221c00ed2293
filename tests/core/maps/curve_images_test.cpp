// The images of curves are within the tolerance of the map, smooth, and exact for affine maps.
#include "core/maps/curve_images.h"

#include <catch2/catch.hpp>

#include "core/geometry/affine.h"
#include "core/geometry/curve.h"
#include "support/seeds.h"

using namespace holomorph;

namespace {

std::vector<Points> random_curves(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> place(0, 500);
  std::vector<Points> curves;
  for (int i = 0; i < count; ++i) {
    Points& curve = curves.emplace_back();
    const size_t points = 2 + random() % 3;
    for (size_t k = 0; k < points; ++k) curve.push_back({place(random), place(random)});
  }
  return curves;
}

}  // namespace

TEST_CASE("An affine map takes each curve to a single cubic, exactly") {
  for (const unsigned seed : seeds_of("affine images of curves", {1, 2, 3})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const std::vector<Points> curves = random_curves(random, 50);
    const Affine map{Complex(0.8, 0.4), Complex(-0.2, 0.3), Complex(30, -12)};
    CHECK(std::abs(composed(inverse(map), map)(Complex(3, 4)) - Complex(3, 4)) < 1e-12);
    const auto [a, b, c, d, e, f] = matrix_of(map);
    CHECK(std::abs(affine_of_matrix(a, b, c, d, e, f)(Complex(3, 4)) - map(Complex(3, 4))) < 1e-12);
    const auto images = curve_images(
        curves,
        [&](std::span<const Complex> points) {
          std::vector<PointMap::Value> values;
          for (const Complex& z : points) values.push_back({map(z), map.linear, map.anti});
          return values;
        },
        1e-9);
    for (size_t i = 0; i < curves.size(); ++i) {
      REQUIRE(images[i].size() == 1);
      for (const double t : {0.0, 0.1, 0.4, 0.9, 1.0})
        CHECK(std::abs(bezier_point(images[i][0], t) - map(bezier_point(curves[i], t))) < 1e-9);
    }
  }
}

TEST_CASE("Images with one kink are as close as asked for") {
  for (const unsigned seed : seeds_of("images with a kink", {1, 2, 3})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    // Lines cross the kink once. Curves may also touch it between samples, which is not promised.
    std::vector<Points> curves = random_curves(random, 40);
    for (Points& curve : curves) curve = {curve.front(), curve.back()};
    std::uniform_real_distribution<double> place(50, 450), bend(-0.5, 0.5);
    const double x = place(random);
    const Complex bent(bend(random), bend(random));
    // Continuous, and affine on both sides of a line.
    const auto f = [&](Complex z) { return z + bent * std::max(z.real() - x, 0.0); };
    const PointValues map = [&](std::span<const Complex> points) {
      std::vector<PointMap::Value> values;
      for (const Complex& z : points) {
        const Complex half = z.real() > x ? 0.5 * bent : 0;
        values.push_back({f(z), 1.0 + half, half});
      }
      return values;
    };
    constexpr double kTolerance = 0.05;
    const auto images = curve_images(curves, map, kTolerance);
    double farthest = 0;
    for (size_t i = 0; i < curves.size(); ++i)
      for (const Points& piece : images[i])
        for (const double along : {0.03, 0.11, 0.19, 0.28, 0.45, 0.52, 0.69, 0.83, 0.94}) {
          const Complex ours = bezier_point(piece, along);
          // The nearest of evenly spaced points of the true image, then of denser ones around it.
          double nearest = 1e9, nearest_t = 0.5;
          for (const double reach : {0.5, 4e-3, 4e-5}) {
            const double around = nearest_t;
            for (int k = -250; k <= 250; ++k) {
              const double t = std::clamp(around + reach * k / 250, 0.0, 1.0);
              const double off = std::abs(f(bezier_point(curves[i], t)) - ours);
              if (off < nearest) std::tie(nearest, nearest_t) = std::pair(off, t);
            }
          }
          farthest = std::max(farthest, nearest);
        }
    CHECK(farthest < kTolerance + 1e-3);
  }
}

TEST_CASE("Images of curves are as close as asked for, and smooth") {
  for (const unsigned seed : seeds_of("images of curves", {1, 2, 3})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const std::vector<Points> curves = random_curves(random, 50);
    const double s = std::uniform_real_distribution<double>(0.001, 0.004)(random);
    const auto f = [&](Complex z) { return z + 0.1 / s * std::sin(s * z) + 0.05 * std::conj(z); };
    size_t calls = 0;
    const PointValues map = [&](std::span<const Complex> points) {
      ++calls;
      std::vector<PointMap::Value> values;
      for (const Complex& z : points) values.push_back({f(z), 1.0 + 0.1 * std::cos(s * z), 0.05});
      return values;
    };
    constexpr double kTolerance = 0.05;
    const auto images = curve_images(curves, map, kTolerance);
    CHECK(calls < 12);
    for (size_t i = 0; i < curves.size(); ++i) {
      const auto& pieces = images[i];
      CHECK(std::abs(pieces.front()[0] - f(curves[i].front())) < 1e-9);
      CHECK(std::abs(pieces.back()[3] - f(curves[i].back())) < 1e-9);
      for (size_t k = 0; k + 1 < pieces.size(); ++k) {
        CHECK(pieces[k][3] == pieces[k + 1][0]);
        const Complex in = pieces[k][3] - pieces[k][2], out = pieces[k + 1][1] - pieces[k + 1][0];
        CHECK(std::abs(cross(in, out)) <= 1e-9 * std::abs(in) * std::abs(out));
      }
      // Every point of the true image is near the cubics.
      for (int n = 0; n <= 50; ++n) {
        const Complex wanted = f(bezier_point(curves[i], n / 50.0));
        double nearest = 1e9;
        for (const Points& piece : pieces)
          for (int k = 0; k <= 400; ++k)
            nearest = std::min(nearest, std::abs(bezier_point(piece, k / 400.0) - wanted));
        const double spacing = 2500.0 / 400 / static_cast<double>(pieces.size());
        CHECK(nearest < kTolerance + spacing);
      }
    }
  }
}
