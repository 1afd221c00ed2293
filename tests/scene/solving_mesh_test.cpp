// The mesh on which sheets are solved: five triangles across limbs, and no tiny ones.
#include "scene/solving_mesh.h"

#include <algorithm>

#include "core/mesh/split_chords.h"
#include "core/sheet/half_width.h"
#include "support/catch.h"
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

}  // namespace holomorph::solving_mesh_test
