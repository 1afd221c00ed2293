// Cages with few vertices around a shape.
#include "core/geometry/simplify.h"

#include <random>

#include "core/geometry/orientation.h"
#include "core/geometry/polyline.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::simplify_test {

namespace {

/// Each edge divided into equal parts.
Points divided(const Points& polygon, int parts) {
  Points result;
  for (size_t i = 0; i < polygon.size(); ++i)
    for (int k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      result.push_back((1 - t) * polygon[i] + t * polygon[(i + 1) % polygon.size()]);
    }
  return result;
}

/// A circle with a rough edge.
Points rough_circle(int vertices, double roughness, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Points polygon;
  for (int k = 0; k < vertices; ++k)
    polygon.push_back(std::polar(100 * (1 + roughness * unit(random)), 2 * kPi * k / vertices));
  return polygon;
}

}  // namespace

TEST_CASE("Thinned cages: vertices on straight edges vanish, and nothing else at tolerance 0") {
  for (const unsigned seed : seeds_of("thinned cages", {1, 2, 3})) {
    std::mt19937 random(seed);
    const Points star = shapes::star(5 + static_cast<int>(random() % 20), 0.5, seed);
    const Cage cage = polygon_cage(star);
    CHECK(thinned_around(cage, 0) == cage);
    for (const int parts : {2, 3, 16}) {
      const Cage thinned = thinned_around(polygon_cage(divided(star, parts)), 0);
      CHECK(thinned == cage);
    }
  }
}

TEST_CASE("Thinned cages: they surround the shape, within the tolerance, and are simple") {
  for (const unsigned seed : seeds_of("thin and near", {1, 2, 3, 4})) {
    std::mt19937 random(seed);
    const Points polygon = rough_circle(150 + static_cast<int>(random() % 300), 0.001, random);
    Cage cage = polygon_cage(polygon);
    add_hole(cage, polygon_cage(divided(Points{{-10, -10}, {10, -10}, {0, 12}}, 4)).segments);
    const double tolerance = 0.002 * box_of(polygon).diagonal();
    const Cage thinned = thinned_around(cage, tolerance);
    INFO("seed " << seed << ": " << polygon.size() << " vertices, " << thinned.size());
    CHECK_FALSE(self_crossing(vertices_of(loop_of(thinned, 0))));
    CHECK(thinned.size() < cage.size() / 2);
    REQUIRE(thinned.starts.size() == 1);
    CHECK(thinned.loops().length(1) == 3);
    CHECK(Orientation(thinned).is_oriented());
    const Points outer = vertices_of(loop_of(thinned, 0));
    const Polyline far(outer, true), near(polygon, true);
    CHECK(one_sided_distance(far, near) <= tolerance);
    CHECK(one_sided_distance(near, far) <= tolerance);
    const Points dense = divided(polygon, 5);
    for (const Complex& z : dense)
      CHECK((winding_number(outer, z) == 1 || far.nearest(z).distance < 1e-9));
  }
}

TEST_CASE("Thinned cages: curved cages stay as they are") {
  Cage cage = polygon_cage(shapes::rectangle(200, 100));
  cage.segments[0] = {cage.segments[0][0], {70, -30}, {140, -30}};
  CHECK(thinned_around(cage, 10) == cage);
}

}  // namespace holomorph::simplify_test
