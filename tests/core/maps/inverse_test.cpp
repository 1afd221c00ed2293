// Preimages: round trips, boundaries, overlaps.
#include "core/maps/inverse.h"

#include "core/cauchy/cauchy.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::inverse_test {
using shapes::curved_star;

namespace {

/// A map from a rest to a pose, with everything that its inverse needs.
struct Warp {
  Cage rest, pose;
  Mesh mesh;
  std::unique_ptr<Deformer> deformer;
  std::unique_ptr<PointMap> map;
  SampledMap sampled;
  std::unique_ptr<InverseMap> inverse;

  Warp(Cage from, Cage to, int vertices = 500) : rest(std::move(from)), pose(std::move(to)) {
    mesh = domain_mesh(rest, {vertices});
    Rest all;
    all.cage = elevated_to(rest, pose);
    all.samples = mesh.vertices;
    all.precision = Precision::full;
    deformer = method_named("cage").prepare(all, nullptr);
    sampled = deformer->deform({pose, {}}, {});
    map = deformer->point_map({pose, {}});
    inverse = std::make_unique<InverseMap>(
        rest, mesh, std::span<const Complex>(sampled.f.data(), mesh.vertices.size()), *map);
  }
};

Points inner_points(const Cage& cage, int count, unsigned seed, double near_boundary) {
  const Polygon outline = outline_of(cage, 64);
  const Box box = box_of(outline);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(box.left, box.right), y(box.bottom, box.top), unit(0, 1);
  Points points;
  while (static_cast<int>(points.size()) < count) {
    Complex z(x(random), y(random));
    if (unit(random) < near_boundary) {
      const NearestPoint near = nearest_on_polygon(outline, z);
      z = near.point + std::pow(10.0, -1 - 5 * unit(random)) * (z - near.point);
    }
    if (contains(cage, z)) points.push_back(z);
  }
  return points;
}

}  // namespace

TEST_CASE("Inverse: every point of a random map is recovered, also next to the boundary") {
  int points = 0, failed = 0;
  double worst = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const int degree = 1 + static_cast<int>(seed % 8), n = 5 + static_cast<int>(seed % 9);
    const Cage rest = seed % 2 ? polygon_cage(shapes::star(n, 0.15, seed))
                               : curved_star(n, 2 + static_cast<int>(seed % 3), 0.2, seed);
    const Warp warp(rest, curved_star(n, degree, 0.2, seed));
    for (const Complex z : inner_points(rest, 150, seed, 0.25)) {
      const Complex w = warp.map->at(z).f;
      const auto found = warp.inverse->at(w);
      double best = 1e300;
      for (const Preimage& p : found) best = std::min(best, std::abs(p.z - z));
      ++points;
      // Where the map has a small derivative, its inverse has a large one.
      const double steep = 1 / std::max(std::abs(warp.map->at(z).fz), 1e-3);
      if (best > 1e-9 * steep)
        ++failed;
      else
        worst = std::max(worst, best / steep);
    }
  }
  INFO(failed << " of " << points << " failed, worst " << worst);
  CHECK(failed == 0);
  CHECK(worst <= 1e-12);
}

TEST_CASE("Inverse: curved to curved and back is the identity to 1e-9") {
  const Warp warp(curved_star(8, 3, 0.25, 3), curved_star(8, 3, 0.25, 3));
  Cage pose = warp.rest;
  for (Points& segment : pose.segments)
    for (Complex& z : segment) z = z + 14.0 * std::sin(z.imag() / 50) + kI * (z.real() * 0.1);
  const Warp bent(warp.rest, pose);
  for (const Complex z : inner_points(bent.rest, 400, 9, 0.2)) {
    const auto found = bent.inverse->at(bent.map->at(z).f);
    REQUIRE_FALSE(found.empty());
    CHECK(std::abs(found[0].z - z) <= 1e-9);
    CHECK(found[0].residual <= 1e-11);
  }
}

TEST_CASE("Inverse: no preimage outside, and all preimages where the picture overlaps itself") {
  // A long bar bent by 400 degrees overlaps itself.
  Points bar, bent;
  for (int i = 0; i <= 40; ++i) bar.push_back({20.0 * i, 0});
  for (int i = 40; i >= 0; --i) bar.push_back({20.0 * i, 40});
  for (const Complex& z : bar)
    bent.push_back(std::polar(150 + z.imag(), z.real() / 800 * 400 / 180 * kPi));
  std::reverse(bent.begin(), bent.end());  // orientation: radius grows outward
  std::reverse(bar.begin(), bar.end());
  for (Complex& z : bent) z = std::conj(z);
  const Warp warp(polygon_cage(bar), polygon_cage(bent), 3000);
  int once = 0, twice = 0;
  for (int i = 0; i < 40; ++i) {
    const Complex w = std::conj(std::polar(168.0, i / 40.0 * 2 * kPi));
    const auto found = warp.inverse->at(w);
    CHECK(static_cast<int>(found.size()) == std::abs(*warp.inverse->winding(w)));
    once += found.size() == 1;
    twice += found.size() == 2;
    for (const Preimage& p : found) CHECK(std::abs(warp.map->at(p.z).f - w) <= 1e-10);
  }
  CHECK(once > 20);
  CHECK(twice >= 2);
  CHECK(warp.inverse->at({0, 0}).empty());
  CHECK(warp.inverse->at({1e6, 0}).empty());
  CHECK(warp.inverse->at({1e300, -1e300}).empty());
  CHECK(warp.inverse->at({NAN, 0}).empty());
}

