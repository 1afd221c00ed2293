// Smooth maps on a mesh: quadratics are reproduced, derivatives are continuous, and bounds enclose
// them.
#include "core/sheet/smooth_map.h"

#include "core/maps/distortion.h"
#include "core/mesh/mesher.h"
#include "core/sheet/sheet_energy.h"
#include "core/sheet/vertex_gradients.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::smooth_map_test {

namespace {

std::shared_ptr<const Mesh> star_mesh(unsigned seed, int vertices) {
  return std::make_shared<const Mesh>(
      domain_mesh(polygon_cage(shapes::star(6, 0.3, seed)), {vertices}));
}

/// A quadratic function of x and y with complex values.
struct RandomQuadratic {
  std::array<Complex, 6> c;

  explicit RandomQuadratic(std::mt19937& random) {
    for (Complex& each : c) each = random_complex(random);
  }
  PointMap::Value at(Complex z) const {
    const double x = z.real() / 100, y = z.imag() / 100;
    const Complex fx = (c[1] + 2.0 * c[3] * x + c[4] * y) / 100.0,
                  fy = (c[2] + c[4] * x + 2.0 * c[5] * y) / 100.0;
    return {c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y,
            0.5 * (fx - kI * fy), 0.5 * (fx + kI * fy)};
  }
};

/// A smooth map that bends a picture, and does not fold.
Complex waved(Complex z) {
  return z + 30.0 * std::sin(z.imag() / 60) + 20.0 * kI * std::cos(z.real() / 80);
}

SmoothMap smooth(const std::shared_ptr<const Mesh>& mesh, const VectorXc& f) {
  const VertexGradients gradients(*mesh);
  return {mesh, std::make_shared<const MeshLocator>(*mesh), f, gradients.fz(f), gradients.fzbar(f)};
}

VectorXc at_vertices(const Mesh& mesh, const std::function<Complex(Complex)>& map) {
  VectorXc f(static_cast<Index>(mesh.vertices.size()));
  for (Index v = 0; v < f.size(); ++v) f[v] = map(mesh.vertices[static_cast<size_t>(v)]);
  return f;
}

Location random_location(const Mesh& mesh, std::mt19937& random) {
  Location at{static_cast<int>(random() % mesh.triangles.size())};
  double sum = 0;
  for (double& weight : at.weights) sum += weight = 1.001 + random_complex(random).real();
  for (double& weight : at.weights) weight /= sum;
  return at;
}

}  // namespace

TEST_CASE("Smooth map: quadratics are reproduced, with their derivatives") {
  for (const unsigned seed : seeds_of("quadratics", {1, 2, 3})) {
    std::mt19937 random(seed);
    const auto mesh = star_mesh(seed, 300);
    const RandomQuadratic quadratic(random);
    const VectorXc f = at_vertices(*mesh, [&](Complex z) { return quadratic.at(z).f; });
    const SmoothMap map = smooth(mesh, f);
    for (int i = 0; i < 500; ++i) {
      const Location at = random_location(*mesh, random);
      const PointMap::Value found = map.at(at), exact = quadratic.at(at.in(*mesh, mesh->vertices));
      CHECK(std::abs(found.f - exact.f) < 1e-10);
      CHECK(std::abs(found.fz - exact.fz) < 1e-11);
      CHECK(std::abs(found.fzbar - exact.fzbar) < 1e-11);
    }
  }
}

