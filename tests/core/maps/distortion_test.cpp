// Distortion of maps that are known in closed form.
#include "core/maps/distortion.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <random>

#include "core/maps/argument.h"
#include "core/maps/injectivity.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::distortion_test {

namespace {

/// Relative error of a dozen operations, each rounded to 2^-53, with two differences that lose at
/// most a factor of four.
constexpr double kRounding = 1e-14;
/// Error of a turning number: turns at fewer than a thousand vertices, summed below 32 and rounded
/// to 2^-49, over 2 pi.
constexpr double kTurnRounding = 1e-12;

template <class F, class Fz, class Fzbar>
SampledMap sampled(const Points& points, F f, Fz fz, Fzbar fzbar) {
  const Index n = static_cast<Index>(points.size());
  SampledMap map;
  map.f = map.fz = map.fzbar = VectorXc(n);
  for (Index i = 0; i < n; ++i)
    map.f[i] = f(points[i]), map.fz[i] = fz(points[i]), map.fzbar[i] = fzbar(points[i]);
  return map;
}

}  // namespace

TEST_CASE("Distortion: an affine map's measures follow from its singular values") {
  const Complex a{1.5, 0.5}, b{0.3, -0.2};
  const auto map = sampled(
      {{0, 0}, {3, 4}}, [&](Complex z) { return a * z + b * std::conj(z); },
      [&](Complex) { return a; }, [&](Complex) { return b; });
  Eigen::Matrix2d jacobian;
  jacobian << (a + b).real(), -(a - b).imag(), (a + b).imag(), (a - b).real();
  const Eigen::Vector2d sigma = jacobian.jacobiSvd().singularValues();
  const Distortion d = distortion_of(map);
  CHECK(std::exp2(d.area[0]) == Approx(jacobian.determinant()).epsilon(kRounding));
  CHECK(d.k[1] == Approx(std::abs(b) / std::abs(a)).epsilon(kRounding));
  CHECK(d.stretch[0] == Approx(std::max(std::abs(a) + std::abs(b), 1 / (std::abs(a) - std::abs(b))))
                            .epsilon(kRounding));
  CHECK(d.stretch[1] == Approx(std::max(sigma[0], 1 / sigma[1])).epsilon(kRounding));
  CHECK(d.k[0] == Approx((sigma[0] - sigma[1]) / (sigma[0] + sigma[1])).epsilon(kRounding));
}

TEST_CASE(
    "Map report: zeros of the derivative, the turning number and flipped triangles are found") {
  const Mesh mesh = domain_mesh(shapes::star(40, 0.05, 6), {2000});
  const Complex zero{215, 190};
  const auto square = sampled(
      mesh.vertices, [&](Complex z) { return (z - zero) * (z - zero) / 100.0; },
      [&](Complex z) { return (z - zero) / 50.0; }, [](Complex) { return Complex(0); });
  const MapReport report = report_of(mesh, square);
  REQUIRE(report.zeros.size() == 1);
  CHECK(std::abs(report.zeros[0] - zero) < 10);
  CHECK_THAT(report.turning_number, Catch::WithinAbs(2, kTurnRounding));
  CHECK_FALSE(report.simple_boundary);
  CHECK_FALSE(report.locally_injective());

  const auto mirror = sampled(
      mesh.vertices, [](Complex z) { return std::conj(z); }, [](Complex) { return Complex(0); },
      [](Complex) { return Complex(1); });
  CHECK(report_of(mesh, mirror).flipped_triangles == static_cast<int>(mesh.triangles.size()));

  const auto identity = sampled(
      mesh.vertices, [](Complex z) { return z; }, [](Complex) { return Complex(1); },
      [](Complex) { return Complex(0); });
  CHECK(report_of(mesh, identity).locally_injective());
  CHECK(report_of(mesh, identity).simple_boundary);
}

