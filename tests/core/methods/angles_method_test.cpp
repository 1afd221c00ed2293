// Method `angles`: the effect of posed cages, corner angles, tensions and pins on the boundary.
#include <random>

#include "core/angles/boundary_angles.h"
#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::angles_method_test {

namespace {

const Points kBar{{0, 0}, {600, 0}, {600, 100}, {0, 100}};

Rest rest_of(const Cage& cage, int vertices = 3000) {
  Rest rest;
  rest.cage = cage;
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(cage, {vertices}));
  rest.samples = rest.mesh->vertices;
  return rest;
}

Rest with_corners(Rest rest, std::vector<Index> corners) {
  rest.corners = std::move(corners);
  return rest;
}

SampledMap run(const Rest& rest, const Pose& pose) {
  SampledMap map = method_named("angles").prepare(rest, nullptr)->deform(pose, {});
  return map;
}

int flipped_triangle_count(const Mesh& mesh, const VectorXc& f) {
  int count = 0;
  for (const auto& [a, b, c] : mesh.triangles) count += !(cross(f[b] - f[a], f[c] - f[a]) > 0);
  return count;
}

/// The largest distance of f from the nearest map that is g followed by a similarity.
double difference_in_shape(const VectorXc& f, const VectorXc& g) {
  const VectorXc a = f.array() - f.mean(), b = g.array() - g.mean();
  return (a - b.dot(a) / b.squaredNorm() * b).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("Angles: corners rotated by 900 degrees roll a bar up into an exact spiral") {
  const Rest rest = with_corners(rest_of(polygon_cage(kBar)), {0, 1, 2, 3});
  const double turn = 900 * kPi / 180, a = turn / 600;
  const Pose pose{rest.cage, {}, {}, {{0, 0}, {turn, turn}, {turn, turn}, {0, 0}}};
  const SampledMap map = run(rest, pose);
  VectorXc exact(map.f.size());
  for (Index i = 0; i < exact.size(); ++i)
    exact[i] = std::exp(kI * a * rest.samples[static_cast<size_t>(i)]) / (kI * a);
  CHECK(difference_in_shape(map.f, exact) <= 1e-3);  // relative to 600, in single precision
  CHECK(flipped_triangle_count(*rest.mesh, map.f) == 0);
  CHECK(map.limited_corners.empty());
}

TEST_CASE("Angles: edges have the directions of the posed cage, regardless of its lengths") {
  Points to{{0, 0}, {900, 100}, {700, 300}, {-100, 150}};
  const Rest rest = rest_of(polygon_cage(kBar));
  const SampledMap map = run(rest, {polygon_cage(to), {}});
  const auto& corner = rest.mesh->cage_vertices;
  double length = 0;
  for (size_t e = 0; e < 4; ++e) {
    const Complex way = map.f[corner[(e + 1) % 4]] - map.f[corner[e]];
    length += std::abs(way);
    CHECK(std::abs(std::arg(way / (to[(e + 1) % 4] - to[e]))) <= 1e-3);
    for (const int v : rest.mesh->boundary)
      if (nearest_on_segment(kBar[e], kBar[(e + 1) % 4], rest.samples[static_cast<size_t>(v)])
              .distance < 1e-9)
        REQUIRE(std::abs(cross(way, map.f[v] - map.f[corner[e]])) <= 1e-3 * std::norm(way));
  }
  // The image is as long as the posed cage and has the same center.
  CHECK(length == Approx(perimeter(to)).epsilon(1e-2));
  Complex middle = 0;
  for (size_t j = 0; j < 4; ++j) middle += 0.25 * (map.f[corner[j]] - to[j]);
  CHECK(std::abs(middle) <= 0.01);
  CHECK(flipped_triangle_count(*rest.mesh, map.f) == 0);
}

TEST_CASE("Angles: without tension, edges bend and corners keep their angles") {
  const Cage cage = polygon_cage(kBar),
             posed = polygon_cage(Points{{0, 0}, {600, 200}, {500, 400}, {0, 100}});
  const std::vector<Index> all{0, 1, 2, 3};
  const auto jump = [&](double tension, size_t corner) {
    std::vector<PoseCorner> own(4);
    for (PoseCorner& c : own) c.tension = tension;
    const VectorXd theta = boundary_angles(cage, posed, all, own).theta;
    return theta[static_cast<Index>(2 * corner + 1)] - theta[static_cast<Index>(2 * corner)];
  };
  const auto bend = [&](double tension) {
    std::vector<PoseCorner> own(4);
    own[1].tension = tension;
    const VectorXd theta = boundary_angles(cage, posed, all, own).theta;
    return std::abs(theta[4] - theta[3]);
  };
  constexpr double kRounding = 1e-14;  // a dozen sums of angles below 8, each rounded to 2^-51
  for (size_t j = 0; j < 4; ++j) {
    CHECK(std::abs(jump(0, j)) <= 1e-12);
    CHECK_THAT(jump(0.5, j), Catch::WithinAbs(0.5 * jump(1, j), kRounding));
  }
  CHECK(bend(1) <= 1e-12);
  CHECK(bend(0) > 0.1);
}

TEST_CASE("Angles: corners are held at the smallest angle and named in the note") {
  const Rest rest = with_corners(rest_of(polygon_cage(kBar)), {0, 1, 2, 3});
  const Pose pose{rest.cage, {}, {}, {{0, 0}, {-1.5, 1.5}, {0, 0}, {0, 0}}};  // 90 - 172 degrees
  const SampledMap map = run(rest, pose);
  CHECK(map.limited_corners == std::vector<Index>{1});
  CHECK_THAT(map.note, Catch::Contains("Corner 2 held at 5 degrees"));
  CHECK(flipped_triangle_count(*rest.mesh, map.f) == 0);
  const VectorXd theta = boundary_angles(rest.cage, rest.cage, rest.corners, pose.corners).theta;
  constexpr double kRounding = 1e-14;  // a dozen sums of angles below 8, each rounded to 2^-51
  CHECK_THAT(kPi / 2 - (theta[3] - theta[2]), Catch::WithinAbs(kLeastCornerAngle, kRounding));
}

TEST_CASE("Angles: the angles are continuous while a vertex is dragged across an edge") {
  const Cage cage = polygon_cage(kBar);
  const std::vector<Index> all{0, 1, 2, 3};
  const std::vector<PoseCorner> own(4);
  VectorXd last;
  for (int step = 0; step <= 60; ++step) {  // the last vertex moves down across the first edge
    Points to = kBar;
    to[3] = {150, 100 - 5.0 * step};
    const VectorXd theta = boundary_angles(cage, polygon_cage(to), all, own).theta;
    if (step > 0) CHECK((theta - last).cwiseAbs().maxCoeff() < 0.15);
    last = theta;
  }
}

TEST_CASE("Angles: five pins are met without a fold") {
  const Points animal{{0, 0},     {14, 0},    {18, 60},   {80, 62},   {84, 0},    {98, 0},
                      {104, 90},  {118, 170}, {130, 250}, {160, 252}, {162, 268}, {116, 276},
                      {100, 200}, {88, 130},  {30, 120},  {4, 100}};
  Rest rest = rest_of(polygon_cage(animal));
  const double size = box_of(rest.samples).diagonal();
  for (const Complex z : {Complex(8, 12), {91, 10}, {95, 110}, {117, 200}, {150, 260}})
    rest.pins.push_back({z, false});
  rest.pins[2].has_frame = true;
  const auto deformer = method_named("angles").prepare(rest, nullptr);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> by(-25, 25);
  int most = 0;
  for (int number = 0; number < 8; ++number) {
    Pose pose{rest.cage, {}};
    for (const RestPin& pin : rest.pins)
      pose.pins.push_back({pin.position + Complex(by(random), by(random)), 0.4, 1.2});
    SampledMap map = deformer->deform(pose, {});
    most = std::max(most, map.iterations);
    CHECK(map.status == SampledMap::Status::exact);
    CHECK(flipped_triangle_count(*rest.mesh, map.f) == 0);
    const auto at = deformer->point_map(pose);
    for (size_t i = 0; i < 5; ++i)
      CHECK(std::abs(at->at(rest.pins[i].position).f - pose.pins[i].position) <= 1e-6 * size);
    CHECK(std::abs(at->at(rest.pins[2].position).fz - std::polar(1.2, 0.4)) <= 1e-6);
  }
  CHECK(most <= 30);
}

TEST_CASE("Angles: pins that cannot be met still give a map, and a note") {
  Rest rest = rest_of(polygon_cage(kBar), 800);
  Pose pose{rest.cage, {}};
  for (int i = 0; i < 8; ++i) {  // more pins than the corners of a bar can follow
    rest.pins.push_back({{50.0 + 70 * i, 50}, false});
    pose.pins.push_back({rest.pins.back().position + Complex(0, i % 2 ? 40 : -40)});
  }
  const SampledMap map = run(rest, pose);
  CHECK(map.f.allFinite());
  CHECK_THAT(map.note, Catch::Contains("Pins are missed"));
}

TEST_CASE("Angles: a single pin with a frame acts as an anchor") {
  Rest rest = with_corners(rest_of(polygon_cage(kBar)), {0, 1, 2, 3});
  rest.pins = {{{50, 50}, true}};
  const Pose pose{rest.cage, {{{10, 20}, 0, 1}}, {}, {{0, 0}, {2, 2}, {2, 2}, {0, 0}}};
  const auto deformer = method_named("angles").prepare(rest, nullptr);
  const auto at = deformer->point_map(pose)->at({50, 50});
  CHECK(std::abs(at.f - Complex(10, 20)) <= 1e-6);
  CHECK(std::abs(at.fz - 1.0) <= 1e-6);
  Rest free = rest;
  free.pins.clear();
  SampledMap held, loose;
  held = deformer->deform(pose, {});
  loose =
      method_named("angles").prepare(free, nullptr)->deform({pose.cage, {}, {}, pose.corners}, {});
  CHECK(difference_in_shape(held.f, loose.f) <= 1e-2);
}

TEST_CASE("Angles: reversing the cage does not change the map") {
  Cage to = polygon_cage(Points{{0, 0}, {600, 200}, {500, 400}, {0, 100}});
  const std::vector<PoseCorner> own{{0.1, 0.3, 0.5}, {0, 0, 1}, {-0.2, 0.1, 0}, {0.3, 0.3, 0.7}};
  const Rest rest = with_corners(rest_of(polygon_cage(kBar)), {0, 1, 2, 3});
  Rest backwards = rest;
  backwards.cage = reversed(rest.cage);
  // Vertex i becomes vertex 4 - i, and the edge before it becomes the edge after it.
  Pose pose{to, {}, {}, own}, turned{reversed(to), {}};
  for (const size_t i : {0, 3, 2, 1})
    turned.corners.push_back({own[i].after, own[i].before, own[(i + 3) % 4].tension});
  CHECK((run(rest, pose).f - run(backwards, turned).f).cwiseAbs().maxCoeff() <= 1e-3);
}

TEST_CASE("Angles: a wavy bar of 200 vertices is mapped onto a triangle (WG10, fig. 8)") {
  Points bar;
  for (int i = 0; i < 90; ++i) bar.push_back({i * 600.0 / 90, 8 * std::sin(2 * kPi * i / 30)});
  for (int i = 0; i < 10; ++i) bar.push_back({600, i * 10.0});
  for (int i = 0; i < 90; ++i)
    bar.push_back({600 - i * 600.0 / 90, 100 + 8 * std::sin(2 * kPi * (90 - i) / 30)});
  for (int i = 0; i < 10; ++i) bar.push_back({0, 100 - i * 10.0});
  REQUIRE(bar.size() == 200);
  const Points triangle{{0, 0}, {500, 0}, {200, 400}};
  Points to;
  for (size_t i = 0; i < 200; ++i) {
    const size_t side = i < 90    ? 0
                        : i < 145 ? 1
                                  : 2,
                 first = side == 0   ? 0
                         : side == 1 ? 90
                                     : 145,
                 count = side == 0 ? 90 : 55;
    const double t = static_cast<double>(i - first) / static_cast<double>(count);
    to.push_back(triangle[side] + t * (triangle[(side + 1) % 3] - triangle[side]));
  }
  Rest rest = rest_of(polygon_cage(bar), 1500);
  rest.precision = Precision::full;
  const SampledMap map = run(rest, {polygon_cage(to), {}});
  CHECK(flipped_triangle_count(*rest.mesh, map.f) <=
        1);  // a triangle with three vertices on a straight edge
  const auto corner = [&](size_t k) {
    return map.f[rest.mesh->cage_vertices[std::array<size_t, 3>{0, 90, 145}[k % 3]]];
  };
  for (size_t side = 0; side < 3; ++side) {
    const Complex way = corner(side + 1) - corner(side);
    CHECK(std::abs(std::arg(way / (triangle[(side + 1) % 3] - triangle[side]))) <=
          0.002 * kPi / 180);
    const size_t from = std::array<size_t, 4>{0, 90, 145, 200}[side],
                 to_vertex = std::array<size_t, 4>{0, 90, 145, 200}[side + 1];
    for (size_t i = from; i < to_vertex; ++i)
      REQUIRE(std::abs(cross(way, map.f[rest.mesh->cage_vertices[i]] - corner(side))) <=
              1e-5 * std::norm(way));
  }
}

TEST_CASE("Angles: bad corners and poses are refused") {
  const Method& angles = method_named("angles");
  const Rest rest = rest_of(polygon_cage(kBar), 300);
  CHECK_THROWS_WITH(angles.prepare(with_corners(rest, {0, 1}), nullptr),
                    Catch::Contains("three corners"));
  CHECK_THROWS_WITH(angles.prepare(with_corners(rest, {0, 2, 1}), nullptr),
                    Catch::Contains("in order"));
  CHECK_THROWS_WITH(angles.prepare(with_corners(rest, {0, 1, 4}), nullptr),
                    Catch::Contains("vertices of the cage"));
  const auto deformer = angles.prepare(with_corners(rest, {0, 1, 2}), nullptr);
  SampledMap map;
  const auto pose = [&](PoseCorner corner) { return Pose{rest.cage, {}, {}, {corner, {}, {}}}; };
  CHECK_THROWS_AS(deformer->deform(pose({NAN, 0, 1}), {}), Error);
  CHECK_THROWS_AS(deformer->deform(pose({0, 0, 1.5}), {}), Error);
  CHECK_THROWS_AS(deformer->deform({rest.cage, {}}, {}), Error);
  CHECK_THROWS_WITH(deformer->deform(pose({0, 1e5, 1}), {}), Catch::Contains("so far"));
  // A straight corner and a posed edge of no length are allowed.
  const Rest straight =
      rest_of(polygon_cage(Points{{0, 0}, {300, 0}, {600, 0}, {600, 100}, {0, 100}}), 300);
  Pose flat{straight.cage, {}};
  flat.cage.segments[1][0] = flat.cage.segments[0][0];
  CHECK(run(straight, flat).f.allFinite());
  // So is a pin with a frame at a corner, where f' has no argument.
  Rest at_corner = with_corners(rest, {0, 1, 2, 3});
  at_corner.pins = {{{600, 100}, true}};
  CHECK(run(at_corner, {rest.cage, {{{620, 90}, 0.3, 1}}, {}, {{}, {}, {}, {}}}).f.allFinite());
}

TEST_CASE("Angles: the map is continuous, also along curves that bend inward") {
  for (const unsigned seed : seeds_of("angles in curves", {505, 1, 7})) {
    std::mt19937 random(seed);
    std::normal_distribution<double> by(0, 15);
    std::uniform_real_distribution<double> unit(0, 1);
    Rest rest;
    rest.cage = shapes::curved_star(8, 3, 0.25, seed);
    rest.precision = Precision::full;
    rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {1500}));
    Pose pose{rest.cage, {}};
    for (Points& segment : pose.cage.segments)
      for (Complex& z : segment) z += Complex(by(random), by(random));
    // Pairs of neighboring points, most of them near the boundary.
    constexpr double kStep = 1e-4;
    while (rest.samples.size() < 800) {
      const Index e = static_cast<Index>(random() % 8);
      const double t = 0.05 + 0.9 * unit(random);
      const Complex on = position_of(rest.cage, {e, t}),
                    way = position_of(rest.cage, {e, t + 1e-6}) - on;
      const Complex z = on + kI * way / std::abs(way) * std::pow(10.0, -3 + 4 * unit(random)),
                    next = z + std::polar(kStep, 2 * kPi * unit(random));
      if (!contains(rest.cage, z) || !contains(rest.cage, next)) continue;
      rest.samples.push_back(z);
      rest.samples.push_back(next);
    }
    SampledMap map;
    const auto deformer = method_named("angles").prepare(rest, nullptr);
    map = deformer->deform(pose, {true});
    const double size = box_of(rest.mesh->vertices).diagonal();
    for (Index i = 0; i < map.f.size(); i += 2) {
      const Complex step =
          rest.samples[static_cast<size_t>(i + 1)] - rest.samples[static_cast<size_t>(i)];
      // The trapezoidal rule is off by step^3 f''' / 12.
      const Complex jump = map.f[i + 1] - map.f[i] - 0.5 * (map.fz[i] + map.fz[i + 1]) * step;
      INFO("seed " << seed << ", point " << i);
      CHECK(std::abs(jump) <= 1e-11 * size);
    }
  }
}