TEST_CASE("Smooth map: values and derivatives are continuous between triangles and thirds") {
  for (const unsigned seed : seeds_of("continuity of smooth maps", {1, 2})) {
    std::mt19937 random(seed);
    const auto mesh = star_mesh(seed, 200);
    VectorXc f = at_vertices(*mesh, waved), fz(f.size()), fzbar(f.size());
    for (Index v = 0; v < f.size(); ++v) {  // any derivatives will do
      fz[v] = 1.0 + random_complex(random);
      fzbar[v] = random_complex(random);
    }
    const SmoothMap map(mesh, nullptr, f, fz, fzbar);
    const auto near = [](const PointMap::Value& a, const PointMap::Value& b) {
      CHECK(std::abs(a.f - b.f) < 1e-9);
      CHECK(std::abs(a.fz - b.fz) < 1e-9);
      CHECK(std::abs(a.fzbar - b.fzbar) < 1e-9);
    };
    std::map<std::pair<int, int>, std::pair<int, int>> sides;  // triangle and corner
    for (size_t t = 0; t < mesh->triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const Triangle& own = mesh->triangles[t];
        const int a = own[static_cast<size_t>((k + 1) % 3)],
                  b = own[static_cast<size_t>((k + 2) % 3)];
        const double s = 0.5 + 0.49 * random_complex(random).real();
        Location here{static_cast<int>(t)};
        here.weights[static_cast<size_t>((k + 1) % 3)] = s;
        here.weights[static_cast<size_t>((k + 2) % 3)] = 1 - s;
        if (const auto found = sides.find({b, a}); found != sides.end()) {
          const auto [other, corner] = found->second;
          Location there{other};
          there.weights[static_cast<size_t>((corner + 2) % 3)] = s;
          there.weights[static_cast<size_t>((corner + 1) % 3)] = 1 - s;
          near(map.at(here), map.at(there));
        }
        sides[{a, b}] = {static_cast<int>(t), k};
        // On both sides of the line from a corner to the center.
        Location left{static_cast<int>(t), {0.3, 0.3, 0.3}}, right = left;
        left.weights[static_cast<size_t>(k)] = right.weights[static_cast<size_t>(k)] = 0.4;
        left.weights[static_cast<size_t>((k + 1) % 3)] += 1e-13;
        right.weights[static_cast<size_t>((k + 2) % 3)] += 1e-13;
        near(map.at(left), map.at(right));
      }
  }
}

TEST_CASE("Smooth map: rows of points are the map there, and sum to one") {
  for (const unsigned seed : seeds_of("rows of smooth maps", {1, 2})) {
    std::mt19937 random(seed);
    const auto mesh = star_mesh(seed, 150);
    VectorXc f(static_cast<Index>(mesh->vertices.size()));
    for (Complex& z : f) z = random_complex(random);
    const VertexGradients gradients(*mesh);
    const SmoothMap map = smooth(mesh, f);
    for (int i = 0; i < 100; ++i) {
      const Location at = random_location(*mesh, random);
      Complex value = 0;
      double sum = 0;
      for (const auto& [v, weight] : smooth_row(*mesh, gradients, at)) {
        value += weight * f[v];
        sum += weight;
      }
      CHECK(std::abs(value - map.at(at).f) < 1e-11);
      CHECK(std::abs(sum - 1) < 1e-12);
    }
  }
}

TEST_CASE("Smooth map: recovered derivatives converge, and bounds enclose what is attained") {
  for (const unsigned seed : seeds_of("bounds of smooth maps", {1, 2})) {
    std::mt19937 random(seed);
    double coarse = 0;
    for (const int vertices : {300, 1200}) {
      const auto mesh = star_mesh(seed, vertices);
      const SmoothMap map = smooth(mesh, at_vertices(*mesh, waved));
      double off = 0;
      for (int i = 0; i < 500; ++i) {
        const Location at = random_location(*mesh, random);
        const Complex z = at.in(*mesh, mesh->vertices);
        const Complex fx = 1.0 - 0.25 * kI * std::sin(z.real() / 80),
                      fy = kI + 0.5 * std::cos(z.imag() / 60);
        const PointMap::Value found = map.at(at);
        off = std::max(off, std::abs(found.fz - 0.5 * (fx - kI * fy)));
      }
      if (vertices == 300)
        coarse = off;
      else
        CHECK(off < 0.6 * coarse);
      CHECK(off < 0.1);
      for (size_t t = 0; t < mesh->triangles.size(); t += 7) {
        const StretchBounds bounds = map.cubics(t).bounds(8);
        double smallest = 1e9, largest = 0, determinant = 1e9;
        for (int i = 0; i < 60; ++i) {
          Location at = random_location(*mesh, random);
          at.triangle = static_cast<int>(t);
          if (i < 3) at.weights = {i == 0 ? 1. : 0., i == 1 ? 1. : 0., i == 2 ? 1. : 0.};
          const PointMap::Value value = map.at(at);
          const double a = std::abs(value.fz), b = std::abs(value.fzbar);
          smallest = std::min(smallest, a - b);
          largest = std::max(largest, a + b);
          determinant = std::min(determinant, a * a - b * b);
        }
        CHECK(bounds.smallest <= smallest * (1 + 1e-12));
        CHECK(bounds.largest >= largest * (1 - 1e-12));
        CHECK(bounds.least_determinant <= determinant * (1 + 1e-12));
        // Points are not dense enough to attain the extremes.
        CHECK(bounds.smallest >= 0.9 * smallest);
        CHECK(bounds.largest <= 1.1 * largest);
        CHECK(bounds.least_determinant > 0);
      }
    }
  }
}

