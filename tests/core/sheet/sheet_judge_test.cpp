// Newton's method of the elastic sheet against an independent solver, Ipopt, with values and slopes
// alone.
#include "core/mesh/mesher.h"
#include "core/sheet/sheet_program.h"
#include "support/catch.h"
#include "support/ipopt.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::sheet_judge_test {

namespace {

/// x and y of each vertex.
VectorXd coordinates_of(const VectorXc& f) {
  return Eigen::Map<const VectorXd>(reinterpret_cast<const double*>(f.data()), 2 * f.size());
}
VectorXc map_of(const VectorXd& x) {
  return Eigen::Map<const VectorXc>(reinterpret_cast<const Complex*>(x.data()), x.size() / 2);
}

}  // namespace

TEST_CASE("Sheet: Ipopt finds the same maps on small meshes") {
  for (const unsigned seed : seeds_of("sheets for Ipopt", {1, 2})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const Cage cage = polygon_cage(shapes::star(5 + static_cast<int>(seed % 4), 0.3, seed));
    const auto mesh = std::make_shared<const Mesh>(domain_mesh(cage, {60}));
    const double size = box_of(mesh->vertices).diagonal();
    const auto count = static_cast<Index>(mesh->vertices.size());
    const auto sheet = std::make_shared<const SheetEnergy>(
        mesh, VectorXd::Ones(static_cast<Index>(mesh->triangles.size())),
        VectorXd::Constant(count, 0.04 * size));
    SheetHolds holds;
    SheetPull pull;
    for (int p = 0; p < 3; ++p) {
      const int v = static_cast<int>(random() % mesh->vertices.size());
      holds.rows.push_back({{{v, 1.0}}});
      Spring spring{1e3 / (size * size)};
      if (p == 2) spring = {spring.weight, 20 * size, 0.01 / (size * size)};  // it gives way
      pull.rows.push_back(
          {mesh->vertices[static_cast<size_t>(v)] + 0.1 * size * random_complex(random), spring});
    }
    const SheetProgram program(sheet, holds);
    const VectorXc rest = Eigen::Map<const VectorXc>(mesh->vertices.data(), count);
    VectorXc ours = rest;
    program.minimize(pull, ours, 100);

    const auto value = [&](const VectorXd& x) { return program.value(map_of(x), pull); };
    const auto gradient = [&](const VectorXd& x) { return program.gradient(map_of(x), pull); };
    const VectorXd best = minimum_by_ipopt(value, gradient, coordinates_of(rest));
    const double theirs = value(best), own = program.value(ours, pull);
    CAPTURE(theirs, own);
    CHECK(std::abs(theirs - own) < 1e-7 * own);
    const double missed = std::abs(holds.rows[2].image(ours) - pull.rows[2].target);
    CHECK(2 * pull.rows[2].spring.weight * pull.rows[2].spring.inverse_force * missed > 1);
    CHECK((map_of(best) - ours).cwiseAbs().maxCoeff() < 1e-3 * size);
  }
}

}  // namespace holomorph::sheet_judge_test
