// The domain mesh is a partition of the polygon, whatever the polygon.
#include "core/mesh/mesh.h"

#include <set>

#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "core/geometry/orientation.h"
#include "core/mesh/mesher.h"
#include "core/mesh/subdivided.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::mesh_test {

namespace {

double triangle_area(const Mesh& mesh, const Triangle& t) {
  return 0.5 * cross(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                     mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

/// The properties of every mesh of a polygon: positive triangles whose areas sum to the polygon's,
/// one closed boundary with the polygon's length, every cage vertex among the vertices, and Euler's
/// formula.
void check_partition(const Points& polygon, const Mesh& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    CHECK(triangle_area(mesh, t) > 0);
    area += triangle_area(mesh, t);
  }
  CHECK(area == Approx(std::abs(signed_area(polygon))).epsilon(1e-9));
  Points boundary;
  for (const int v : mesh.boundary) boundary.push_back(mesh.vertices[v]);
  CHECK(perimeter(boundary) == Approx(perimeter(polygon)).epsilon(1e-9));
  CHECK(signed_area(boundary) == Approx(area).epsilon(1e-9));
  REQUIRE(mesh.cage_vertices.size() == polygon.size());
  for (size_t i = 0; i < polygon.size(); ++i)
    CHECK(mesh.vertices[mesh.cage_vertices[i]] == polygon[i]);
  std::set<std::pair<int, int>> edges;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  CHECK(static_cast<long>(mesh.vertices.size()) - static_cast<long>(edges.size()) +
            static_cast<long>(mesh.triangles.size()) ==
        1);
}

void check_partition(const Points& polygon, const MeshOptions& options) {
  const Mesh mesh = domain_mesh(polygon, options);
  check_partition(polygon, mesh);
  CHECK(mesh.vertices.size() <= static_cast<size_t>(3 * options.vertices + 4 * polygon.size()));
}

}  // namespace

TEST_CASE("The domain mesh partitions ordinary polygons with about the target number of vertices") {
  for (const Points& polygon : {shapes::rectangle(300, 200), shapes::l_shape(),
                                shapes::star(32, 0.2, 3), shapes::star(100, 0.05, 4)}) {
    check_partition(polygon, {4000});
    const size_t count = domain_mesh(polygon, {4000}).vertices.size();
    CHECK(count > 2600);
    CHECK(count < 5600);
  }
}

TEST_CASE(
    "A subdivided mesh partitions the polygon, and its triangles lie in those of the whole mesh") {
  for (const Points& polygon : {shapes::l_shape(), shapes::star(32, 0.2, 3)})
    for (const int pieces : {1, 2, 3, 5}) {
      const Mesh whole = domain_mesh(polygon, {300}), mesh = subdivided(whole, pieces);
      check_partition(polygon, mesh);
      CHECK(mesh.triangles.size() == static_cast<size_t>(pieces * pieces) * whole.triangles.size());
      for (const Triangle& t : mesh.triangles) {
        Complex center = 0;
        for (const int v : t) center += mesh.vertices[v] / 3.0;
        const auto around = locate(whole, whole.vertices, center);
        REQUIRE(around);
        for (const int v : t) {
          const auto at = location_in(whole, whole.vertices, around->triangle,
                                      center + (1 - 1e-9) * (mesh.vertices[v] - center));
          CHECK(at);
        }
      }
    }
  // Holes and parts keep their loops.
  Cage cage = polygon_cage(shapes::rectangle(300, 200));
  add_hole(cage, polygon_cage(Points{{100, 50}, {200, 50}, {150, 150}}).segments);
  const Mesh whole = domain_mesh(cage, {300}), mesh = subdivided(whole, 3);
  REQUIRE(mesh.starts.size() == 1);
  CHECK(mesh.boundary.size() == 3 * whole.boundary.size());
  CHECK(mesh.starts[0] == 3 * whole.starts[0]);
  CHECK(mesh.vertices[mesh.boundary[static_cast<size_t>(mesh.starts[0])]] ==
        whole.vertices[whole.boundary[static_cast<size_t>(whole.starts[0])]]);
  const Mesh two = joined(std::vector<Mesh>{whole, domain_mesh(shapes::star(9, 0.3, 2), {200})});
  CHECK(part_count(subdivided(two, 2)) == 2);
  CHECK(subdivided(two, 2).triangles.size() == 4 * two.triangles.size());
}

TEST_CASE("A caller's own triangles give the same mesh as the mesher's") {
  const Cage cage = oriented(shapes::curved_star(7, 3, 0.1, 5));
  const Mesh made = domain_mesh(cage, {600});
  std::vector<Triangle> turned = made.triangles;
  for (size_t i = 0; i < turned.size(); i += 2) std::swap(turned[i][0], turned[i][1]);
  Points near = made.vertices;
  for (const int v : made.cage_vertices) near[static_cast<size_t>(v)] += 1e-11 * kI;
  const Mesh own = mesh_of(cage, near, turned);
  CHECK(own.cage_vertices == made.cage_vertices);
  CHECK(own.vertices == made.vertices);
  CHECK(std::is_permutation(own.boundary.begin(), own.boundary.end(), made.boundary.begin(),
                            made.boundary.end()));
  for (const Triangle& t : own.triangles) CHECK(triangle_area(own, t) > 0);
}

TEST_CASE("Triangles that do not fill the cage are rejected, and the message says why") {
  const Cage cage = polygon_cage(shapes::rectangle(4, 3));
  const Points corners = vertices_of(cage);
  const std::vector<Triangle> halves = {{0, 1, 2}, {0, 2, 3}};
  CHECK(mesh_of(cage, corners, halves).triangles.size() == 2);
  const auto refused = [&](const Points& vertices, const std::vector<Triangle>& triangles,
                           const std::string& why) {
    INFO(why);
    CHECK_THROWS_WITH(mesh_of(cage, vertices, triangles), Catch::Contains(why));
  };
  const auto with = [&](size_t i, Complex z) {
    Points moved = corners;
    moved[i] = z;
    return moved;
  };
  refused(corners, {}, "no triangles");
  refused(corners, {{0, 1, 2}}, "several parts");  // a vertex without a triangle
  refused(corners, {{0, 1, 2}, {0, 2, 4}}, "does not exist");
  refused(corners, {{0, 1, 2}, {0, 2, -1}}, "does not exist");
  refused(corners, {{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}, "more than two triangles");
  refused(with(2, {NAN, 0}), halves, "not finite");
  refused(with(2, corners[2] + 0.01), halves, "cage vertex (4, 3)");
  Points outside = corners;
  outside.push_back(corners[1] + 2.0);
  refused(outside, {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}}, "not on the cage");
  Points twice = corners;
  twice.push_back(0.5 * (corners[0] + corners[2]));
  refused(twice, {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}}, "more than two triangles");
  refused(twice, {{0, 1, 2}, {0, 4, 3}, {4, 2, 3}, {0, 2, 4}}, "flat");
  Cage round = cage;  // its chords cut off the bulges
  for (Index i = 0; i < round.size(); ++i)
    round.segments[i].push_back(1.4 * (round.vertex(i) + round.end_vertex(i)) / 2.0 -
                                0.4 * Complex(2, 1.5));
  CHECK_THROWS_WITH(mesh_of(round, corners, halves), Catch::Contains("do not fill"));
}

