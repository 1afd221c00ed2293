// The images of curves are within the tolerance of the map, smooth, and exact for affine maps.
#include "core/maps/curve_images.h"

#include "core/geometry/affine.h"
#include "core/geometry/curve.h"
#include "support/catch.h"
#include "support/seeds.h"

namespace holomorph::curve_images_test {

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

constexpr double kTolerance = 0.05;

/// Continuous, and affine in each of the four quadrants around a point.
struct FoldedMap {
  double x, y;
  Complex right, above;  ///< what is added to the derivatives there

  Complex at(Complex z) const {
    return z + right * std::max(z.real() - x, 0.0) + above * std::max(z.imag() - y, 0.0);
  }
  PointMap::Value value(Complex z) const {
    const Complex in_x = z.real() > x ? 0.5 * right : 0, in_y = z.imag() > y ? 0.5 * above : 0;
    return {at(z), 1.0 + in_x - kI * in_y, in_x + kI * in_y};
  }
};

/// How far a point is from a curve's true image.
double distance(Complex point, const Points& curve, const FoldedMap& map) {
  const auto off = [&](double t) { return std::abs(map.at(bezier_point(curve, t)) - point); };
  constexpr int kSteps = 500;
  std::vector<double> rough;
  for (int k = 0; k <= kSteps; ++k) rough.push_back(off(static_cast<double>(k) / kSteps));
  double nearest = *std::ranges::min_element(rough);
  for (size_t k = 0; k < rough.size(); ++k) {
    const bool is_least =
        (k == 0 || rough[k] <= rough[k - 1]) && (k + 1 == rough.size() || rough[k] <= rough[k + 1]);
    if (!is_least || rough[k] > nearest + 10) continue;  // farther than the next point of the image
    double around = static_cast<double>(k) / kSteps;
    for (double step = 0.1 / kSteps; step > 1e-7; step /= 10) {
      double best = around;
      for (int j = -12; j <= 12; ++j)
        if (const double t = std::clamp(around + j * step, 0.0, 1.0); off(t) < off(best)) best = t;
      around = best;
    }
    nearest = std::min(nearest, off(around));
  }
  return nearest;
}

/// How far points of the images are from the true ones.
double farthest_off(const std::vector<Points>& curves, const FoldedMap& map) {
  const auto images = curve_images(
      curves,
      [&](std::span<const Complex> points) {
        std::vector<PointMap::Value> values;
        for (const Complex& z : points) values.push_back(map.value(z));
        return values;
      },
      kTolerance);
  double farthest = 0;
  for (size_t i = 0; i < curves.size(); ++i)
    for (const Points& piece : images[i])
      for (const double along : {0.03, 0.11, 0.19, 0.28, 0.45, 0.52, 0.69, 0.83, 0.94})
        farthest = std::max(farthest, distance(bezier_point(piece, along), curves[i], map));
  return farthest;
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
    std::vector<Points> curves = random_curves(random, 40);
    for (Points& curve : curves) curve = {curve.front(), curve.back()};
    std::uniform_real_distribution<double> place(50, 450), bend(-0.5, 0.5);
    const FoldedMap map{place(random), 1e9, {bend(random), bend(random)}, {}};
    CHECK(farthest_off(curves, map) < kTolerance + 1e-3);
  }
}

TEST_CASE("Images with several kinks are close") {
  for (const unsigned seed : seeds_of("images with kinks", {1, 2, 1011188185})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    // Curves may pass a corner or touch an edge between two samples, which lie at most 5 apart.
    const std::vector<Points> curves = random_curves(random, 40);
    std::uniform_real_distribution<double> place(50, 450), bend(-0.5, 0.5);
    const FoldedMap map{
        place(random), place(random), {bend(random), bend(random)}, {bend(random), bend(random)}};
    constexpr double kMissedKinks = 1.2;  // 600 random maps stayed below 1.02
    CHECK(farthest_off(curves, map) < kMissedKinks * kTolerance);
  }
}

TEST_CASE("Images that no cubics come close to have bounded cost") {
  size_t asked = 0;
  const PointValues map = [&](std::span<const Complex> points) {
    asked += points.size();
    std::vector<PointMap::Value> values;
    for (const Complex& z : points) {
      const Complex turn = std::polar(1.0, z.real());  // a spiral
      values.push_back({z * turn, turn * (1.0 + 0.5 * kI * z), turn * 0.5 * kI * z});
    }
    return values;
  };
  const std::vector<Points> curves{{0, 1e8}, {{0, 3}, {0, 9}}};
  const auto images = curve_images(curves, map, kTolerance);
  CHECK(asked < (size_t{1} << 20) + 200);
  CHECK(images[0].back().back() == map(Points{1e8})[0].f);
  CHECK(images[1].size() == 1);
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

}  // namespace holomorph::curve_images_test
