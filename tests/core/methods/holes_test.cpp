// Cages with holes: what is valid, meshes and inverses in them, and the maps of all methods that
// allow them on rings and on domains with two unequal holes.
#include <random>

#include "core/cauchy/boundary_basis.h"
#include "core/cauchy/cauchy.h"
#include "core/cauchy/quadrature.h"
#include "core/error.h"
#include "core/geometry/orientation.h"
#include "core/isometric/isometric_space.h"
#include "core/maps/injectivity.h"
#include "core/maps/inverse.h"
#include "core/mesh/hole_loops.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/complaint.h"
#include "support/contract_setup.h"
#include "support/seeds.h"

namespace holomorph::holes_test {

namespace {

Points circle(int corners, Complex center, double radius) {
  Points polygon;
  for (int i = 0; i < corners; ++i)
    polygon.push_back(center + std::polar(radius, 2 * kPi * i / corners));
  return polygon;
}

/// A circle of four cubics, accurate to 3e-4 of its radius.
Cage round_loop(double radius) {
  constexpr double kArm = 0.5522847498;
  Cage cage;
  for (int k = 0; k < 4; ++k) {
    const Complex z = std::polar(radius, kPi / 2 * k);
    cage.segments.push_back({z, z * (1.0 + kArm * kI), kI * z * (1.0 - kArm * kI)});
  }
  return cage;
}

Cage with_holes(const Points& outer, const std::vector<Points>& holes) {
  Cage cage = polygon_cage(outer);
  for (const Points& hole : holes) add_hole(cage, polygon_cage(hole).segments);
  return cage;
}

Cage ring() {
  return with_holes(circle(16, {100, 100}, 100), {circle(9, {105, 95}, 45)});
}

/// A convex-ish domain with one to three holes in random places and of random shapes.
Cage random_domain(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto blob = [&](Complex center, double radius, int corners) {
    Points polygon;
    const double turn = unit(random);
    for (int i = 0; i < corners; ++i)
      polygon.push_back(
          center + std::polar(radius * (0.7 + 0.3 * unit(random)), 2 * kPi * (i + turn) / corners));
    if (unit(random) < 0.5) std::ranges::reverse(polygon);
    return polygon;
  };
  Cage cage = polygon_cage(blob({200, 200}, 200, 9 + static_cast<int>(8 * unit(random))));
  const int count = 1 + static_cast<int>(3 * unit(random));
  for (int tries = 0; tries < 200 && static_cast<int>(cage.starts.size()) < count; ++tries) {
    Cage more = cage;
    add_hole(more, polygon_cage(blob({60 + 280 * unit(random), 60 + 280 * unit(random)},
                                     8 + 50 * unit(random), 3 + static_cast<int>(6 * unit(random))))
                       .segments);
    // Leave some room between the loops.
    bool roomy = !rest_fault(more);
    const Polygon outline = outline_of(more);
    const PolygonView loops = outline;
    for (Index l = 0; roomy && l + 1 < loops.loops().count(); ++l)
      for (const Complex& z : loops.loop(loops.loops().count() - 1))
        roomy = roomy && nearest_on_polygon(loops.loop(l), z).distance > 8;
    if (roomy) cage = std::move(more);
  }
  return cage;
}

Rest rest_for(const Cage& cage, Precision precision, int vertices) {
  Rest rest;
  rest.cage = cage;
  rest.precision = precision;
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(cage, {vertices}));
  rest.samples = rest.mesh->vertices;
  return rest;
}

/// The largest difference between f along a mesh edge and the integral of its derivatives.
double largest_seam(const Mesh& mesh, const VectorXc& f, const PointMap& map) {
  const std::vector<char> outer = boundary_marks(mesh);
  const GaussRule& rule = gauss_rule(8);
  std::vector<std::pair<int, int>> edges;
  for (const Triangle& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k)
      if (const int a = t[k], b = t[(k + 1) % 3];
          a < b && !outer[static_cast<size_t>(a)] && !outer[static_cast<size_t>(b)])
        edges.emplace_back(a, b);
  const auto along = [&](const auto& edge) {
    return mesh.vertices[static_cast<size_t>(edge.second)] -
           mesh.vertices[static_cast<size_t>(edge.first)];
  };
  Points nodes;
  for (const auto& edge : edges)
    for (const double at : rule.nodes)
      nodes.push_back(mesh.vertices[static_cast<size_t>(edge.first)] + at * along(edge));
  const std::vector<PointMap::Value> values = map.values_at(nodes);
  double worst = 0;
  for (size_t e = 0; e < edges.size(); ++e) {
    const Complex by = along(edges[e]);
    Complex sum = f[edges[e].first] - f[edges[e].second];
    for (size_t g = 0; g < rule.nodes.size(); ++g) {
      const PointMap::Value& at = values[e * rule.nodes.size() + g];
      sum += rule.weights[g] * (at.fz * by + at.fzbar * std::conj(by));
    }
    worst = std::max(worst, std::abs(sum));
  }
  return worst;
}

}  // namespace

