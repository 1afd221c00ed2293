// In-between maps: shapes are kept, bounds hold, and rotations go in the expected direction.
#include "core/mesh/inbetween.h"

#include <random>

#include "core/maps/distortion.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::inbetween_test {

namespace {

const Points kBar{{0, 0}, {600, 0}, {600, 100}, {0, 100}};

std::shared_ptr<const Mesh> bar_mesh(int vertices = 2000) {
  return std::make_shared<const Mesh>(domain_mesh(kBar, {vertices}));
}

/// The bar, bent evenly by an angle.
VectorXc rolled(const Mesh& mesh, double angle) {
  const double a = angle / 600;
  VectorXc f(static_cast<Index>(mesh.vertices.size()));
  for (Index i = 0; i < f.size(); ++i) {
    const Complex z = mesh.vertices[static_cast<size_t>(i)] - Complex(0, 50);
    f[i] = a == 0 ? z : (std::exp(kI * a * z) - 1.0) / (kI * a);
  }
  return f;
}

double area(const Mesh& mesh, const VectorXc& f) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += 0.5 * cross(f[b] - f[a], f[c] - f[a]);
  return sum;
}

/// The length of the lower edge.
double length(const Mesh& mesh, const VectorXc& f) {
  double sum = 0;
  for (size_t i = 0; i < mesh.boundary.size(); ++i) {
    const int a = mesh.boundary[i], b = mesh.boundary[(i + 1) % mesh.boundary.size()];
    if (std::abs(mesh.vertices[static_cast<size_t>(a)].imag()) < 1e-9 &&
        std::abs(mesh.vertices[static_cast<size_t>(b)].imag()) < 1e-9)
      sum += std::abs(f[b] - f[a]);
  }
  return sum;
}

