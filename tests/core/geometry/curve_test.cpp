// Bezier segments, cages and polygons.
#include "core/geometry/curve.h"

#include "core/error.h"
#include "core/geometry/cage.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace holomorph::curve_test {

namespace {
const Points kCubic{{0, 0}, {10, 40}, {60, -20}, {80, 30}};
}

TEST_CASE("Splitting a curve and raising its degree do not change it") {
  for (const double t : {0.1, 0.5, 0.83}) {
    const SplitCurve halves = split(kCubic, t);
    CHECK(halves.before.back() == halves.after.front());
    for (const double u : {0.0, 0.25, 0.5, 1.0}) {
      CHECK(std::abs(bezier_point(halves.before, u) - bezier_point(kCubic, u * t)) < 1e-12);
      CHECK(std::abs(bezier_point(halves.after, u) - bezier_point(kCubic, t + u * (1 - t))) <
            1e-12);
      CHECK(std::abs(bezier_point(elevated(kCubic, 7), u) - bezier_point(kCubic, u)) < 1e-12);
    }
  }
  CHECK_THROWS_AS(elevated(kCubic, 2), Error);
}

TEST_CASE("Fitting recovers the curve from which the samples were taken") {
  Points samples;
  std::vector<double> parameters;
  for (int i = 0; i <= 20; ++i) {
    parameters.push_back(i / 20.0);
    samples.push_back(bezier_point(kCubic, i / 20.0));
  }
  const Points again = fitted(samples, parameters, 3);
  for (int m = 0; m < 4; ++m) CHECK(std::abs(again[m] - kCubic[m]) < 1e-10);
}

TEST_CASE("Inserting a vertex keeps the loop, and erasing it restores the segment") {
  Cage cage = polygon_cage(shapes::rectangle(100, 60));
  cage.segments[1] = {{100, 0}, {120, 20}, {90, 40}};
  const Cage before = cage;
  insert_vertex(cage, 1, 0.3);
  REQUIRE(cage.size() == 5);
  const Points curve = before.controls(1);
  CHECK(std::abs(bezier_point(cage.controls(1), 0.5) - bezier_point(curve, 0.15)) < 1e-12);
  CHECK(std::abs(bezier_point(cage.controls(2), 0.5) - bezier_point(curve, 0.65)) < 1e-12);
  // The split rounds coordinates below 128 to 2^-47 = 7e-15 a few times. The parameter is a ratio
  // of lengths that are 6 or more.
  CHECK_THAT(joint_parameter(cage, 2), Catch::WithinAbs(0.3, 1e-14));
  erase_vertex(cage, 2, joint_parameter(cage, 2));
  REQUIRE(cage.size() == 4);
  CHECK(cage.degree(1) == 3);
  for (const double t : {0.25, 0.5, 0.75})
    CHECK(std::abs(bezier_point(cage.controls(1), t) - bezier_point(curve, t)) < 1e-10);
  Cage straight = polygon_cage(shapes::rectangle(100, 60));
  insert_vertex(straight, 0, 0.3);
  erase_vertex(straight, 1, joint_parameter(straight, 1));
  CHECK(straight == polygon_cage(shapes::rectangle(100, 60)));
}

TEST_CASE("A reversed cage is the same loop, starting at the same vertex") {
  Cage cage = polygon_cage(shapes::l_shape());
  cage.segments[2].push_back({150, 130});
  const Cage back = reversed(cage);
  CHECK(back.vertex(0) == cage.vertex(0));
  CHECK(reversed(back) == cage);
  CHECK(signed_area(vertices_of(back)) == -signed_area(vertices_of(cage)));  // exact for integers
}

TEST_CASE("A self-crossing is found with its position, and a simple polygon has none") {
  CHECK_FALSE(self_crossing(shapes::l_shape()));
  CHECK_FALSE(self_crossing(shapes::comb(30)));
  const Points bow{{0, 0}, {10, 10}, {10, 0}, {0, 10}};
  const auto crossing = self_crossing(bow);
  REQUIRE(crossing);
  CHECK(crossing->first == 0);
  CHECK(crossing->second == 2);
  CHECK(std::abs(crossing->point - Complex(5, 5)) < 1e-12);
  CHECK(self_crossing(Points{{0, 0}, {10, 0}, {4, 0}, {4, 8}}));             // folds back on itself
  CHECK(self_crossing(Points{{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}}));  // touches an edge
}

