// The puppet's handles besides pins: strokes act as rows of pins, and without both the cage's
// points hold the boundary.

#include "core/geometry/polyline.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::puppet_handles_test {

namespace {

constexpr double kSize = 608;  // diagonal of the bar

Rest bar(const Points& cage) {
  Rest rest;
  rest.cage = polygon_cage(cage);
  const auto mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {900}));
  rest.mesh = mesh;
  rest.samples = mesh->vertices;
  return rest;
}

SampledMap solved(const Rest& rest, const Pose& pose) {
  return method_named("puppet").prepare(rest, nullptr)->deform(pose, {});
}

Complex image(const Rest& rest, const SampledMap& map, Complex z) {
  return locate_near(*rest.mesh, z).in(*rest.mesh, as_span(map.f));
}

/// A point of an arc that starts at the origin to the right and turns left by `angle` in all.
Complex on_arc(double length, double angle, double t) {
  const double radius = length / angle;
  return radius * Complex(std::sin(angle * t), 1 - std::cos(angle * t));
}

}  // namespace

TEST_CASE("Puppet: a stroke takes the picture along, point for point") {
  for (const unsigned seed : seeds_of("puppet_handles_test", {1, 2})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const double angle = 0.3 + std::uniform_real_distribution<>(0, 2)(random);
    Rest rest = bar(shapes::rectangle(600, 100));
    Points along, bent;
    for (int k = 0; k <= 20; ++k) {
      const double t = k / 20.0;
      along.push_back({50 + 500 * t, 50});
      bent.push_back(Complex(50, 50) + on_arc(500, angle, t));
    }
    rest.strokes = {along};
    const SampledMap map = solved(rest, {rest.cage, {}, {bent}});
    CHECK(map.status == SampledMap::Status::certified);
    for (size_t k = 0; k < along.size(); ++k)
      CHECK(std::abs(image(rest, map, along[k]) - bent[k]) <= 0.005 * kSize);
    // The arc is as long as the stroke, so the picture bends, but keeps its size along it.
    const double across = std::abs(image(rest, map, {300, 100}) - image(rest, map, {300, 0}));
    CHECK(across == Approx(100).epsilon(0.1));
  }
}

TEST_CASE("Puppet: a stroke that leaves the cage is used inside, and the note says so") {
  Rest rest = bar(shapes::rectangle(600, 100));
  rest.strokes = {{{100, 50}, {300, 50}, {300, 300}}};
  Pose pose{rest.cage, {}, rest.strokes};
  for (Complex& z : pose.strokes[0]) z += Complex(10, 20);
  const SampledMap map = solved(rest, pose);
  CHECK(map.note.find("leaves the cage") != std::string::npos);
  CHECK(std::abs(image(rest, map, {200, 50}) - Complex(210, 70)) <= 0.5);
}

TEST_CASE("Puppet: without pins and strokes the cage's points hold, however many there are") {
  const Points few = shapes::rectangle(600, 100);
  Points many;
  for (size_t i = 0; i < few.size(); ++i)
    for (const double t : {0.0, 0.25, 0.5})
      many.push_back(few[i] + t * (few[(i + 1) % 4] - few[i]));
  const auto moved = [](Complex z) {  // a bend that keeps lengths in the middle
    const Complex middle = on_arc(600, 0.8, z.real() / 600);
    return middle + (z.imag() - 50) * kI * std::polar(1.0, 0.8 * z.real() / 600);
  };
  const auto map_of = [&](const Points& cage, Rest& rest) {
    rest = bar(cage);
    Pose pose{rest.cage, {}};
    for (Points& segment : pose.cage.segments)
      for (Complex& z : segment) z = moved(z);
    return solved(rest, pose);
  };
  Rest rest, other;
  const SampledMap coarse = map_of(many, rest);
  Points twice;
  for (size_t i = 0; i < many.size(); ++i) {
    twice.push_back(many[i]);
    twice.push_back(0.5 * (many[i] + many[(i + 1) % many.size()]));
  }
  const SampledMap fine = map_of(twice, other);
  CHECK(coarse.status == SampledMap::Status::certified);
  for (const Complex z : {Complex(5, 5), Complex(300, 50), Complex(595, 95), Complex(150, 5)}) {
    CHECK(std::abs(image(rest, coarse, z) - moved(z)) <= 0.02 * kSize);
    CHECK(std::abs(image(rest, coarse, z) - image(other, fine, z)) <= 0.01 * kSize);
  }
}

TEST_CASE("Puppet: with pins, the number of cage points on straight edges hardly matters") {
  const Points corners{{0, 0},     {600, 0},   {600, 100}, {350, 100},
                       {350, 300}, {250, 300}, {250, 100}, {0, 100}};
  const auto posed = [&](int parts) {
    Points points;
    for (size_t i = 0; i < corners.size(); ++i)
      for (int k = 0; k < parts; ++k)
        points.push_back(corners[i] +
                         (corners[(i + 1) % corners.size()] - corners[i]) * (1.0 * k / parts));
    Rest rest = bar(points);
    Pose pose{rest.cage, {}};
    for (const auto& [from, to] : {std::pair(Complex(50, 50), Complex(50, 50)),
                                   std::pair(Complex(550, 50), Complex(520, 160)),
                                   std::pair(Complex(300, 270), Complex(180, 250))}) {
      rest.pins.push_back({from});
      pose.pins.push_back({to});
    }
    const SampledMap map = solved(rest, pose);
    Points images;
    for (const Complex& z : corners) images.push_back(image(rest, map, z));
    return images;
  };
  const Points few = posed(1), many = posed(24);
  for (size_t i = 0; i < few.size(); ++i) CHECK(std::abs(few[i] - many[i]) <= 0.003 * kSize);
}

}  // namespace holomorph::puppet_handles_test