TEST_CASE("Holes: a cage with holes is valid only if they lie inside and apart") {
  const Points outer = shapes::rectangle(200, 100), hole{{20, 20}, {60, 20}, {40, 60}};
  const auto message = [&](const std::vector<Points>& holes) {
    return error_message_of([&] { check_rest_cage(with_holes(outer, holes)); });
  };
  const auto moved = [](Points loop, Complex by) {
    for (Complex& z : loop) z += by;
    return loop;
  };
  using Catch::Contains;
  CHECK(message({hole}).empty());
  CHECK(message({hole, moved(hole, 100)}).empty());
  CHECK_THAT(message({moved(hole, {300, 0})}), Contains("hole 1 lies outside"));
  CHECK_THAT(message({moved(hole, {-30, 0})}), Contains("hole 1 crosses the outer loop"));
  CHECK_THAT(message({hole, moved(hole, {10, 5})}), Contains("holes 1 and 2"));
  CHECK_THAT(message({{{20, 10}, {120, 10}, {70, 90}}, {{60, 20}, {80, 20}, {70, 40}}}),
             Contains("hole 2 lies inside hole 1"));
  CHECK_THAT(message({{{60, 20}, {80, 20}, {70, 40}}, {{20, 10}, {120, 10}, {70, 90}}}),
             Contains("hole 1 lies inside hole 2"));
  CHECK_THAT(message({{{20, 20}, {60, 60}, {60, 20}, {20, 60}}}), Contains("crosses itself"));
  CHECK_THAT(message({{{20, 20}, {60, 20}}}), Contains("hole 1") && Contains("at least three"));
  CHECK_THAT(message({moved(hole, {0, -20})}), Contains("segments"));  // touches the edge
}

TEST_CASE("Holes: inserting and erasing vertices keeps the loops") {
  Cage cage = ring();
  const Cage before = cage;
  insert_vertex(cage, 15, 0.5);  // the last segment of the outer loop
  CHECK(cage.starts == std::vector<Index>{17});
  CHECK(cage.next(16) == 0);
  insert_vertex(cage, 17, 0.5);
  CHECK(cage.starts == std::vector<Index>{17});
  CHECK(std::abs(cage.vertex(18) - 0.5 * (before.vertex(16) + before.vertex(17))) < 1e-12);
  erase_vertex(cage, 18, 0.5);
  erase_vertex(cage, 16, 0.5);
  CHECK(cage == before);
  erase_vertex(cage, 16, 0.5);  // the first vertex of the hole
  CHECK(cage.starts == std::vector<Index>{16});
  CHECK(cage.vertex(16) == before.vertex(17));
  erase_hole(cage, 1);
  CHECK(cage == loop_of(before, 0));
  const Cage turned = reversed(before);
  CHECK(oriented(turned) == oriented(before));
  CHECK(turned.starts == before.starts);
}

