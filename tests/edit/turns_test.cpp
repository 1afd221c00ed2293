// The turns of pins: a released drag stores them, and they decide which map a file shows.
#include <catch2/catch.hpp>

#include "core/mesh/mesher.h"
#include "edit/actions/actions.h"
#include "edit/edits/edits.h"
#include "scene/formats/scene_json.h"
#include "scene/mirror.h"
#include "scene/prepared_map.h"
#include "support/desk.h"

using namespace holomorph;

namespace {

const Points kBar{{0, 0}, {600, 0}, {600, 100}, {0, 100}};

/// A bar with three pins, under the puppet method.
Deformation puppet() {
  Deformation deformation = with_cage(Deformation{}, kBar);
  deformation.method = "puppet";
  for (const Complex z : {Complex(50, 50), Complex(300, 50), Complex(550, 50)})
    deformation.pins.push_back({z, z, {}, {}});
  return deformation;
}

/// Drags the last pin along a path, with a draft after each move, and releases it.
void drag_last_pin(TestWorkspace& desk, const std::vector<Complex>& path) {
  Workspace& workspace = desk.workspace;
  desk.press(workspace.shown.deformation().pins[2].pose);
  for (const Complex& z : path) {
    desk.move(z);
    workspace.map().finish(workspace.shown.deformation(), {.derivatives = false, .draft = true});
  }
  desk.release(path.back());
  desk.settle();
}

}  // namespace

TEST_CASE(
    "Puppet: a released drag stores turns in the same step, and the file gives the same map") {
  TestWorkspace desk;
  Workspace& workspace = desk.workspace;
  workspace.commit("Puppet", puppet());
  workspace.tools.active = ToolId::pin;
  desk.settle();
  REQUIRE(workspace.map().has_map());
  const size_t before = workspace.document.history().index();
  std::vector<Complex> path;  // bends the right half upward and around, by 200 degrees
  for (int k = 1; k <= 60; ++k) {
    const double angle = 200 * kPi / 180 * k / 60, radius = 250 / std::max(angle, 1e-3);
    path.push_back(Complex(300, 50) +
                   Complex(radius * std::sin(angle), radius * (1 - std::cos(angle))));
  }
  drag_last_pin(desk, path);
  const Deformation& shown = workspace.shown.deformation();
  REQUIRE(workspace.document.history().index() == before + 1);
  REQUIRE(shown.pins[2].turn.has_value());
  CHECK(*shown.pins[2].turn > 2.5);
  CHECK(std::round(1000 * *shown.pins[2].turn) / 1000 == *shown.pins[2].turn);
  CHECK(workspace.map().map().status == SampledMap::Status::certified);

  // A file, opened elsewhere, gives the same map.
  const Scene read = scene_from_json(json_of(workspace.document.scene()), "bar.json");
  CHECK(read.deformation() == shown);
  const auto prepared = prepared_map(read.deformation(), Precision::single, MeshOptions{500});
  const SampledMap again = prepared->deformer->deform(pose_of(read.deformation()), {});
  CHECK((again.f - workspace.map().map().f).cwiseAbs().maxCoeff() <= 1e-6 * 600);

  run("edit.undo", workspace);
  CHECK_FALSE(workspace.shown.deformation().pins[2].turn.has_value());
  run("edit.redo", workspace);
  const Deformation rest = reset(workspace.shown.deformation(), {});
  CHECK(rest.pins[2].turn == 0.0);
}

TEST_CASE("Puppet: mirroring a pose negates its turns") {
  Deformation deformation = puppet();
  deformation.pins[0].turn = 0.25;
  deformation.pins[2].turn = -1.5;
  const Pose mirror = mirrored(deformation, whole_pose_of(deformation));
  CHECK(mirror.pins[0].turn == 1.5);
  CHECK_FALSE(mirror.pins[1].turn.has_value());
  CHECK(mirror.pins[2].turn == -0.25);
}
