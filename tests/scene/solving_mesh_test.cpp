// The mesh on which sheets are solved: five triangles across limbs, and no tiny ones.
#include "scene/solving_mesh.h"

#include <algorithm>

#include "core/mesh/mesher.h"
#include "core/mesh/split_chords.h"
#include "core/methods/sheet_solver.h"
#include "core/sheet/half_width.h"
#include "scene/prepared_map.h"
#include "support/catch.h"
#include "support/random_puppet.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::solving_mesh_test {

namespace {

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    CHECK(holomorph::area_of(mesh, t) > 0);
    sum += holomorph::area_of(mesh, t);
  }
  return sum;
}

double shortest_edge(const Mesh& mesh) {
  double shortest = HUGE_VAL;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) shortest = std::min(shortest, std::abs(opposite_side(mesh, t, k)));
  return shortest;
}

bool has_inner_vertices(const Mesh& mesh) {
  const std::vector<char> outer = boundary_marks(mesh);
  return std::ranges::all_of(mesh.triangles, [&](const Triangle& t) {
    return std::ranges::any_of(t, [&](int v) { return outer[static_cast<size_t>(v)] == 0; });
  });
}

}  // namespace

TEST_CASE("Solving mesh: every triangle has a vertex inside, and none is tiny") {
  for (const unsigned seed : seeds_of("solving meshes", {1, 2, 3, 4})) {
    // Stars have sharp tips, where the width is 0.
    const Cage cage = polygon_cage(shapes::star(5 + static_cast<int>(seed % 20), 0.6, seed));
    const Mesh mesh = solving_mesh(cage);
    const double size = box_of(mesh.vertices).diagonal();
    CAPTURE(seed, mesh.vertices.size());
    CHECK(has_inner_vertices(mesh));
    CHECK(area_of(mesh) == Approx(holomorph::area_of(outline_of(cage))).epsilon(1e-9));
    CHECK(mesh.vertices.size() < 3500);
    double shortest = 0.005 * size;
    const Points corners = vertices_of(cage);
    for (size_t i = 0; i < corners.size(); ++i)
      shortest = std::min(shortest, std::abs(corners[i] - corners[(i + 1) % corners.size()]));
    CHECK(shortest_edge(mesh) > 0.1 * shortest);
  }
}

TEST_CASE("Solving mesh: limbs are about five triangles across") {
  const Mesh mesh = solving_mesh(polygon_cage(shapes::rectangle(1000, 40)));
  const double edge = 8, expected = 1000 * 40 / (0.866 * edge * edge);
  CHECK(static_cast<double>(mesh.vertices.size()) > 0.6 * expected);
  CHECK(static_cast<double>(mesh.vertices.size()) < 1.8 * expected);
}