TEST_CASE("Holes: a point counts as inside only outside all holes, and meshes fill the rest") {
  for (const unsigned seed : seeds_of("meshes with holes", {1, 2, 3})) {
    std::mt19937 random(seed);
    const Cage cage = random_domain(random);
    const Mesh mesh = domain_mesh(cage, {1500});
    CHECK(mesh.starts.size() == cage.starts.size());
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Complex center = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0;
      area += 0.5 * cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
      CHECK(contains(cage, center));
      CHECK(encloses(outline_of(cage), center));
    }
    CHECK(area == Approx(area_of(outline_of(cage))).epsilon(1e-9));
    for (Index e = 0; e < cage.size(); ++e)
      CHECK(mesh.vertices[mesh.cage_vertices[e]] == cage.vertex(e));
    Polygon boundary{{}, mesh.starts};
    for (const int v : mesh.boundary) boundary.points.push_back(mesh.vertices[v]);
    CHECK(turning_number(boundary) == Approx(1));
    CHECK(signed_area(boundary) == Approx(area).epsilon(1e-9));
    for (Index l = 1; l < cage.loops().count(); ++l) {
      Complex middle = 0;
      for (Index e = cage.loops().first(l); e < cage.loops().end(l); ++e)
        middle += cage.vertex(e) / static_cast<double>(cage.loops().length(l));
      CHECK_FALSE(contains(cage, middle));
    }
    // The caller's own triangles.
    const Mesh again = mesh_of(cage, mesh.vertices, mesh.triangles);
    CHECK(again.starts.size() == mesh.starts.size());
    CHECK_THAT(error_message_of([&] { mesh_of(loop_of(cage, 0), mesh.vertices, mesh.triangles); }),
               Catch::Contains("holes"));
  }
}

TEST_CASE("Holes: the paths around holes generate all closed paths") {
  for (const unsigned seed : seeds_of("paths around holes", {1, 2})) {
    std::mt19937 random(seed);
    const Cage cage = random_domain(random);
    const Mesh mesh = domain_mesh(cage, {800});
    const BoundaryBasis basis(cage, 80, 240);
    const HoleLoops loops(mesh, basis.polygon());
    REQUIRE(loops.paths().size() == cage.starts.size());
    const MeshTree tree(mesh);
    // The argument around a point in a hole jumps; subtracting the correction removes the jumps.
    for (Index l = 1; l < cage.loops().count(); ++l) {
      const auto hole = PolygonView(basis.polygon()).loop(l);
      Complex center = 0;
      for (const Complex& z : hole) center += z / static_cast<double>(hole.size());
      if (winding_number(hole, center) == 0) continue;
      VectorXc jumps(static_cast<Index>(loops.paths().size()));
      for (Index p = 0; p < jumps.size(); ++p)
        jumps[p] = 2 * kPi * winding_number(loops.paths()[static_cast<size_t>(p)], center);
      CHECK(jumps.cwiseAbs().maxCoeff() > 0);
      const VectorXc continuous =
          tree.argument(center).cast<Complex>() - loops.correction(tree, jumps);
      for (const Triangle& t : mesh.triangles)
        for (size_t k = 0; k < 3; ++k)
          CHECK(std::abs(continuous[t[k]] - continuous[t[(k + 1) % 3]]) < 3);
    }
  }
}

TEST_CASE("Holes: a similarity of an inner loop alone does not move the picture") {
  for (const char* id : {"cage", "pins"}) {
    const Method& method = method_named(id);
    const Rest rest = rest_for(ring(), Precision::full, 400);
    Pose pose{rest.cage, {}};
    for (Index e = rest.cage.starts[0]; e < rest.cage.size(); ++e)
      for (Complex& z : pose.cage.segments[e]) z = Complex(1.4, 0.6) * z + Complex(30, -70);
    const SampledMap map = method.prepare(rest, nullptr)->deform(pose, {});
    for (size_t i = 0; i < rest.samples.size(); ++i)
      CHECK(std::abs(map.f[static_cast<Index>(i)] - rest.samples[i]) < 1e-11);
  }
}

TEST_CASE("Holes: harmonic coordinates of a ring are logarithms of the radius") {
  Cage cage = round_loop(200);
  add_hole(cage, round_loop(50).segments);
  Rest rest;
  rest.cage = cage;
  rest.precision = Precision::full;
  for (const double radius : {55.0, 80.0, 120.0, 190.0})
    for (int k = 0; k < 7; ++k) rest.samples.push_back(std::polar(radius, 0.9 * k));
  // All control points of the inner loop move by 1.
  Pose pose{cage, {}};
  for (Index e = cage.starts[0]; e < cage.size(); ++e)
    for (Complex& z : pose.cage.segments[e]) z += 1.0;
  const SampledMap map =
      method_named("harmonic").prepare(rest, nullptr)->deform(pose, {.derivatives = true});
  for (size_t i = 0; i < rest.samples.size(); ++i) {
    const double radius = std::abs(rest.samples[i]);
    const double expected = std::log(200 / radius) / std::log(4.0);
    constexpr double kRound = 2e-3;  // circles are not exactly round, and fits have a tolerance
    CHECK(std::abs(map.f[static_cast<Index>(i)] - rest.samples[i] - expected) < kRound);
    const Complex slope = -0.5 / (rest.samples[i] * std::log(4.0));
    CHECK(std::abs(map.fz[static_cast<Index>(i)] - 1.0 - slope) < kRound / 10);
  }
}