TEST_CASE("Both orientations of a polygon give counter-clockwise triangles") {
  Points polygon = shapes::l_shape();
  std::reverse(polygon.begin(), polygon.end());
  check_partition(polygon, {1000});
}

TEST_CASE("The domain mesh partitions slivers, combs, collinear and nearly repeated vertices") {
  const MeshOptions options{1500};
  check_partition({{0, 0}, {1000, 0}, {1000, 0.5}, {0, 0.4}}, options);    // sliver
  check_partition({{0, 0}, {1000, 1000}, {500, 500.001}}, options);        // along the diagonal
  check_partition({{0, 0}, {500, 1e-3}, {1000, 0}, {500, 300}}, options);  // almost collinear
  check_partition({{0, 0}, {250, 0}, {500, 0}, {750, 0}, {1000, 0}, {500, 300}}, options);
  check_partition({{0, 0}, {100, 0}, {100 + 1e-9, 1e-9}, {100, 100}, {0, 100}}, options);
  check_partition({{0, 0}, {100, 0}, {100, 1e-7}, {100, 2e-7}, {100, 100}, {0, 100}}, options);
  check_partition({{0, 0}, {100, 50}, {0, 1}, {-100, 50}}, options);  // needle notch
  check_partition(shapes::comb(40), options);
  check_partition(shapes::star(500, 0.02, 8), options);
  check_partition({{1e6, 1e6}, {1e6 + 10, 1e6}, {1e6 + 5, 1e6 + 8}},
                  options);                                                // far from the origin
  check_partition({{0, 0}, {1e-3, 0}, {1e-3, 1e-3}, {0, 1e-3}}, options);  // tiny
  for (unsigned seed = 1; seed <= 12; ++seed)
    check_partition(shapes::star(4 + 20 * static_cast<int>(seed), 0.6, seed), options);
}

