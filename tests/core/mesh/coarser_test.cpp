// Coarser meshes cover the same domain, whatever the cage.
#include "core/mesh/coarser.h"

#include <set>

#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::coarser_test {

namespace {

/// Counter-clockwise triangles, Euler's formula, closed boundaries, and nearly the same area.
void check_coarser(const Mesh& mesh, const CoarserMesh& coarser) {
  const auto& [coarse, kept, locations] = coarser;
  CAPTURE(mesh.vertices.size(), coarse.vertices.size());
  REQUIRE(kept.size() == coarse.vertices.size());
  for (size_t v = 0; v < kept.size(); ++v)
    CHECK(coarse.vertices[v] == mesh.vertices[static_cast<size_t>(kept[v])]);
  REQUIRE(locations.size() == mesh.vertices.size());
  for (size_t v = 0; v < locations.size(); ++v) {
    CHECK(std::abs(locations[v].in(coarse, coarse.vertices) - mesh.vertices[v]) < 1e-6);
    // The triangle is where the vertex is, or next to where the boundary has moved away from it.
    CHECK(*std::ranges::min_element(locations[v].weights) > -1);
  }
  std::set<std::pair<int, int>> sides;
  const auto area_of = [](const Mesh& of, const Triangle& t) {
    return 0.5 *
           cross(of.vertices[static_cast<size_t>(t[1])] - of.vertices[static_cast<size_t>(t[0])],
                 of.vertices[static_cast<size_t>(t[2])] - of.vertices[static_cast<size_t>(t[0])]);
  };
  double area = 0, whole = 0;
  for (const Triangle& t : mesh.triangles) whole += area_of(mesh, t);
  for (const Triangle& t : coarse.triangles) {
    CHECK(area_of(coarse, t) > 0);
    area += area_of(coarse, t);
    for (int k = 0; k < 3; ++k) CHECK(sides.insert({t[k], t[(k + 1) % 3]}).second);
  }
  CHECK(area == Approx(whole).epsilon(0.1));
  size_t open = 0;  // sides with a triangle on their left only
  for (const auto& [a, b] : sides) open += !sides.contains({b, a});
  CHECK(open == coarse.boundary.size());
  const Loops loops = coarse.boundary_loops();
  REQUIRE(loops.count() == mesh.boundary_loops().count());
  for (Index i = 0; i < static_cast<Index>(coarse.boundary.size()); ++i)
    CHECK(sides.contains({coarse.boundary[static_cast<size_t>(i)],
                          coarse.boundary[static_cast<size_t>(loops.next(i))]}));
  const auto edges = std::ssize(sides) - (std::ssize(sides) - static_cast<Index>(open)) / 2;
  CHECK(std::ssize(coarse.vertices) - edges + std::ssize(coarse.triangles) == 2 - loops.count());
}

void check_coarser(const Mesh& mesh, size_t count) {
  const CoarserMesh coarser = coarser_mesh(mesh, count);
  CHECK(coarser.kept.size() >= count);
  check_coarser(mesh, coarser);
}

/// Waves that bend a mesh, differently in each pose.
std::vector<Points> random_poses(const Mesh& mesh, std::mt19937& random) {
  std::vector<Points> poses;
  for (int k = 0; k < 5; ++k) {
    const Complex wave = 0.02 * random_complex(random);
    const double height = 20 * random_complex(random).real();
    Points pose;
    for (const Complex z : mesh.vertices)
      pose.push_back(z + height * std::polar(1.0, (std::conj(wave) * z).real()));
    poses.push_back(std::move(pose));
  }
  return poses;
}

/// The largest distance of a vertex from where the coarser mesh takes it, in any pose.
double distance_in(const std::vector<Points>& poses, const CoarserMesh& coarser) {
  double farthest = 0;
  for (const Points& pose : poses) {
    Points kept;
    for (const int v : coarser.kept) kept.push_back(pose[static_cast<size_t>(v)]);
    for (size_t v = 0; v < pose.size(); ++v)
      farthest =
          std::max(farthest, std::abs(coarser.locations[v].in(coarser.mesh, kept) - pose[v]));
  }
  return farthest;
}

}  // namespace

TEST_CASE("A coarser mesh covers the same domain with fewer triangles") {
  for (const unsigned seed : seeds_of("coarser meshes", {1, 2, 3})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const size_t vertices = 300 + random() % 3000;
    for (const Points& outline :
         {shapes::rectangle(600, 20), shapes::l_shape(), shapes::comb(6),
          shapes::star(5 + static_cast<int>(random() % 60), 0.5, random())}) {
      const Mesh mesh = domain_mesh(outline, {static_cast<int>(vertices)});
      check_coarser(mesh, mesh.vertices.size() / 8);
      check_coarser(mesh, 3);
    }
    Cage with_holes = polygon_cage(shapes::rectangle(300, 200));
    for (const Complex corner : {Complex(40, 40), Complex(180, 90)}) {
      with_holes.starts.push_back(with_holes.size());
      for (const Complex by : {Complex(0, 0), Complex(0, 60), Complex(50, 60), Complex(50, 0)})
        with_holes.segments.push_back({corner + by});
    }
    check_coarser(domain_mesh(with_holes, {static_cast<int>(vertices)}), 60);
    check_coarser(domain_mesh(with_holes, {static_cast<int>(vertices)}), 3);
  }
}

TEST_CASE("A coarser mesh has as few vertices as asked for, unless the outline needs more") {
  const Mesh mesh = domain_mesh(shapes::l_shape(), {4000});
  CHECK(coarser_mesh(mesh, 500).kept.size() == 500);
  CHECK(coarser_mesh(mesh, 60).kept.size() < 90);
  CHECK(coarser_mesh(mesh, mesh.vertices.size() + 1).kept.size() == mesh.vertices.size());
}

TEST_CASE("The coarsest mesh keeps to its poses and outline, and fewer vertices are farther off") {
  for (const unsigned seed : seeds_of("coarsest meshes", {1, 2})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    for (const Points& outline : {shapes::rectangle(600, 100), shapes::l_shape(), shapes::comb(5),
                                  shapes::star(40, 0.5, random())}) {
      const Mesh mesh = domain_mesh(outline, {1500});
      const std::vector<Points> poses = random_poses(mesh, random);
      size_t before = mesh.vertices.size() + 1;
      for (const double tolerance : {0.01, 0.1, 1.0, 10.0}) {
        const CoarserMesh coarser = coarsest_mesh(mesh, poses, tolerance);
        check_coarser(mesh, coarser);
        CHECK(distance_in(poses, coarser) <= tolerance * (1 + 1e-9));
        CHECK(coarser.kept.size() <= before);
        before = coarser.kept.size();
      }
      CHECK(before < mesh.vertices.size() / 4);
      const size_t few = mesh.vertices.size() / 5;
      const CoarserMesh blind = coarser_mesh(mesh, few), seeing = coarser_mesh(mesh, few, poses);
      check_coarser(mesh, seeing);
      CHECK(distance_in(poses, seeing) <= distance_in(poses, blind) + 1e-9);
    }
  }
  // What does not bend needs no inner vertices.
  const Mesh mesh = domain_mesh(shapes::rectangle(600, 100), {1500});
  CHECK(coarsest_mesh(mesh, std::vector<Points>{mesh.vertices}, 0.1).kept.size() == 4);
}

}  // namespace holomorph::coarser_test