TEST_CASE("Holes: maps are single-valued, and iterating methods without folds prove it") {
  for (const unsigned seed : seeds_of("single-valued maps", {1, 2})) {
    std::mt19937 random(seed);
    const Cage cage = seed == 1 ? ring() : random_domain(random);
    for (const char* id : {"cage", "pins", "harmonic", "puppet", "bounded"}) {
      const Method& method = method_named(id);
      for (const double space : {0, 1, 2}) {
        if (space > 0 && method.id != "bounded") continue;
        // Triangles that are too large flip, although the map itself does not fold.
        const bool proved = method.id == "puppet" || method.id == "bounded";
        Rest rest = rest_for(cage, Precision::full, proved ? 800 : 150);
        if (method.id == "bounded") rest.parameters = {{"space", space}};
        const double size = box_of(rest.samples).diagonal();
        Pose pose{cage, {}};
        for (Points& segment : pose.cage.segments)
          for (Complex& z : segment) z += 0.05 * size * random_complex(random);
        const std::vector<char> outer = boundary_marks(*rest.mesh);
        for (size_t v = 0; method.uses_pins && v < outer.size() && rest.pins.size() < 4; ++v)
          if (!outer[v] && v * 5 >= outer.size() * rest.pins.size()) {
            rest.pins.push_back({rest.samples[v]});
            pose.pins.push_back({rest.samples[v] + 0.12 * size * random_complex(random)});
          }
        INFO(method.id << ", space " << space);
        const auto deformer = method.prepare(rest, nullptr);
        const SampledMap map = deformer->deform(pose, {});
        const auto points = deformer->point_map(pose);
        CHECK(largest_seam(*rest.mesh, map.f, *points) < 1e-5 * size);
        if (!proved) continue;
        INFO(map.note);
        CHECK(map.status == SampledMap::Status::certified);
        CHECK(injectivity_of(*rest.mesh, map.f).turning_number == Approx(1).margin(0.01));
      }
    }
  }
}

TEST_CASE("Holes: every point of the picture is found again, and nothing in the holes") {
  for (const unsigned seed : seeds_of("inverses with holes", {4})) {
    std::mt19937 random(seed);
    for (const char* id : {"cage", "puppet", "harmonic"}) {
      const Method& method = method_named(id);
      Rest rest = rest_for(ring(), Precision::full, 600);
      Pose pose{rest.cage, {}};
      for (Points& segment : pose.cage.segments)
        for (Complex& z : segment) z = bend(z) + 2.0 * random_complex(random);
      const auto deformer = method.prepare(rest, nullptr);
      const SampledMap map = deformer->deform(pose, {});
      const auto points = deformer->point_map(pose);
      const InverseMap inverse(rest.cage, *rest.mesh, as_span(map.f), *points);
      INFO(method.id);
      for (size_t t = 0; t < rest.mesh->triangles.size(); t += 17) {
        const auto [a, b, c] = rest.mesh->triangles[t];
        const Complex z = (rest.samples[a] + rest.samples[b] + rest.samples[c]) / 3.0;
        const auto found = inverse.at(points->at(z).f);
        REQUIRE(found.size() == 1);
        // Closing leaves gaps of some 1e-9 of the size.
        CHECK(std::abs(found[0].z - z) < 1e-6);
      }
      // The image of the hole's loop surrounds points that have no preimage.
      Points image;
      for (Index i = rest.mesh->boundary_loops().first(1);
           i < static_cast<Index>(rest.mesh->boundary.size()); ++i)
        image.push_back(map.f[rest.mesh->boundary[static_cast<size_t>(i)]]);
      const Complex middle = box_of(image).center();
      CHECK(inverse.winding(middle) == 0);
      CHECK(inverse.at(middle).empty());
    }
  }
}

TEST_CASE("Holes: methods that do not allow them say so") {
  for (const Method& method : methods()) {
    if (method.allows_holes) continue;
    const Rest rest = rest_for(ring(), Precision::full, 100);
    CHECK_THAT(error_message_of([&] { method.prepare(rest, nullptr); }),
               Catch::Contains(method.label) && Catch::Contains("fill the holes"));
  }
}

