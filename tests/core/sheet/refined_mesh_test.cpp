// Refined meshes: they are meshes of the same cage, and prolonged maps are the same maps.
#include "core/sheet/refined_mesh.h"

#include "core/maps/distortion.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/contract_setup.h"

namespace holomorph::refined_mesh_test {

TEST_CASE("Refined mesh: it fills the cage better, and has the outline on the cage") {
  for (const unsigned seed : seeds_of("refined meshes", {1, 2, 3}))
    for (const int degree : {1, 3}) {
      Cage cage = shapes::curved_star(7, degree, 0.25, seed);
      if (seed % 2) cage = reversed(cage);
      CAPTURE(seed, degree);
      const Mesh coarse = domain_mesh(cage, {250});
      const RefinedMesh refined = refined_mesh(cage, coarse);
      const Mesh& fine = refined.mesh;
      REQUIRE(fine.triangles.size() == 4 * coarse.triangles.size());
      double area = 0, coarse_area = 0;
      for (const Triangle& t : fine.triangles) {
        CHECK(area_of(fine, t) > 0);
        area += area_of(fine, t);
      }
      for (const Triangle& t : coarse.triangles) coarse_area += area_of(coarse, t);
      const double exact = std::abs(signed_area(outline_of(cage, 2000)));
      if (degree == 1)
        CHECK(area == Approx(exact).epsilon(1e-12));
      else
        CHECK(std::abs(area - exact) < 0.4 * std::abs(coarse_area - exact));
      // Vertices count by Euler's formula, and the boundary is a loop of boundary vertices.
      CHECK(fine.boundary.size() == 2 * coarse.boundary.size());
      CHECK(fine.vertices.size() == 1 + (fine.triangles.size() + fine.boundary.size()) / 2);
      const std::vector<char> marks = boundary_marks(fine);
      CHECK(std::ranges::count(marks, 1) == static_cast<long>(fine.boundary.size()));
      double around = 0;
      for (size_t i = 0; i < fine.boundary.size(); ++i)
        around +=
            0.5 *
            cross(
                fine.vertices[static_cast<size_t>(fine.boundary[i])],
                fine.vertices[static_cast<size_t>(fine.boundary[(i + 1) % fine.boundary.size()])]);
      CHECK(around == Approx(area).epsilon(1e-12));
    }
}

TEST_CASE("Refined mesh: a prolonged map has the derivatives of the coarse one") {
  for (const Shape shape : {Shape::straight, Shape::curved, Shape::holes}) {
    const Cage cage = cage_of(shape);
    const Mesh coarse = domain_mesh(cage, {200});
    const RefinedMesh refined = refined_mesh(cage, coarse);
    CHECK(refined.mesh.holes.size() == coarse.holes.size());
    VectorXc f(static_cast<Index>(coarse.vertices.size()));
    for (Index v = 0; v < f.size(); ++v) f[v] = bend(coarse.vertices[static_cast<size_t>(v)]);
    const VectorXc fine = refined.prolonged(coarse, f);
    for (size_t i = 0; i < refined.mesh.triangles.size(); ++i) {
      const auto own = derivatives_in(refined.mesh, refined.mesh.triangles[i], fine),
                 parent = derivatives_in(coarse, coarse.triangles[i / 4], f);
      // An edge's middle that moved onto the cage belongs to one triangle.
      CHECK(std::abs(own.fz - parent.fz) < 1e-9);
      CHECK(std::abs(own.fzbar - parent.fzbar) < 1e-9);
    }
    CHECK(flipped_triangles(refined.mesh, fine) == 0);
  }
}

}  // namespace holomorph::refined_mesh_test