TEST_CASE("The mesh of a curved cage follows its curves, with positive triangles") {
  for (unsigned seed = 1; seed <= 5; ++seed)
    for (const int degree : {2, 3, 6}) {
      Cage cage = shapes::curved_star(3 + 2 * static_cast<int>(seed), degree, 0.3, seed);
      if (seed % 2) cage = reversed(cage);
      const Mesh mesh = domain_mesh(cage, {400});
      double area = 0;
      for (const Triangle& t : mesh.triangles) {
        CHECK(triangle_area(mesh, t) > 0);
        area += triangle_area(mesh, t);
      }
      CHECK(area == Approx(std::abs(signed_area(outline_of(cage, 400))))
                        .epsilon(3e-4));  // sagitta times perimeter
      REQUIRE(mesh.cage_vertices.size() == static_cast<size_t>(cage.size()));
      for (Index e = 0; e < cage.size(); ++e)
        CHECK(mesh.vertices[mesh.cage_vertices[e]] == cage.vertex(e));
      const Polygon outline = outline_of(cage, few_or_many(500, 2000));
      std::set<int> boundary(mesh.boundary.begin(), mesh.boundary.end());
      for (size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (v % 5 == 0) CHECK(contains(cage, mesh.vertices[v]));
        if (boundary.contains(static_cast<int>(v)))
          CHECK(nearest_on_polygon(outline, mesh.vertices[v]).distance < 1e-3);  // its sagitta
      }
    }
}

TEST_CASE("A point is located with its weights, in the top triangle where the mesh overlaps") {
  const Mesh mesh = domain_mesh(shapes::l_shape(), {500});
  const Complex z{57.3, 148.1};
  const auto found = locate(mesh, mesh.vertices, z);
  REQUIRE(found);
  CHECK(std::abs(found->in(mesh, mesh.vertices) - z) < 1e-10);
  CHECK_FALSE(locate(mesh, mesh.vertices, {150, 150}));
  Points mirrored = mesh.vertices;
  for (Complex& v : mirrored) v = std::conj(v);
  CHECK(locate(mesh, mirrored, std::conj(z)));
}

TEST_CASE("Derivative samples differ from the mesh vertices only at cage vertices") {
  const Mesh mesh = domain_mesh(shapes::l_shape(), {500});
  const Points samples = derivative_samples(mesh);
  size_t moved = 0;
  for (size_t i = 0; i < samples.size(); ++i) moved += samples[i] != mesh.vertices[i];
  CHECK(moved == 6);
  for (const int v : mesh.cage_vertices) CHECK(winding_number(shapes::l_shape(), samples[v]) == 1);
}