TEST_CASE("Holes: puppets with random holes and pins are certified and closed") {
  for (const unsigned seed : seeds_of("puppets with holes", {7})) {
    std::mt19937 random(seed);
    for (const double reach : first_of<double>({0.1, 2, 0.4}, 2)) {
      Rest rest = rest_for(random_domain(random), Precision::full, 500);
      const double size = box_of(rest.samples).diagonal();
      Pose pose{rest.cage, {}};
      std::uniform_int_distribution<size_t> any(0, rest.samples.size() - 1);
      for (int p = 0; p < 5; ++p) {
        const Complex z = rest.samples[any(random)];
        rest.pins.push_back({z});
        pose.pins.push_back({z + reach * size * random_complex(random)});
      }
      const auto deformer = method_named("puppet").prepare(rest, nullptr);
      SampledMap map = deformer->deform(pose, {});
      INFO("reach " << reach << ", " << map.note);
      CHECK(map.status == SampledMap::Status::certified);
      // In impossible poses, derivatives change by orders of magnitude within a triangle, and the
      // test's own quadrature is too coarse.
      if (reach < 1)
        CHECK(largest_seam(*rest.mesh, map.f, *deformer->point_map(pose)) <
              1e-5 * std::max(size, box_of(as_span(map.f)).diagonal()));
      // Drafts, too.
      Pose next = pose;
      next.pins[0].position += 0.02 * size;
      map = deformer->deform(next, {.draft = true}, map.solution.get());
      CHECK(map.status == SampledMap::Status::certified);
    }
  }
}

TEST_CASE("Holes: puppets are closed in sudden drafts and at limits, too") {
  for (const unsigned seed : seeds_of("closed puppets", {8})) {
    std::mt19937 random(seed);
    const Cage cage = random_domain(random);
    const Mesh mesh = domain_mesh(cage, {500});
    const int vertices = BoundaryBasis::usual_size(2 * cage.size());
    const auto basis = std::make_shared<const BoundaryBasis>(cage, vertices, 6 * vertices);
    const double size = box_of(basis->samples()).diagonal();
    IsometricHandles handles;
    std::uniform_int_distribution<size_t> any(0, mesh.vertices.size() - 1);
    for (int p = 0; p < 5; ++p) handles.stations.push_back(mesh.vertices[any(random)]);
    handles.turned = 5;
    handles.weights = VectorXd::Ones(5);
    for (const auto& bounds : {std::optional<Bounds>(), std::optional(Bounds{0.5, 0.6, 1.7})}) {
      const IsometricSpace space(basis, mesh, handles, {}, {}, {}, bounds);
      IsometricTarget target{VectorXc::Zero(5), {}};
      IsometricMap map = space.solved(target, {});
      for (const double reach : {0.3, 1.0, 3.0}) {
        for (Complex& z : target.stations) z = reach * size * random_complex(random);
        INFO("seed " << seed << ", reach " << reach << (bounds ? ", limited" : ""));
        for (int frame = 0; frame < 3; ++frame) {
          map = space.followed(target, {}, map);
          CHECK(map.certificate.holds);
          CHECK(map.solution.gaps.cwiseAbs().maxCoeff() <= 1e-6 * size);
        }
        const IsometricMap found = space.solved(target, {});
        CHECK(found.certificate.holds);
        CHECK(found.solution.gaps.cwiseAbs().maxCoeff() <= 1e-6 * size);
      }
    }
  }
}

TEST_CASE("Holes: a mesh without the cage's holes is refused") {
  Cage cage = polygon_cage(shapes::rectangle(200, 150));
  add_hole(cage, polygon_cage(Points{{60, 40}, {60, 90}, {120, 90}, {120, 40}}).segments);
  Rest rest = rest_for(cage, Precision::full, 300);
  Mesh wrong = *rest.mesh;
  wrong.starts.clear();
  rest.mesh = std::make_shared<const Mesh>(wrong);
  rest.pins.push_back({{20, 20}});
  for (const char* id : {"puppet", "bounded", "arap"})
    CHECK_THROWS_WITH(method_named(id).prepare(rest, nullptr),
                      Catch::Contains("must have 2 loops"));
}

}  // namespace holomorph::holes_test