TEST_CASE("Angles: a single sample gives a single value, even at a corner") {
  Rest rest;
  rest.cage = polygon_cage(Points{{300, 200}, {520, 230}, {500, 400}, {280, 390}});
  rest.precision = Precision::full;
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {400}));
  rest.corners = {0, 1, 2, 3};
  Pose pose{rest.cage, {}};
  pose.corners.resize(4);
  pose.corners[0] = {-0.9, 0.9, 1};
  for (const Complex z : {Complex(300, 200), Complex(300, 200) + 1e-14, Complex(400, 300)}) {
    rest.samples = {z};
    SampledMap map = method_named("angles").prepare(rest, nullptr)->deform(pose, {true});
    CHECK(map.f.size() == 1);
  }
}

TEST_CASE("Angles: points next to an opened corner are mapped correctly at any distance") {
  Rest rest;
  rest.cage = polygon_cage(Points{{300, 200}, {520, 230}, {500, 400}, {280, 390}});
  rest.precision = Precision::full;
  rest.corners = {0, 1, 2, 3};
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {400}));
  Pose pose{rest.cage, {}};
  pose.corners.resize(4);
  for (const double opened : {-0.9, -0.3, 0.4, 0.8}) {
    pose.corners[0] = {-opened, opened, 1};
    const Complex corner = rest.cage.vertex(0), inwards = Complex(1, 1);
    rest.samples = {corner};
    for (int k = 0; k <= 14; ++k) rest.samples.push_back(corner + std::pow(10.0, -k) * inwards);
    for (const double x : {-1e-13, 0.0, 1e-13}) rest.samples.push_back(corner + Complex(x, 6e-14));
    const auto deformer = method_named("angles").prepare(rest, nullptr);
    SampledMap map = deformer->deform(pose, {true});
    const auto points = deformer->point_map(pose);
    double before = 1e300;
    for (Index i = 1; i < map.f.size(); ++i) {
      INFO("opened by " << opened << ", point " << i);
      const Complex z = rest.samples[static_cast<size_t>(i)];
      REQUIRE(is_finite(map.f[i]));
      CHECK(is_finite(map.fz[i]));
      CHECK(std::abs(points->at(z).f - map.f[i]) <= 1e-6);
      const double off = std::abs(map.f[i] - map.f[0]);
      if (i <= 15) CHECK(off <= before);  // a power of the distance
      before = off;
    }
  }
}

}  // namespace holomorph::angles_method_test