TEST_CASE("Inverse: points of the boundary are recovered, also on concave outlines") {
  for (const bool clockwise : {false, true}) {
    Cage rest = polygon_cage(shapes::l_shape()), pose = rest;
    pose.segments[2][0] += Complex(20, 10);
    pose.segments[5][0] += Complex(-8, 12);
    if (clockwise) rest = reversed(rest), pose = reversed(pose);
    const Warp warp(rest, pose);
    for (Index e = 0; e < rest.size(); ++e)
      for (const double t : {0.1, 0.37, 0.5, 0.81}) {
        const Complex z = position_of(rest, {e, t});
        const auto found = warp.inverse->at(warp.map->at(z).f);
        REQUIRE_FALSE(found.empty());
        CHECK(std::abs(found[0].z - z) <= 1e-9);
      }
  }
}

TEST_CASE("Inverse: far from the origin, no preimage is lost to rounding") {
  Cage rest = polygon_cage(shapes::l_shape()), pose = rest;
  for (Cage* cage : {&rest, &pose})
    for (Points& segment : cage->segments)
      for (Complex& z : segment) z += Complex(3e7, -2e7);
  pose.segments[2][0] += Complex(20, 10);
  const Warp warp(rest, pose, 300);
  for (const Complex& z : vertices_of(rest)) CHECK(is_finite(warp.map->at(z).f));
  CHECK(warp.inverse->at(Complex(3e7, -2e7) + Complex(50, 50)).size() == 1);
  CHECK(warp.inverse->at({0, 0}).empty());
}

TEST_CASE("Inverse: the inverse of the identity is the identity") {
  const Warp warp(curved_star(6, 3, 0.3, 5), curved_star(6, 3, 0.3, 5));
  for (const Complex z : inner_points(warp.rest, 100, 1, 0.5)) {
    const auto found = warp.inverse->at(z);
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].z - z) <= 1e-12);
  }
}

namespace {

/// The winding number around w of the boundary's image, from very many points; empty when w is too
/// close to it.
std::optional<int> wound(const Warp& warp, Complex w) {
  double turn = 0;
  constexpr int kSteps = 20000;
  for (Index e = 0; e < warp.rest.size(); ++e) {
    Complex last = warp.map->at(warp.rest.vertex(e)).f;
    for (int k = 1; k <= kSteps; ++k) {
      // Denser toward the vertices, where the derivative is unbounded.
      const double x = static_cast<double>(k) / kSteps, t = x * x * x * (10 - 15 * x + 6 * x * x);
      const Complex next =
          warp.map->at(k == kSteps ? warp.rest.end_vertex(e) : position_of(warp.rest, {e, t})).f;
      if (std::abs(next - last) > 0.5 * std::abs(next - w)) return {};
      turn += std::arg((next - w) / (last - w));
      last = next;
    }
  }
  return static_cast<int>(std::lround(turn / (2 * kPi)));
}

}  // namespace

TEST_CASE("Inverse: a sheet that lies within a triangle at the boundary is found") {
  // The bottom edge runs backward.
  const Warp warp(polygon_cage(Points{{0, 0}, {100, 0}, {100, 100}, {0, 100}}),
                  polygon_cage(Points{{0, 0}, {150, 60}, {-50, 60}, {0, 100}}), 8000);
  const Complex z(48, 0.01);
  const auto found = warp.inverse->at(warp.map->at(z).f);
  double nearest = 1e300;
  for (const Preimage& p : found) nearest = std::min(nearest, std::abs(p.z - z));
  CHECK(nearest <= 1e-9);
}