TEST_CASE("Solving mesh: the map hardly depends on it") {
  int poses = 0, met = 0;
  // The scene's mesh, the one for the same outline with twice as many points, and finer triangles.
  for (const unsigned seed : seeds_of("maps on three meshes", {1, 2, 3, 4, 5})) {
    std::mt19937 random(seed);
    const Puppet puppet = random_puppet(random);
    const Cage& cage = puppet.rest.cage;
    Cage divided = cage;
    for (Index i = cage.size(); i-- > 0;) insert_vertex(divided, i, 0.45);
    const HalfWidth width(*puppet.rest.mesh);
    const auto length_at = [&](Complex z) {
      return std::clamp(0.3 * width.at(z, 1.5), 0.004 * puppet.size, 0.022 * puppet.size);
    };
    const std::vector<Mesh> meshes{solving_mesh(cage), solving_mesh(divided),
                                   with_split_chords(graded_mesh(cage, length_at, 4000))};
    Pose pose{cage, {}};
    for (const RestPin& pin : puppet.rest.pins)
      pose.pins.push_back({pin.position + 0.06 * puppet.size * random_complex(random)});
    std::vector<double> energies;
    std::vector<VectorXc> maps;
    for (size_t m = 0; m < meshes.size(); ++m) {
      Rest rest = puppet.rest;
      rest.mesh = std::make_shared<const Mesh>(meshes[m]);
      rest.cage = m == 1 ? divided : cage;
      pose.cage = rest.cage;
      const SheetSolver solver(rest, {}, nullptr);
      const SheetState state = solver.solved(solver.handles().target(pose), {});
      energies.push_back(solver.energy().value(state.f) - 2);
      const SmoothMap map = solver.smooth(state.f);
      VectorXc at(static_cast<Index>(puppet.rest.samples.size()));
      for (Index i = 0; i < at.size(); ++i)
        at[i] = map.at(solver.domain().locator.near(puppet.rest.samples[static_cast<size_t>(i)])).f;
      maps.push_back(std::move(at));
    }
    // Tips that no pin holds swing by more, at most by a few times the mean.
    const auto apart = [&](size_t a, size_t b) {
      return (maps[a] - maps[b]).cwiseAbs() / puppet.size;
    };
    const double off = std::max(apart(0, 1).mean(), apart(0, 2).mean()),
                 farthest = std::max(apart(0, 1).maxCoeff(), apart(0, 2).maxCoeff());
    CAPTURE(seed, energies[0], energies[1], energies[2], off, farthest);
    CHECK(std::ranges::max(energies) < 1.2 * std::ranges::min(energies));
    ++poses;
    met += std::ranges::max(energies) < 1.05 * std::ranges::min(energies) && off < 0.002 &&
           farthest < 0.01;
  }
  // In one of ten poses, pins next to each other or at tips leave two maps of nearly equal energy.
  CAPTURE(met, poses);
  CHECK(met >= 0.8 * poses);
}

TEST_CASE("Splitting chords leaves a mesh of the same polygon") {
  // A strip of triangles whose vertices all lie on the outline.
  Mesh strip;
  for (int i = 0; i < 6; ++i) strip.vertices.emplace_back(i, i % 2);
  for (int i = 0; i < 4; ++i)
    strip.triangles.push_back(i % 2 == 0 ? Triangle{i, i + 2, i + 1} : Triangle{i, i + 1, i + 2});
  strip.boundary = {0, 2, 4, 5, 3, 1};
  REQUIRE_FALSE(has_inner_vertices(strip));
  const Mesh split = with_split_chords(strip);
  CHECK(has_inner_vertices(split));
  CHECK(split.vertices.size() == 9);
  CHECK(split.triangles.size() == 10);
  CHECK(area_of(split) == Approx(area_of(strip)));
}

TEST_CASE("Solving mesh: another method brings its own mesh, and going back finds the same map") {
  Deformation deformation;
  deformation.rest = deformation.pose = polygon_cage(shapes::rectangle(600, 400));
  for (const auto& [from, to] :
       {std::pair<Complex, Complex>{{100, 200}, {100, 200}}, {{450, 220}, {520, 300}}})
    deformation.pins.push_back({from, to, {}, {}});
  std::unique_ptr<PreparedMap> prepared;
  std::vector<VectorXc> maps;
  for (const char* method : {"sheet", "puppet", "sheet"}) {
    deformation.method = method;
    prepared = prepared_map(deformation, Precision::single, {}, prepared.get());
    CAPTURE(method);
    const bool smooths = method_named(method).smooths_mesh;
    CHECK((prepared->rest.mesh == prepared->mesh) == !smooths);
    CHECK(prepared->rest.samples == prepared->mesh->vertices);
    CHECK(prepared->mesh->vertices.size() > 4000);
    if (smooths) CHECK(prepared->rest.mesh->vertices.size() < 4000);
    maps.push_back(prepared->deformer->deform(pose_of(deformation), {}).f);
  }
  CHECK(maps[0] == maps[2]);
  // A new pin keeps both meshes.
  deformation.pins.push_back({{300, 100}, {300, 100}, {}, {}});
  const auto more = prepared_map(deformation, Precision::single, {}, prepared.get());
  CHECK(more->mesh == prepared->mesh);
  CHECK(more->rest.mesh == prepared->rest.mesh);
}

}  // namespace holomorph::solving_mesh_test
