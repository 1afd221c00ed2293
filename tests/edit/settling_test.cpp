// A released picture fades from its last draft to the final map, and only then.
#include "edit/settling.h"

#include "support/catch.h"

namespace holomorph::settling_test {

namespace {

/// A bar with three pins.
Deformation bar() {
  Deformation deformation =
      with_cage(Deformation{}, Points{{0, 0}, {600, 0}, {600, 100}, {0, 100}});
  deformation.method = "sheet";
  for (const double x : {50.0, 300.0, 550.0})
    deformation.pins.push_back({{x, 50}, {x, 50}, {}, {}});
  return deformation;
}

}  // namespace

TEST_CASE("Settling: a final map that is elsewhere is reached in 150 ms") {
  Deformation deformation = bar();
  LiveMap map(MeshOptions{600});
  Settling settling;
  map.finish(deformation, {.draft = true});
  const VectorXc draft = settling.positions(map, 900);
  CHECK_FALSE(settling.moves());
  deformation.pins[2].pose = {520, 130};
  map.finish(deformation, {});
  const VectorXc final = map.map().f;
  REQUIRE((final - draft).cwiseAbs().maxCoeff() > 10);
  CHECK((settling.positions(map, 1000) - draft).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(settling.moves());
  double before = 0;
  for (const double ms : {30.0, 75.0, 120.0}) {
    const double way = (settling.positions(map, 1000 + ms) - draft).norm() / (final - draft).norm();
    CHECK(way > before);
    CHECK(way < 1);
    before = way;
  }
  CHECK(settling.positions(map, 1150) == final);
  CHECK_FALSE(settling.moves());

  // Undo goes from final map to final map, without a fade.
  deformation.pins[2].pose = {550, 50};
  map.finish(deformation, {});
  CHECK(settling.positions(map, 1200) == map.map().f);
  CHECK_FALSE(settling.moves());
}

TEST_CASE("Settling: a fade ends when the map does") {
  Deformation deformation = bar();
  LiveMap map(MeshOptions{600});
  Settling settling;
  map.finish(deformation, {.draft = true});
  settling.positions(map, 0);
  deformation.pins[2].pose = {520, 130};
  map.finish(deformation, {});
  settling.positions(map, 10);
  REQUIRE(settling.moves());
  map.clear();
  CHECK(settling.positions(map, 20).size() == 0);
  CHECK_FALSE(settling.moves());
}

TEST_CASE("Settling: small differences, and drafts, are shown at once") {
  Deformation deformation = bar();
  LiveMap map(MeshOptions{600});
  Settling settling;
  map.finish(deformation, {.draft = true});
  settling.positions(map, 0);
  deformation.pins[2].pose = {550.05, 50};
  map.finish(deformation, {});
  CHECK(settling.positions(map, 10) == map.map().f);
  deformation.pins[2].pose = {520, 130};
  map.finish(deformation, {.draft = true});
  CHECK(settling.positions(map, 20) == map.map().f);
  CHECK_FALSE(settling.moves());
}

}  // namespace holomorph::settling_test
