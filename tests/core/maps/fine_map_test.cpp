// Maps in linear pieces: within the tolerance everywhere, without gaps.
#include "core/maps/fine_map.h"

#include "core/cauchy/cauchy.h"
#include "core/mesh/locator.h"
#include "support/catch.h"
#include "support/contract_setup.h"
#include "support/seeds.h"

namespace holomorph::fine_map_test {

namespace {

Points inner_points(const Cage& cage, int count, std::mt19937& random) {
  const Box box = box_of(outline_of(cage, 16));
  Points points;
  while (static_cast<int>(points.size()) < count) {
    const Complex unit = 0.5 * (random_complex(random) + Complex(1, 1));
    const Complex z(box.left + box.width() * unit.real(), box.bottom + box.height() * unit.imag());
    if (contains(cage, z)) points.push_back(z);
  }
  return points;
}

PointValues values_of(const PointMap& map) {
  return [&map](std::span<const Complex> points) { return map.values_at(points); };
}

/// The largest distance between a map and its linear pieces at random points of the cage.
double largest_error(const FineMap& fine, const Cage& cage, const PointMap& map, int count,
                     std::mt19937& random) {
  const MeshLocator locator(fine.mesh);
  const Points points = inner_points(cage, count, random);
  const std::vector<PointMap::Value> values = map.values_at(points);
  double largest = 0;
  for (size_t i = 0; i < points.size(); ++i)
    largest =
        std::max(largest, std::abs(locator.near(points[i]).in(fine.mesh, fine.f) - values[i].f));
  return largest;
}

}  // namespace

TEST_CASE("Fine map: linear pieces are within the tolerance of every method's map") {
  size_t turn = 0;  // scripts/test takes one shape of each method
  for (const unsigned seed : seeds_of("Fine map", {1}))
    for (const Method& method : methods()) {
      const std::vector<Shape> all = shapes_for(method);
      for (const Shape shape : soaks() ? all : std::vector{all[turn++ % all.size()]}) {
        Setup s = setup(method, Precision::full, shape);
        std::mt19937 random(seed);
        for (Points& segment : s.pose.cage.segments)
          for (Complex& z : segment) z += 12.0 * random_complex(random);
        for (PosePin& pin : s.pose.pins) pin.position += 8.0 * random_complex(random);
        const auto map = method.prepare(s.rest, nullptr)->point_map(s.pose);
        REQUIRE(map);
        if (map->is_linear_in_triangles()) continue;
        INFO(method.id << ", seed " << seed << ", shape " << static_cast<int>(shape));
        constexpr double kTolerance = 0.01;
        const FineMap fine =
            fine_map(s.rest.cage, *s.rest.mesh, kTolerance, values_of(*map), map->is_piecewise());
        CHECK(largest_error(fine, s.rest.cage, *map, few_or_many(40, 400), random) <= kTolerance);
        // At corners, the derivative of an angle map may be infinite.
        if (method.id != "angles") CHECK(fine.error <= kTolerance);
      }
    }
}

TEST_CASE("Point maps: many points at once give the same values as one at a time") {
  for (const Method& method : methods())
    for (const Shape shape : shapes_for(method)) {
      const Setup s = setup(method, Precision::full, shape);
      const auto deformer = method.prepare(s.rest, nullptr);
      const auto map = deformer->point_map(s.pose);
      REQUIRE(map);
      INFO(method.id << ", shape " << static_cast<int>(shape));
      std::mt19937 random(1);
      Points points = inner_points(s.rest.cage, 10, random);
      points.push_back(s.rest.cage.vertex(1));
      const std::vector<PointMap::Value> values = map->values_at(points);
      for (size_t i = 0; i < points.size(); ++i) {
        const PointMap::Value one = map->at(points[i]);
        CHECK(std::abs(values[i].f - one.f) <= 1e-10);
        CHECK(std::abs(values[i].fz - one.fz) <= 1e-9 * std::abs(one.fz));
        CHECK(std::abs(values[i].fzbar - one.fzbar) <= 1e-9 * std::abs(one.fz));
      }
      // At the mesh's vertices, the point map is the map.
      const SampledMap sampled = deformer->deform(s.pose, {});
      const std::vector<PointMap::Value> at_vertices = map->values_at(s.rest.samples);
      for (size_t v = 0; v < at_vertices.size(); v += 7)
        CHECK(std::abs(at_vertices[v].f - sampled.f[static_cast<Index>(v)]) <= 1e-6);
    }
}

TEST_CASE("Fine map: pieces fill the cage, and each edge inside belongs to two of them") {
  for (const Shape shape : {Shape::straight, Shape::curved, Shape::holes}) {
    const Setup s = setup(method_named("cage"), Precision::full, shape);
    const auto map = method_named("cage").prepare(s.rest, nullptr)->point_map(s.pose);
    constexpr double kTolerance = 0.01;
    const FineMap fine = fine_map(s.rest.cage, *s.rest.mesh, kTolerance, values_of(*map));
    double area = 0;
    for (const auto& [a, b, c] : fine.mesh.triangles) {
      const Points& z = fine.mesh.vertices;
      const double doubled = cross(z[b] - z[a], z[c] - z[a]);
      CHECK(doubled > -1e-9);
      area += 0.5 * doubled;
    }
    const FlatCage outline = flattened(s.rest.cage);
    CHECK(std::abs(area - area_of(outline)) <= kTolerance * perimeter(outline));
    // The boundary's loops enclose the same area as the triangles, at rest and posed.
    const Loops loops = fine.mesh.boundary_loops();
    CHECK(loops.count() == s.rest.cage.loops().count());
    for (const Points& at : {fine.mesh.vertices, fine.f}) {
      double around = 0, sum = 0;
      for (size_t i = 0; i < fine.mesh.boundary.size(); ++i)
        around += 0.5 * cross(at[fine.mesh.boundary[i]],
                              at[fine.mesh.boundary[loops.next(static_cast<Index>(i))]]);
      for (const auto& [a, b, c] : fine.mesh.triangles)
        sum += 0.5 * cross(at[b] - at[a], at[c] - at[a]);
      CHECK(around == Approx(sum).epsilon(1e-12));
    }
  }
}

TEST_CASE("Fine map: the number of evaluations depends little on the tolerance") {
  const Setup s = setup(method_named("cage"), Precision::full);
  const auto map = method_named("cage").prepare(s.rest, nullptr)->point_map(s.pose);
  const FineMap coarse = fine_map(s.rest.cage, *s.rest.mesh, 0.1, values_of(*map)),
                fine = fine_map(s.rest.cage, *s.rest.mesh, 1e-3, values_of(*map));
  CHECK(fine.mesh.triangles.size() > 20 * coarse.mesh.triangles.size());
  CHECK(fine.evaluations < 5 * coarse.evaluations);
}

TEST_CASE("Fine map: a map that is not finite somewhere loses only the triangles there") {
  class Broken final : public PointMap {
   public:
    Value at(Complex z) const override {
      if (std::abs(z - Complex(50, 50)) < 15) return {Complex(NAN, NAN), 1, 0};
      return {z, 1, 0};
    }
  } map;
  const Setup s = setup(method_named("cage"), Precision::full);
  const FineMap fine = fine_map(s.rest.cage, *s.rest.mesh, 0.01, values_of(map));
  double area = 0;
  for (const auto& [a, b, c] : fine.mesh.triangles) {
    for (const int v : {a, b, c}) CHECK(is_finite(fine.f[v]));
    const Points& z = fine.mesh.vertices;
    area += 0.5 * cross(z[b] - z[a], z[c] - z[a]);
  }
  CHECK(area < 30000 - 500);
  CHECK(area > 30000 - 3000);
}

TEST_CASE("Mesh locator: it agrees with the search through all triangles") {
  for (const unsigned seed : seeds_of("Mesh locator", {1, 2, 3}))
    for (const Shape shape : {Shape::straight, Shape::curved, Shape::holes}) {
      const Cage cage = cage_of(shape);
      const Mesh mesh = domain_mesh(cage, {400});
      const MeshLocator locator(mesh);
      std::mt19937 random(seed);
      Points points = mesh.vertices;
      for (int i = 0; i < 500; ++i)
        points.push_back(Complex(100, 100) + 140.0 * random_complex(random));
      for (const Complex& z : points) {
        const auto expected = locate(mesh, mesh.vertices, z), found = locator.at(z);
        REQUIRE(found.has_value() == expected.has_value());
        if (found) CHECK(found->triangle == expected->triangle);
        CHECK(locator.near(z).triangle == locate_near(mesh, z).triangle);
      }
    }
}

}  // namespace holomorph::fine_map_test