double largest_nu(const Inbetween& between, const VectorXc& f) {
  return between.shape_of(f).nu.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("In-betweens of a bar bent by 270 degrees keep its area and length") {
  const auto mesh = bar_mesh();
  const Inbetween between(mesh);
  const VectorXc flat = rolled(*mesh, 0), bent = rolled(*mesh, 1.5 * kPi);
  const Inbetween::Shape a = between.shape_of(flat),
                         b = between.shape_after(a, between.shape_of(bent), {Complex(1, 50), 0});
  double least_linear = 1;
  for (const double u : {0.1, 0.25, 0.5, 0.75, 0.9}) {
    VectorXc f;
    between.blend({a, b}, u, f);
    const VectorXc exact = rolled(*mesh, 1.5 * kPi * u), linear = (1 - u) * flat + u * bent;
    INFO("at " << u);
    // The bent bar is 10.6 % larger. In between, the area grows geometrically.
    const double wanted = std::pow(area(*mesh, bent), u) * std::pow(area(*mesh, flat), 1 - u);
    CHECK(std::abs(area(*mesh, f) / wanted - 1) <= 0.025);
    CHECK(std::abs(area(*mesh, f) / area(*mesh, exact) - 1) <= 0.002);
    CHECK(std::abs(length(*mesh, f) / length(*mesh, exact) - 1) <= 0.01);
    // Except for its position, the result is the bar bent by part of the angle.
    const VectorXc off = (f.array() - f.mean()) - (exact.array() - exact.mean());
    CHECK(off.cwiseAbs().maxCoeff() <= 0.01 * 600);
    least_linear = std::min(least_linear, area(*mesh, linear) / area(*mesh, flat));
  }
  CHECK(least_linear < 0.45);  // blending the vertices loses more than half of the area
}

TEST_CASE("In-betweens: ends are exact, and a fixed point stays fixed") {
  const auto mesh = bar_mesh(600);
  const Inbetween between(mesh);
  const VectorXc flat = rolled(*mesh, 0);
  VectorXc turned = flat;
  const Complex pivot(60, 20);
  for (Complex& z : turned) z = pivot + std::polar(1.0, 2.0) * (z - pivot);
  const Inbetween::Shape a = between.shape_of(flat),
                         b = between.shape_after(a, between.shape_of(turned));
  VectorXc f;
  between.blend({a, b}, 0, f);
  CHECK(f == flat);
  between.blend({a, b}, 1, f);
  CHECK(f == turned);
  between.blend({a, b}, 0.5, f);
  for (Index i = 0; i < f.size(); ++i)
    REQUIRE(std::abs(f[i] - (pivot + std::polar(1.0, 1.0) * (flat[i] - pivot))) <= 6);
  const VectorXd sizes = between.shape_of(f).logarithm.real();
  CHECK(sizes.cwiseAbs().maxCoeff() <= 1e-9);  // the in-between of two rotations is a rotation
}

TEST_CASE("In-betweens: the expected turn decides the number of whole turns") {
  const auto mesh = bar_mesh(600);
  const Inbetween between(mesh);
  const VectorXc flat = rolled(*mesh, 0), bent = rolled(*mesh, 5 * kPi);
  const Inbetween::Shape a = between.shape_of(flat);
  const auto turn_at_start = [&](const ExpectedTurn& expected) {
    const Inbetween::Shape b = between.shape_after(a, between.shape_of(bent), expected);
    const auto at = locate(*mesh, mesh->vertices, {2, 50});
    return (b.logarithm - a.logarithm)[at->triangle].imag();
  };
  CHECK(std::abs(turn_at_start({Complex(2, 50), 0})) < 0.3);
  CHECK(turn_at_start({Complex(2, 50), 2 * kPi}) == Approx(2 * kPi).margin(0.3));
  CHECK(turn_at_start({{}, 2.5 * kPi}) ==
        Approx(0).margin(0.3));  // without a point, the average turn is expected
  VectorXc f;
  const Inbetween::Shape b = between.shape_after(a, between.shape_of(bent), {{}, 2.5 * kPi});
  between.blend({a, b}, 0.5, f);
  const VectorXc exact = rolled(*mesh, 2.5 * kPi);
  const VectorXc off = (f.array() - f.mean()) - (exact.array() - exact.mean());
  CHECK(off.cwiseAbs().maxCoeff() <= 12);
}

TEST_CASE("In-betweens: rotations go around triangles that are flipped") {
  const auto mesh = bar_mesh(1000);
  const Inbetween between(mesh);
  for (const unsigned seed : seeds_of("flipped triangles", {1, 2, 3, 4})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const double angle = 2 * random_complex(random).real();
    VectorXc from = rolled(*mesh, 0), to = rolled(*mesh, 0.3);
    for (Complex& z : to) z *= std::polar(1.0, angle);
    // Some vertices go far astray in each map, and so flip triangles around them.
    for (VectorXc* f : {&from, &to})
      for (Complex& z : *f)
        if (random() % 25 == 0) z += 60.0 * random_complex(random);
    const Inbetween::Shape a = between.shape_of(from),
                           b = between.shape_after(a, between.shape_of(to));
    double astray = 0, upright = 0;
    for (Index t = 0; t < a.nu.size(); ++t) {
      if (std::abs(a.nu[t]) >= 1 || std::abs(b.nu[t]) >= 1) continue;
      const double area = area_of(*mesh, mesh->triangles[static_cast<size_t>(t)]),
                   turn = (b.logarithm[t] - a.logarithm[t]).imag();
      upright += area;
      if (std::abs(turn - angle) > kPi) astray += area;
    }
    CHECK(upright > 0.2 * 600 * 100);
    CHECK(astray < 0.05 * upright);
  }
}

TEST_CASE("In-betweens: bounded distortion stays bounded") {
  // Two harmonic maps, one with a bend.
  const auto mesh = bar_mesh(1500);
  const Inbetween between(mesh);
  VectorXc wide(static_cast<Index>(mesh->vertices.size())), tall = wide;
  for (Index i = 0; i < wide.size(); ++i) {
    const Complex z = mesh->vertices[static_cast<size_t>(i)];
    wide[i] = std::exp(kI * z / 300.0) * 300.0 + 0.4 * std::conj(z);
    tall[i] = 0.8 * z + 0.3 * kI * std::conj(z * z) / 900.0;
  }
  const Inbetween::Shape a = between.shape_of(wide),
                         b = between.shape_after(a, between.shape_of(tall));
  const double k = std::max(largest_nu(between, wide), largest_nu(between, tall));
  REQUIRE(k < 0.9);
  const auto least = [](const Inbetween::Shape& s) {
    return (s.logarithm.real().array().exp() * (1 - s.nu.array().abs())).minCoeff();
  };
  const auto most = [](const Inbetween::Shape& s) {
    return (s.logarithm.real().array().exp() * (1 + s.nu.array().abs())).maxCoeff();
  };
  for (const double u : {0.2, 0.5, 0.8}) {
    VectorXc f;
    between.blend({a, b}, u, f);
    const Inbetween::Shape shape = between.shape_of(f);
    CHECK(shape.nu.cwiseAbs().maxCoeff() <= k + 0.01);
    CHECK(least(shape) >= std::min(least(a), least(b)) - 0.01);
    CHECK(most(shape) <= std::max(most(a), most(b)) * (1 + k / 2) / std::sqrt(1 + k) + 0.01);
  }
}

TEST_CASE(
    "In-betweens: smooth motion passes through keys without stopping, and is at rest at its ends") {
  const auto mesh = bar_mesh(300);
  const Inbetween between(mesh);
  const Inbetween::Shape a = between.shape_of(rolled(*mesh, 0)),
                         b = between.shape_after(a, between.shape_of(rolled(*mesh, 1))),
                         c = between.shape_after(b, between.shape_of(rolled(*mesh, 3)));
  const VectorXc at_a = between.slopes(nullptr, a, &b, 0, 1),
                 at_b = between.slopes(&a, b, &c, 1, 2),
                 at_c = between.slopes(&b, c, nullptr, 2, 0);
  const auto turn = [&](const Inbetween::Interval& interval, double u) {
    VectorXc f;
    between.blend(interval, u, f);
    const Inbetween::Shape shape = between.shape_after(a, between.shape_of(f), {Complex(2, 50), 0});
    return (shape.logarithm - a.logarithm).imag().mean();
  };
  const double h = 1e-3;
  const Inbetween::Interval first{a, b, 1, &at_a, &at_b}, second{b, c, 2, &at_b, &at_c};
  const double before = (turn(first, 1) - turn(first, 1 - h)) / h,
               after = (turn(second, h / 2) - turn(second, 0)) / h;
  CHECK(before == Approx(after).epsilon(0.02));
  CHECK(before > 0.3);
  CHECK(std::abs(turn(first, h) - turn(first, 0)) / h <= 0.01);
  CHECK(std::abs(turn(second, 1) - turn(second, 1 - h)) / h <= 0.01);
}

}  // namespace holomorph::inbetween_test
