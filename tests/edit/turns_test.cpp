// The turns of pins: a released drag stores them, and they decide which map a file shows.
#include <thread>

#include "core/mesh/mesher.h"
#include "edit/actions/actions.h"
#include "edit/edits/edits.h"
#include "scene/formats/scene_json.h"
#include "scene/keyframes.h"
#include "scene/mirror.h"
#include "scene/prepared_map.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/pinned_bar.h"
#include "support/shapes.h"

namespace holomorph::turns_test {

namespace {

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

/// Points of a path that bends the right half of the bar upward and around.
std::vector<Complex> winding_path(double degrees) {
  std::vector<Complex> path;
  for (int k = 1; k <= 60; ++k) {
    const double angle = degrees * kPi / 180 * k / 60, radius = 250 / std::max(angle, 1e-3);
    path.push_back(Complex(300, 50) +
                   Complex(radius * std::sin(angle), radius * (1 - std::cos(angle))));
  }
  return path;
}

/// A desk with a bar with pins and its map.
struct BarDesk : TestWorkspace {
  explicit BarDesk(const Deformation& bar, ToolId tool = ToolId::pin) {
    workspace.commit("Bar", bar);
    workspace.tools.active = tool;
    settle();
  }
};

}  // namespace

TEST_CASE(
    "Puppet: a released drag stores turns in the same step, and the file gives the same map") {
  BarDesk desk(pinned_bar("puppet"));
  Workspace& workspace = desk.workspace;
  REQUIRE(workspace.map().has_map());
  const size_t before = workspace.document.history().index();
  drag_last_pin(desk, winding_path(200));
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

TEST_CASE("Puppet: pressing and dragging a new pin stores turns, too") {
  Deformation bar = pinned_bar("puppet");
  bar.pins.pop_back();
  BarDesk desk(bar);
  Workspace& workspace = desk.workspace;
  const size_t steps = desk.steps();
  desk.press({550, 50});
  REQUIRE(workspace.shown.deformation().pins.size() == 3);
  desk.settle();
  for (const Complex& z : winding_path(200)) {
    desk.move(z);
    workspace.map().finish(workspace.shown.deformation(), {.derivatives = false, .draft = true});
  }
  const VectorXc dragged = workspace.map().map().f;
  desk.release(winding_path(200).back());
  desk.settle();
  CHECK(desk.steps() == steps + 1);
  REQUIRE(desk.deformation().pins[2].turn.has_value());
  CHECK(*desk.deformation().pins[2].turn > 2.5);
  for (const Pin& pin : desk.deformation().pins) CHECK(pin.turn.has_value());
  CHECK((workspace.map().map().f - dragged).cwiseAbs().maxCoeff() < 10);
}

TEST_CASE("Puppet: a pin without a turn leaves the other pins wound up") {
  BarDesk desk(pinned_bar("puppet"));
  Workspace& workspace = desk.workspace;
  drag_last_pin(desk, winding_path(300));
  const VectorXc before = workspace.map().map().f;
  REQUIRE(*desk.deformation().pins[2].turn > 4);
  const Complex rest(430, 60);
  const SampledMap& map = workspace.map().map();
  const Mesh& mesh = *workspace.map().prepared()->mesh;
  const Complex image = locate_near(mesh, rest).in(mesh, as_span(map.f));
  workspace.commit("Add", with_pin(desk.deformation(), rest, image, std::vector<Points>{}));
  CHECK_FALSE(desk.deformation().pins[3].turn.has_value());
  desk.settle();
  CHECK((workspace.map().map().f - before).cwiseAbs().maxCoeff() < 6);
}

TEST_CASE("Puppet: where turns lead away from a drag, its final map has better ones") {
  Deformation bar = with_cage(Deformation{}, shapes::rectangle(900, 80));
  bar.method = "sheet";
  for (const Complex z : {Complex(50, 40), Complex(450, 40), Complex(850, 40)})
    bar.pins.push_back({z, z, {}, {}});
  BarDesk desk(bar);
  LiveMap& live = desk.workspace.map();
  Deformation released = desk.deformation();
  released.pins[2].pose = {400, 40};
  live.finish(released, {.derivatives = false, .draft = true});
  const VectorXc shown = live.map().f;
  // As if the turns of the draft led to a loop.
  released.pins[2].turn = 4.712;
  live.finish(released, {.released = true});
  CHECK((live.map().f - shown).cwiseAbs().maxCoeff() < 6);
  REQUIRE(live.map().better_turns.size() == 3);
  Deformation better = released;
  for (size_t i = 0; i < 3; ++i) better.pins[i].turn = live.map().better_turns[i];
  // What is shown is the map of the better turns, and not that of the pose itself.
  live.finish(released, {});
  CHECK(live.map().better_turns.empty());
  CHECK((live.map().f - shown).cwiseAbs().maxCoeff() > 100);
  live.finish(better, {});
  CHECK((live.map().f - shown).cwiseAbs().maxCoeff() < 6);
}

TEST_CASE("Turns are revised in all steps that have them, and undone steps stay") {
  BarDesk desk(pinned_bar("sheet"));
  Document& document = desk.workspace.document;
  Deformation before = desk.deformation();
  before.pins[2].turn = 1;
  desk.workspace.commit("Turn", before);
  Scene hidden = document.scene();
  Layer layer = hidden.layer();
  layer.opacity = 0.5;
  desk.workspace.commit_layers("Opacity", with_layer(hidden, layer));
  Deformation later = before;
  later.pins[0].pose += 1.0;
  desk.workspace.commit("Later", later);
  run("edit.undo", desk.workspace);
  Deformation after = before;
  after.pins[2].turn = 2;
  document.revise(document.scene().layer().id, before, after);
  CHECK(desk.deformation() == after);
  CHECK(document.scene().layer().opacity == 0.5);
  REQUIRE(document.history().can_redo());
  run("edit.redo", desk.workspace);
  CHECK(desk.deformation() == later);
  run("edit.undo", desk.workspace);
  run("edit.undo", desk.workspace);
  CHECK(desk.deformation() == after);
  run("edit.undo", desk.workspace);
  CHECK_FALSE(desk.deformation().pins[2].turn);
}

TEST_CASE("Pins that another method moves lose their turns") {
  Deformation bar = pinned_bar("arap");
  for (Pin& pin : bar.pins) pin.turn = 6.0;
  BarDesk desk(bar);
  desk.drag({550, 50}, {540, 120});
  CHECK(desk.deformation().pins[0].turn == 6.0);
  CHECK(desk.deformation().pins[1].turn == 6.0);
  CHECK_FALSE(desk.deformation().pins[2].turn.has_value());
}

TEST_CASE("Puppet: recorded motion has the turns of the recording, in each keyframe") {
  BarDesk desk(pinned_bar("puppet"), ToolId::select);
  Workspace& workspace = desk.workspace;
  constexpr Modifiers kCtrl{true, false, false};
  const std::vector<Complex> path = winding_path(300);
  desk.press({550, 50}, kCtrl);
  for (size_t k = 0; k < path.size(); ++k) {
    desk.now_ms = 1000.0 / 30 * static_cast<double>(k + 1);
    desk.move(path[k], kCtrl);
    workspace.map().finish(workspace.shown.deformation(), {.derivatives = false, .draft = true});
  }
  desk.release(path.back(), kCtrl);
  const std::vector<Keyframe>& keys = workspace.shown.own().keyframes;
  REQUIRE(keys.size() >= 3);
  double last = -1;
  for (const Keyframe& key : keys) {
    if (key.time == 0) continue;
    REQUIRE(key.pose.pins[2].turn.has_value());
    CHECK(*key.pose.pins[2].turn > last - 1e-3);
    last = *key.pose.pins[2].turn;
  }
  CHECK(last > 4);
}

TEST_CASE("Puppet: mirroring a pose negates its turns") {
  Deformation deformation = pinned_bar("puppet");
  deformation.pins[0].turn = 0.25;
  deformation.pins[2].turn = -1.5;
  const Pose mirror = mirrored(deformation, whole_pose_of(deformation));
  CHECK(mirror.pins[0].turn == 1.5);
  CHECK_FALSE(mirror.pins[1].turn.has_value());
  CHECK(mirror.pins[2].turn == -0.25);
}

TEST_CASE("Puppet: Untwist forgets the turns, in one step") {
  TestWorkspace desk;
  Workspace& workspace = desk.workspace;
  workspace.commit("Puppet", pinned_bar("puppet"));
  CHECK_FALSE(workspace.actions.named("edit.untwist").enabled(workspace));
  Deformation twisted = workspace.shown.deformation();
  twisted.pins[0].turn = 0.0;
  twisted.pins[1].turn = 0.0;
  twisted.pins[2].turn = 2 * kPi;
  workspace.commit("Twist", twisted);
  desk.settle();
  // A whole turn between two pins that are at rest costs energy, and the note says so.
  CHECK_THAT(workspace.map().map().note, Catch::Contains("Untwist"));
  const double strained = workspace.map().map().extremes.value().largest;
  REQUIRE(workspace.actions.named("edit.untwist").enabled(workspace));
  const size_t steps = desk.steps();
  run("edit.untwist", workspace);
  CHECK(desk.steps() == steps + 1);
  for (const Pin& pin : workspace.shown.deformation().pins) CHECK_FALSE(pin.turn.has_value());
  desk.settle();
  CHECK(workspace.map().map().extremes.value().largest < strained);
  CHECK(std::abs(workspace.map().map().extremes.value().largest - 1) < 1e-6);
  run("edit.undo", workspace);
  CHECK(workspace.shown.deformation() == twisted);
}

TEST_CASE("Puppet: a keyframe is proved to be free of folds, like the frames around it") {
  TestWorkspace desk;
  Workspace& workspace = desk.workspace;
  Deformation bar = pinned_bar("puppet");
  bar = with_key(bar, 0);
  bar.pins[2].pose = {500, 200};
  bar = with_key(bar, 1);
  workspace.commit("Keys", bar);
  desk.settle();
  workspace.go_to_time(0);
  workspace.update_map({});
  for (int wait = 0; wait < 500 && !workspace.map().motion().plays(); ++wait) {
    workspace.map().follow_keys();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    workspace.update_map({});
  }
  REQUIRE(workspace.map().motion().plays());
  for (const double time : {0.0, 0.5, 1.0}) {
    INFO("at " << time << " s");
    workspace.go_to_time(time);
    desk.update();
    CHECK(workspace.map().map().status == SampledMap::Status::certified);
    CHECK_THAT(workspace.map().map().note, Catch::Contains("o folds"));
  }
}

}  // namespace holomorph::turns_test