TEST_CASE("Injectivity: the least stretch of an affine map is |a| - |b|, with its sign") {
  const Mesh mesh = domain_mesh(shapes::rectangle(40, 30), {300});
  for (const auto& [a, b] : {std::pair<Complex, Complex>({1.5, 0.5}, {0.3, -0.2}),
                             {{0.2, 0.1}, {0.9, 0.3}},
                             {{1, 0}, {0, 0}}}) {
    VectorXc f(static_cast<Index>(mesh.vertices.size()));
    for (Index i = 0; i < f.size(); ++i) {
      const Complex z = mesh.vertices[static_cast<size_t>(i)];
      f[i] = a * z + b * std::conj(z) + Complex(3, -2);
    }
    const Injectivity found = injectivity_of(mesh, f);
    // Positions below 128 are rounded to 2^-47 = 7e-15, and the triangles are at least 0.1 high.
    CHECK_THAT(found.least_stretch, Catch::WithinAbs(std::abs(a) - std::abs(b), 1e-12));
    CHECK(found.folds() == (std::abs(a) < std::abs(b)));
    CHECK_THAT(found.turning_number, Catch::WithinAbs(found.folds() ? -1 : 1, kTurnRounding));
  }
  // z^3 + 3 r z compresses the picture almost to a point near its branch points.
  VectorXc f(static_cast<Index>(mesh.vertices.size()));
  for (Index i = 0; i < f.size(); ++i) {
    const Complex z = mesh.vertices[static_cast<size_t>(i)] - Complex(20, 15);
    f[i] = z * z * z + 3 * 36.0 * z;
  }
  const Injectivity found = injectivity_of(mesh, f);
  CHECK_THAT(found.turning_number, Catch::WithinAbs(3, kTurnRounding));
  CHECK(std::abs(found.least_stretch) < 0.1 * 3 * 36);
  REQUIRE_FALSE(found.folds_at.empty());
  CHECK(std::min(std::abs(found.folds_at[0] - Complex(0, 2 * 216)),
                 std::abs(found.folds_at[0] + Complex(0, 2 * 216))) < 120);
}

TEST_CASE("Zeros of a function that is known everywhere are those that it has") {
  const Cage cage = polygon_cage(Points{{0, 0}, {100, 0}, {100, 60}, {0, 60}});
  const Mesh mesh = domain_mesh(cage, {200});
  for (const unsigned seed : seeds_of("zeros of functions", {1, 2, 3, 4})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    // Two zeros inside, one close to the boundary, and one just outside of it. Factors that turn
    // fast make triangles look as if they had zeros.
    const Complex near_side(30 + 30 * random_complex(random).real(), 0.05);
    const Points zeros{Complex(50, 30) + 20.0 * random_complex(random),
                       Complex(50, 30) + 20.0 * random_complex(random), near_side,
                       Complex(near_side.real() + 30, -0.05)};
    const auto at = [&](const Points& points) {
      VectorXc values(static_cast<Index>(points.size()));
      for (Index i = 0; i < values.size(); ++i) {
        const Complex z = points[static_cast<size_t>(i)];
        values[i] = std::exp(0.4 * kI * z);
        for (const Complex& zero : zeros) values[i] *= z - zero;
      }
      return values;
    };
    const std::vector<Zero> found = zeros_of(mesh, mesh.vertices, at(mesh.vertices), at);
    int count = 0;
    for (const Zero& zero : found) count += zero.multiplicity;
    REQUIRE(count == 3);
    for (size_t k = 0; k < 3; ++k) {
      double nearest = INFINITY;
      for (const Zero& zero : found)
        nearest = std::min(nearest, std::abs(zero.position - zeros[k]));
      CHECK(nearest < 15);
    }
  }
}

TEST_CASE("Injectivity: visible loops are folds, loops too small to be seen are not") {
  const Mesh mesh = domain_mesh(shapes::rectangle(400, 300), {3000});
  for (const double reach : {2.0, 120.0}) {
    // A corner is flipped.
    VectorXc f(static_cast<Index>(mesh.vertices.size()));
    for (Index i = 0; i < f.size(); ++i) {
      const Complex z = mesh.vertices[static_cast<size_t>(i)];
      const double depth = reach - z.real() - z.imag();  // beyond the line x + y = reach
      f[i] = depth > 0 ? z + 1.2 * depth * Complex(1, 1) : z;
    }
    const Injectivity found = injectivity_of(mesh, f);
    INFO("reach " << reach);
    CHECK(found.folds() == (reach > 10));
    CHECK((found.least_stretch < 0) == (reach > 10));
  }
}

}  // namespace holomorph::distortion_test