TEST_CASE("A graded mesh has the edges that are asked for, or is coarser by one factor") {
  for (const unsigned seed : seeds_of("graded meshes", {1, 2})) {
    std::mt19937 random(seed);
    const Cage cage = polygon_cage(shapes::star(9, 0.25, seed));
    const double size = box_of(outline_of(cage)).diagonal();
    const Complex fine = Complex(200, 200) + 60.0 * random_complex(random);
    const auto length_at = [&](Complex z) {
      return 0.008 * size + 0.1 * std::abs(z - fine);  // does not grow too fast
    };
    double coarser = 0;
    for (const int most : {100000, 400}) {
      const Mesh mesh = graded_mesh(cage, length_at, most);
      double sum = 0, shortest = HUGE_VAL, longest = 0;
      int count = 0;
      const std::vector<char> outer = boundary_marks(mesh);
      for (const Triangle& t : mesh.triangles) {
        CHECK(triangle_area(mesh, t) > 0);
        for (int k = 0; k < 3; ++k) {
          const int a = t[static_cast<size_t>((k + 1) % 3)],
                    b = t[static_cast<size_t>((k + 2) % 3)];
          if (outer[static_cast<size_t>(a)] || outer[static_cast<size_t>(b)]) continue;
          const Complex from = mesh.vertices[static_cast<size_t>(a)],
                        to = mesh.vertices[static_cast<size_t>(b)];
          const double ratio = std::abs(to - from) / length_at(0.5 * (from + to));
          sum += std::log(ratio), ++count;
          shortest = std::min(shortest, ratio);
          longest = std::max(longest, ratio);
        }
      }
      REQUIRE(count > 50);
      const double mean = std::exp(sum / count);
      CAPTURE(seed, most, mesh.vertices.size(), mean, shortest, longest);
      CHECK(longest / shortest < 12);
      if (most == 400) {
        CHECK(mesh.vertices.size() < 600);
        CHECK(mean > 1.3 * coarser);
      } else {
        CHECK(mean > 0.5);
        CHECK(mean < 1.3);
        coarser = mean;
      }
    }
  }
}

TEST_CASE("A polygon that cannot be a cage is rejected") {
  CHECK_THROWS_AS(domain_mesh(Points{{0, 0}, {10, 10}, {10, 0}, {0, 10}}), Error);
  CHECK_THROWS_AS(domain_mesh(Points{{0, 0}, {10, 10}, {20, 20}}), Error);
}

TEST_CASE("A needle between edges that nearly touch is meshed or rejected") {
  // Found by fuzzing: CGAL's invariants break between such edges.
  const std::vector<Points> needles = {{{-6130.000000003725, -9778.000000476837},
                                        {-3337.984375, -64803.984375},
                                        {-64765.984375, -64765.984375},
                                        {-64765.984375, -64765.99998474121},
                                        {-64765.99999999907, -14590.000000003725},
                                        {-1.999755859375, -1.999755859375}},
                                       {{-64765.99999999907, 47630.000000003725},
                                        {-64765.984375, -64765.984375},
                                        {-64765.984375, -64733.984375},
                                        {-52992.00001525879, -52944.00001525879},
                                        {-52944.00001525879, -52944.00001525879},
                                        {17200.015625, -64953.984375}},
                                       {{1.00390625, -7.275957614183426e-12},
                                        {10239.999999999993, -2296.9998779296875},
                                        {190.99999999999272, 28.999999999068677},
                                        {-2296.99951171875, -255.9998779296875},
                                        {-0.9921875, -32256.999877929688},
                                        {-0.9921875, -32256.99999809265}}};
  for (const Points& polygon : needles) {
    std::optional<Mesh> mesh;
    try {
      mesh = domain_mesh(polygon, {120});
    } catch (const Error& error) {
      CHECK_THAT(error.what(), Catch::Contains("touches itself"));
    }
    if (!mesh) continue;
    double area = 0;
    for (const Triangle& t : mesh->triangles) {
      CHECK(triangle_area(*mesh, t) > 0);
      area += triangle_area(*mesh, t);
    }
    CHECK(area == Approx(std::abs(signed_area(polygon))).epsilon(1e-8));
  }
}

}  // namespace holomorph::mesh_test
