// A map that is continued outside its mesh: the same inside, continuous, with its true derivatives,
// and finite everywhere.
#include "core/maps/continued_map.h"

#include "support/catch.h"
#include "support/contract_setup.h"
#include "support/seeds.h"

namespace holomorph::continued_map_test {

namespace {

/// A posed method and its map, continued.
struct Continued {
  Setup s;
  std::unique_ptr<Deformer> deformer;
  std::unique_ptr<PointMap> inside;
  std::unique_ptr<ContinuedMap> map;

  Continued(const Method& method, Shape shape, double bend, std::mt19937& random)
      : s(setup(method, Precision::full, shape)) {
    for (Points& segment : s.pose.cage.segments)
      for (Complex& z : segment) z += bend * random_complex(random);
    for (PosePin& pin : s.pose.pins) pin.position += bend * random_complex(random);
    deformer = method.prepare(s.rest, nullptr);
    inside = deformer->point_map(s.pose);
    Points vertices = s.rest.mesh->vertices;
    VectorXc f(static_cast<Index>(vertices.size()));
    const auto values = inside->values_at(vertices);
    for (size_t i = 0; i < values.size(); ++i) f[static_cast<Index>(i)] = values[i].f;
    map = std::make_unique<ContinuedMap>(s.rest.mesh, f, *inside);
  }
};

Points points_around(const Mesh& mesh, int count, std::mt19937& random) {
  const Box box = box_of(mesh.vertices);
  Points points;
  for (int i = 0; i < count; ++i)
    points.push_back(box.center() + 0.8 * box.diagonal() * random_complex(random));
  return points;
}

}  // namespace

TEST_CASE("Continued maps: inside they are the map, and everywhere finite") {
  for (const unsigned seed : seeds_of("continued maps", {1}))
    for (const Method& method : methods())
      for (const Shape shape : shapes_for(method)) {
        INFO(method.id << ", seed " << seed << ", shape " << static_cast<int>(shape));
        std::mt19937 random(seed);
        const Continued c(method, shape, 10, random);
        const MeshLocator locator(*c.s.rest.mesh);
        const Points points = points_around(*c.s.rest.mesh, few_or_many(80, 300), random);
        const auto values = c.map->values_at(points);
        int inside = 0, outside = 0;
        for (size_t i = 0; i < points.size(); ++i) {
          CHECK(is_finite(values[i].f));
          CHECK(is_finite(values[i].fz));
          CHECK(is_finite(values[i].fzbar));
          if (!locator.at(points[i])) {
            ++outside;
            continue;
          }
          ++inside;
          CHECK(std::abs(values[i].f - c.inside->at(points[i]).f) < 1e-9);
        }
        CHECK(inside > 5);
        CHECK(outside > 5);
      }
}

TEST_CASE("Continued maps are continuous at the boundary") {
  for (const unsigned seed : seeds_of("continued maps at the boundary", {1}))
    for (const Method& method : methods())
      for (const Shape shape : shapes_for(method)) {
        INFO(method.id << ", seed " << seed << ", shape " << static_cast<int>(shape));
        std::mt19937 random(seed);
        const Continued c(method, shape, 10, random);
        const Mesh& mesh = *c.s.rest.mesh;
        const Loops loops = mesh.boundary_loops();
        const double size = box_of(mesh.vertices).diagonal();
        for (int k = 0; k < 60; ++k) {
          const auto i = static_cast<Index>(random() % mesh.boundary.size());
          const auto at = [&](Index n) {
            return mesh.vertices[static_cast<size_t>(mesh.boundary[static_cast<size_t>(n)])];
          };
          const Complex a = at(i), along = at(loops.next(i)) - a;
          const double t = 0.2 + 0.6 * static_cast<double>(random() % 1000) / 1000;
          const Complex z = a + t * along, out = -kI * along / std::abs(along);
          const double step = 1e-7 * size;
          CHECK(std::abs(c.map->at(z + step * out).f - c.map->at(z - step * out).f) < 1e-4 * size);
        }
      }
}

TEST_CASE("Continued maps have the derivatives of their values") {
  for (const unsigned seed : seeds_of("derivatives of continued maps", {1})) {
    std::mt19937 random(seed);
    const Method& method = method_named("mean_value");
    CAPTURE(seed);
    const Continued c(method, Shape::straight, 10, random);
    const Mesh& mesh = *c.s.rest.mesh;
    const double size = box_of(mesh.vertices).diagonal(), h = 1e-6 * size;
    int compared = 0;
    for (const Complex& z : points_around(mesh, 200, random)) {
      const auto at = [&](Complex by) { return c.map->at(z + h * by).f; };
      const Complex fx = (at(1) - at(-1)) / (2 * h), fy = (at(kI) - at(-kI)) / (2 * h);
      const Complex fxx = (at(1) + at(-1) - 2.0 * at(0)) / h,
                    fyy = (at(kI) + at(-kI) - 2.0 * at(0)) / h;
      if (std::abs(fxx) + std::abs(fyy) > 1e-4) continue;  // the nearest edge changes here
      const PointMap::Value value = c.map->at(z);
      CHECK(std::abs(0.5 * (fx - kI * fy) - value.fz) < 1e-3);
      CHECK(std::abs(0.5 * (fx + kI * fy) - value.fzbar) < 1e-3);
      ++compared;
    }
    CHECK(compared > 100);
  }
}

TEST_CASE("Continued motions are the same motions everywhere") {
  std::mt19937 random(5);
  Continued c(method_named("mean_value"), Shape::straight, 0, random);
  const Complex turn = std::polar(1.3, 0.7);
  c.s.pose.cage = c.s.rest.cage;
  for (Points& segment : c.s.pose.cage.segments)
    for (Complex& z : segment) z = turn * z + Complex(20, -5);
  c.inside = c.deformer->point_map(c.s.pose);
  VectorXc f(static_cast<Index>(c.s.rest.mesh->vertices.size()));
  for (Index i = 0; i < f.size(); ++i)
    f[i] = turn * c.s.rest.mesh->vertices[static_cast<size_t>(i)] + Complex(20, -5);
  const ContinuedMap map(c.s.rest.mesh, f, *c.inside);
  for (const Complex& z : points_around(*c.s.rest.mesh, 300, random)) {
    const PointMap::Value value = map.at(z);
    CHECK(std::abs(value.f - (turn * z + Complex(20, -5))) < 1e-8);
    CHECK(std::abs(value.fz - turn) < 1e-6);
    CHECK(std::abs(value.fzbar) < 1e-6);
  }
}

}  // namespace holomorph::continued_map_test
