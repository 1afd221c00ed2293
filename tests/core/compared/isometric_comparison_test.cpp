// The rows of the comparison of methods with pins.
#include "core/compared/isometric_comparison.h"

#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace holomorph::isometric_comparison_test {

namespace {

std::vector<ComparedMap> rows_of(const Rest& rest, const Pose& pose) {
  std::vector<ComparedMap> rows;
  compare_isometric(rest, pose, [&](const ComparedMap& row) { rows.push_back(row); });
  return rows;
}

}  // namespace

TEST_CASE("Comparison with pins: the puppet's row has its own parameters, and each is measured") {
  Rest rest;
  rest.cage = polygon_cage(shapes::rectangle(600, 100));
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {400}));
  Pose pose{rest.cage, {}};
  for (const auto& [from, to] :
       {std::pair(Complex(50, 50), Complex(50, 50)), std::pair(Complex(300, 50), Complex(300, 90)),
        std::pair(Complex(550, 50), Complex(450, 200))}) {
    rest.pins.push_back({from});
    pose.pins.push_back({to});
  }
  const auto usual = rows_of(rest, pose);
  REQUIRE(usual.size() == 5);
  CHECK_THAT(usual[0].label, Catch::Contains("this program"));
  CHECK_THAT(usual[1].label, Catch::Contains("Chen"));
  CHECK(usual[0].settled);
  CHECK(usual[1].settled);
  for (const ComparedMap& row : usual) {
    CHECK(row.energy.value() >= 2);
    CHECK(row.f.size() == static_cast<Index>(rest.mesh->vertices.size()));
  }
  // The energies are those of the same minimization in two spaces.
  CHECK(usual[0].energy.value() == Approx(usual[1].energy.value()).epsilon(0.02));
  // Softer pins are missed by more, in both rows.
  rest.parameters = {{"pin_weight", 1e2}};
  const auto soft = rows_of(rest, pose);
  CHECK(soft[0].miss > 3 * usual[0].miss);
  CHECK(soft[1].miss > 3 * usual[1].miss);

  rest.pins.clear();
  pose.pins.clear();
  CHECK_THROWS(rows_of(rest, pose));
}

}  // namespace holomorph::isometric_comparison_test