TEST_CASE("Winding and turning numbers count turns") {
  const Points square = shapes::rectangle(10, 10);
  CHECK(winding_number(square, {5, 5}) == 1);
  CHECK(winding_number(square, {15, 5}) == 0);
  Points twice;
  for (int i = 0; i < 40; ++i)
    twice.push_back(std::polar(10.0 + 2 * std::cos(kPi * i / 20), 4 * kPi * i / 40));
  CHECK(winding_number(twice, {0, 0}) == 2);
  constexpr double kRounding = 1e-14;  // 40 sums below 16, each rounded to 2^-50, over 2 pi
  CHECK_THAT(turning_number(twice), Catch::WithinAbs(2, kRounding));
  CHECK_THAT(turning_number(square), Catch::WithinAbs(1, kRounding));
}

TEST_CASE("A rest cage that cannot be used is rejected with the reason") {
  const auto message = [](const Cage& cage) -> std::string {
    try {
      check_rest_cage(cage);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message(polygon_cage(shapes::l_shape())).empty());
  CHECK(message(reversed(polygon_cage(shapes::l_shape()))).empty());
  CHECK_THAT(message(polygon_cage(Points{{0, 0}, {1, 0}})), Catch::Contains("at least three"));
  CHECK_THAT(message(polygon_cage(Points{{0, 0}, {10, 10}, {10, 0}, {0, 10}})),
             Catch::Contains("(5, 5)"));
  CHECK_THAT(message(polygon_cage(Points{{0, 0}, {0, 0}, {10, 0}, {0, 10}})),
             Catch::Contains("no length"));
  CHECK_THAT(message(polygon_cage(Points{{0, 0}, {NAN, 0}, {0, 10}})),
             Catch::Contains("not a finite number"));
  // A spike that ends a few units in the last place above another edge.
  const double tip = 10 * (1 + 4e-16);
  CHECK_THAT(message(polygon_cage(
                 Points{{0, 0}, {100, 0}, {100, 90}, {60, 90}, {50, tip}, {40, 90}, {0, 90}})),
             Catch::Equals(""));
  CHECK_THAT(message(polygon_cage(Points{
                 {0, 0}, {50, 10}, {100, 0}, {100, 90}, {60, 90}, {25, 5 * (1 + 4e-16)}, {0, 90}})),
             Catch::Contains("touches itself"));
  // Needles: no mesh can represent an angle of 2e-12 radians, but nearly repeated points are fine.
  CHECK_THAT(message(polygon_cage(Points{{0, 0}, {1000, 1000}, {500, 500 + 1e-9}})),
             Catch::Contains("cusp at point 1"));
  CHECK_THAT(message(polygon_cage(Points{{3.46, 1.79}, {7.25, 1.8e-12}, {0, 0}, {0.25, 9e-13}})),
             Catch::Contains("cusp at point 3"));
  CHECK(message(polygon_cage(Points{{0, 0}, {100, 0}, {100 + 1e-9, 1e-9}, {100, 100}, {0, 100}}))
            .empty());
  Cage curved = polygon_cage(shapes::rectangle(5, 5));
  curved.segments[0] = {{0, 0}, {2, -1}, {3, 1}};
  CHECK(message(curved).empty());
  CHECK(message(shapes::curved_star(12, 4, 0.3, 5)).empty());
  curved.segments[0] = {{0, 0}, {2, 14}};
  CHECK_THAT(message(curved), Catch::Contains("segments 1 and 3 meet near ("));
  curved.segments[0] = {{0, 0}, {12, 4}, {-7, 4}};  // a loop
  CHECK_THAT(message(curved), Catch::Contains("segments 1 and 1 meet"));
  curved.segments[0] = {{0, 0}, {0, 0}, {3, 1}};
  CHECK_THAT(message(curved), Catch::Contains("tangent handle on top of its point at (0, 0)"));
  curved.segments[0] = {{0, 0}, {5, 4}, {0, 4}};  // c'(1/2) = 0
  CHECK_THAT(message(curved), Catch::Contains("cusp at (2.5, 3)"));
  // The tip of a leaf: both curves leave along the same tangent.
  Cage leaf;
  leaf.segments = {{{0, 0}, {10, 0}, {20, 10}}, {{30, 30}}, {{0, 40}, {-10, 20}, {20, 0}}};
  CHECK_THAT(message(leaf), Catch::Contains("cusp at point 1, (0, 0)"));
  curved.segments[0] = {{0, 0}, {0, 0}};
  curved.segments[1][0] = {0, 0};
  CHECK_THAT(message(curved), Catch::Contains("no length"));
}

}  // namespace holomorph::curve_test