TEST_CASE("Inverse: the number of preimages is the winding number of the boundary's image") {
  for (const unsigned seed : seeds_of("preimages", {31, 32, 33})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 3; ++round) {
      const int n = 3 + static_cast<int>(random() % 5);
      const Cage rest = round == 1 ? curved_star(n, 3, 0.2, random())
                                   : polygon_cage(shapes::star(n, 0.3, random()));
      Cage pose = rest;
      for (Points& segment : pose.segments)
        for (Complex& z : segment) z += 120.0 * Complex(unit(random) - 0.5, unit(random) - 0.5);
      const Warp warp(rest, pose, 800);
      int queries = 0, wrong = 0;
      for (const Complex z : inner_points(rest, 40, random(), 0.6)) {
        const Complex w = warp.map->at(z).f;
        const auto wanted = warp.inverse->winding(w);
        if (!wanted) continue;
        const auto found = warp.inverse->at(w);
        ++queries;
        wrong += static_cast<int>(found.size()) != *wanted;
        for (const Preimage& p : found) CHECK(std::abs(warp.map->at(p.z).f - w) <= 1e-8);
      }
      INFO("seed " << seed << ", round " << round << ": " << wrong << " of " << queries);
      CHECK(queries > 30);
      CHECK(wrong == 0);
      // Check the winding number itself independently.
      for (int k = 0; k < 2; ++k) {
        const Complex z = inner_points(rest, 1, random(), 1)[0], w = warp.map->at(z).f;
        if (const auto judged = wound(warp, w)) CHECK(warp.inverse->winding(w) == judged);
      }
    }
  }
}

TEST_CASE("Inverse: for every method with a point map, points next to the boundary are recovered") {
  constexpr double kAccurate = 1e-11;  // relative to the size plus |w|, as the header states
  for (const unsigned seed : seeds_of("inverses of all methods", {41}))
    for (const Method& method : methods())
      for (const bool curved : {false, true}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> by(-18, 18);
        Rest rest;
        rest.cage =
            curved ? curved_star(6, 3, 0.2, seed) : polygon_cage(shapes::star(7, 0.25, seed));
        rest.precision = Precision::full;
        rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {700}));
        rest.samples = rest.mesh->vertices;
        Pose pose{rest.cage, {}};
        for (Points& segment : pose.cage.segments)
          for (Complex& z : segment) z += Complex(by(random), by(random));
        const auto deformer = method.prepare(rest, nullptr);
        SampledMap map = deformer->deform(pose, {});
        const auto at = deformer->point_map(pose);
        if (!at) continue;
        const InverseMap inverse(rest.cage, *rest.mesh, as_span(map.f), *at);
        const Points outline = flattened(rest.cage).points;
        const double size = box_of(outline).diagonal();
        for (const Complex z : inner_points(rest.cage, 40, random(), 0.7)) {
          const PointMap::Value there = at->at(z);
          const double squeezed = std::abs(std::abs(there.fz) - std::abs(there.fzbar));
          if (squeezed < 0.05) continue;  // next to a fold, two preimages nearly coincide
          const auto found = inverse.at(there.f);
          double nearest = 1e300;
          for (const Preimage& p : found) {
            nearest = std::min(nearest, std::abs(p.z - z));
            CHECK(std::abs(at->at(p.z).f - there.f) <= kAccurate * (size + std::abs(there.f)));
            CHECK((contains(rest.cage, p.z) ||
                   nearest_on_polygon(outline, p.z).distance <= 1e-4 * size));
          }
          INFO(method.id << (curved ? ", curved" : "") << ", seed " << seed << ", z " << z.real()
                         << " " << z.imag() << ", " << found.size() << " found");
          CHECK(nearest <= 1e-6);
          // Unless w is on the boundary's image, all preimages are counted.
          const auto wanted = inverse.winding(there.f);
          int sum = 0;
          for (const Preimage& p : found) sum += p.orientation;
          if (wanted) CHECK(sum == *wanted);
        }
      }
}

TEST_CASE("Inverse: a branch point counts once for each sheet that meets there") {
  // z^2 along the boundary of a square around 0 winds twice around 0.
  Points square;
  for (int k = 0; k < 400; ++k) {
    const Complex corner = std::polar(100 * std::sqrt(2.0), kPi / 4 + k / 100 * kPi / 2),
                  next = kI * corner;
    square.push_back(corner + (k % 100) / 100.0 * (next - corner));
  }
  Points squared;
  for (const Complex& z : square) squared.push_back(z * z / 100.0);
  const Warp warp(polygon_cage(square), polygon_cage(squared), 800);
  Complex branch = 0;
  for (int step = 0; step < 50; ++step) {  // the zero of f', by the secant method
    const double h = 1e-3;
    const Complex slope = warp.map->at(branch).fz,
                  bend = (warp.map->at(branch + h).fz - warp.map->at(branch - h).fz) / (2 * h);
    branch -= slope / bend;
  }
  const Complex w = warp.map->at(branch).f;
  CHECK(warp.inverse->winding(w) == 2);
  CHECK(warp.inverse->at(w).size() == 2);
  CHECK(warp.inverse->at(w + Complex(1e-4, 0)).size() == 2);
}

}  // namespace holomorph::inverse_test