TEST_CASE("Smooth map: guarded, it does not fold where no triangle is flipped") {
  for (const unsigned seed : seeds_of("guarded maps", {1, 2, 3})) {
    std::mt19937 random(seed);
    const auto mesh = star_mesh(seed, 200);
    const SheetEnergy sheet(mesh, VectorXd::Ones(static_cast<Index>(mesh->triangles.size())),
                            VectorXd::Zero(static_cast<Index>(mesh->vertices.size())));
    const std::vector<char> outer = boundary_marks(*mesh);
    VectorXc f = at_vertices(*mesh, [](Complex z) { return z; }), d(f.size());
    for (int round = 0; round < 6; ++round) {  // ever closer to a flip, in more and more places
      for (Index v = 0; v < d.size(); ++v)
        d[v] = outer[static_cast<size_t>(v)] ? Complex(0) : 10.0 * random_complex(random);
      f += std::min(1.0, 0.9 * sheet.first_flip(f, d)) * d;
    }
    REQUIRE(flipped_triangles(*mesh, f) == 0);
    SmoothMap map = smooth(mesh, f);
    const SmoothMap::Guarded guarded = map.guard();
    CAPTURE(seed, guarded.straightened);
    CHECK_FALSE(guarded.unproved);
    CHECK(guarded.straightened > 10);
    CHECK(guarded.straightened < mesh->triangles.size());
    for (int i = 0; i < 2000; ++i) {
      const PointMap::Value at = map.at(random_location(*mesh, random));
      CHECK(std::abs(at.fz) > std::abs(at.fzbar));
    }
    // It is continuous, and passes through the values.
    const MeshLocator locator(*mesh);
    for (size_t t = 0; t < mesh->triangles.size(); ++t)
      for (size_t k = 0; k < 3; ++k) {
        Location at{static_cast<int>(t)};
        at.weights[k] = 1;
        CHECK(std::abs(map.at(at).f - f[mesh->triangles[t][k]]) < 1e-9);
        at.weights[k] = 0.3, at.weights[(k + 1) % 3] = 0.7;
        const Complex z = at.in(*mesh, mesh->vertices),
                      across =
                          (z -
                           mesh->vertices[static_cast<size_t>(mesh->triangles[t][(k + 2) % 3])]) *
                          1e-9;
        if (const auto other = locator.at(z + across))
          CHECK(std::abs(map.at(*other).f - map.at(at).f) < 1e-5);
      }
  }
}

TEST_CASE("Smooth map: a flipped triangle is not proved, nor is an image that winds twice") {
  const auto mesh = star_mesh(3, 100);
  VectorXc f = at_vertices(*mesh, [](Complex z) { return std::conj(z); });
  SmoothMap mirrored = smooth(mesh, f);
  CHECK(mirrored.guard().unproved);
  // The square function, around a vertex: all triangles are counter-clockwise.
  Mesh wheel;
  wheel.vertices.push_back(0);
  for (int k = 0; k < 12; ++k) wheel.vertices.push_back(std::polar(1.0, 2 * kPi * k / 12));
  for (int k = 1; k <= 12; ++k) {
    wheel.triangles.push_back({0, k, k % 12 + 1});
    wheel.boundary.push_back(k);
  }
  const auto shared = std::make_shared<const Mesh>(wheel);
  const VectorXc squares = at_vertices(wheel, [](Complex z) { return z * z; });
  REQUIRE(flipped_triangles(wheel, squares) == 0);
  SmoothMap twice = smooth(shared, squares);
  CHECK(twice.guard().unproved);
}

}  // namespace holomorph::smooth_map_test
