// The timeline: what is shown at a time, what edits there mean, and how time goes on.
#include "edit/timeline.h"

#include <catch2/catch.hpp>

#include "desk.h"
#include "edit/actions.h"

using namespace holomorph;

namespace {

const Points kBar{{0, 0}, {300, 0}, {300, 100}, {0, 100}};

void act(Desk& desk, const char* id) {
  run(action_named(id), desk.workspace);
  desk.workspace.update_map({});
}

void go_to(Desk& desk, double time) {
  desk.workspace.go_to_time(time);
  desk.workspace.update_map({});
}

/// A bar with keys at 0 (at rest) and at 1 s (moved to the right by 40).
void set_two_keys(Desk& desk) {
  act(desk, "time.key");
  desk.workspace.timeline.go_to(1);
  desk.workspace.timeline.shows = false;
  Scene moved = desk.scene();
  for (Points& segment : moved.pose.segments) segment[0] += 40.0;
  desk.workspace.commit("Move", moved);
  act(desk, "time.key");
}

}  // namespace

TEST_CASE("Timeline: keys are set, and the picture between them is shown") {
  Desk desk(kBar);
  set_two_keys(desk);
  CHECK(desk.scene().keyframes.size() == 2);
  CHECK(desk.workspace.timeline.visible);
  go_to(desk, 0.5);
  CHECK(desk.scene().pose.vertex(0).real() == Approx(20).margin(1e-3));
  CHECK(desk.workspace.document.scene().pose.vertex(0) == 40.0);  // its own stays
  CHECK(desk.workspace.map.map().f[0].real() -
            desk.workspace.map.prepared()->mesh->vertices[0].real() ==
        Approx(20).margin(1e-2));
}

TEST_CASE("Timeline: a pose edit at a time leaves the time, undo leads back to it") {
  Desk desk(kBar);
  set_two_keys(desk);
  go_to(desk, 0.5);
  const size_t steps = desk.steps();
  const Complex from = desk.scene().pose.vertex(2);
  desk.press(from);
  desk.move({380, 170});
  desk.workspace.update_map({});  // as the window does while it is dragged
  desk.move({400, 200});
  desk.release({400, 200});
  CHECK_FALSE(desk.workspace.timeline.shows);
  CHECK(std::abs(desk.scene().pose.vertex(2) - Complex(400, 200)) < 1e-6);
  CHECK(desk.scene().pose.vertex(0).real() == Approx(20).margin(1e-3));
  CHECK(desk.scene().keyframes.size() == 2);
  CHECK(desk.steps() == steps + 2);  // the pose at that time, and the move
  act(desk, "edit.undo");
  CHECK(desk.scene().pose.vertex(2).real() == Approx(320).margin(1e-3));
  act(desk, "edit.redo");
  act(desk, "time.key");  // now it is one
  CHECK(desk.scene().keyframes.size() == 3);
  CHECK(desk.workspace.timeline.shows);
  CHECK(std::abs(desk.scene().keyframes[1].pose.cage.vertex(2) - Complex(400, 200)) < 1e-6);
}

TEST_CASE("Timeline: with auto-key edits of the pose set keys") {
  Desk desk(kBar);
  set_two_keys(desk);
  act(desk, "time.auto_key");
  go_to(desk, 0.5);
  desk.drag(desk.scene().pose.vertex(2), Complex(400, 200));
  desk.workspace.update_map({});
  CHECK(desk.workspace.timeline.shows);
  REQUIRE(desk.scene().keyframes.size() == 3);
  CHECK(desk.scene().keyframes[1].time == 0.5);
  CHECK(std::abs(desk.scene().pose.vertex(2) - Complex(400, 200)) < 1e-3);
  act(desk, "edit.undo");
  CHECK(desk.scene().keyframes.size() == 2);
}

TEST_CASE("Timeline: edits of keys are no poses, with auto-key, too") {
  Desk desk(kBar);
  set_two_keys(desk);
  act(desk, "time.auto_key");
  go_to(desk, 0);
  const Pose first = desk.workspace.document.scene().keyframes[0].pose;
  const size_t steps = desk.steps();
  desk.workspace.commit("Ease", with_ease(desk.workspace.document.scene(), 0, Ease::hold));
  CHECK(desk.workspace.document.scene().keyframes[0].pose == first);
  CHECK(desk.steps() == steps + 1);
  CHECK(desk.workspace.timeline.shows);
  desk.workspace.update_map({});
  for (const double time : {1.25, 1.5, 1.75}) {
    desk.workspace.commit_or_amend("Move key",
                                   with_key_moved(desk.workspace.document.scene(), 1, time).first);
    desk.workspace.go_to_time(time);
    desk.workspace.update_map({});
  }
  CHECK(desk.workspace.document.scene().keyframes.size() == 2);
  CHECK(desk.workspace.document.scene().keyframes[1].time == 1.75);
  go_to(desk, 0);
  act(desk, "time.delete_key");
  CHECK(desk.workspace.document.scene().keyframes.size() == 1);
}

TEST_CASE("Timeline: what is no pose edit leaves the scene's own pose and the time") {
  Desk desk(kBar);
  set_two_keys(desk);
  go_to(desk, 0.25);
  Scene other = with_method(desk.scene(), "harmonic");
  desk.workspace.commit("Method", other);
  CHECK(desk.workspace.timeline.shows);
  CHECK(desk.workspace.document.scene().pose.vertex(0) == 40.0);
  // An inserted point goes into all keyframes.
  desk.settle();
  desk.workspace.update_map({});
  desk.workspace.commit("Insert", inserted(desk.scene(), 0, 0.5));
  CHECK(playing_keys(desk.workspace.document.scene()).size() == 2);
  CHECK(desk.scene().keyframes[1].pose.cage.vertex(1) == Complex(190, 0));
}

TEST_CASE("Timeline: a pin set at a time is in every keyframe where the picture is there") {
  Desk desk(kBar);
  set_two_keys(desk);
  go_to(desk, 1);
  desk.workspace.tool = ToolId::pin;
  desk.click({190, 50});
  const Scene& scene = desk.workspace.document.scene();
  REQUIRE(scene.pins.size() == 1);
  CHECK(playing_keys(scene).size() == 2);
  CHECK(std::abs(scene.keyframes[0].pose.pins[0].position - Complex(150, 50)) < 0.1);
  CHECK(std::abs(scene.keyframes[1].pose.pins[0].position - Complex(190, 50)) < 0.1);
}

TEST_CASE("Timeline: time goes on, loops, and stops at the end") {
  Desk desk(kBar);
  set_two_keys(desk);
  Timeline& timeline = desk.workspace.timeline;
  const Scene& scene = desk.workspace.document.scene();
  timeline.go_to(0.2);
  timeline.playing = true;
  CHECK(advance(timeline, scene, 1000));
  CHECK(advance(timeline, scene, 1500));
  CHECK(timeline.time == Approx(0.7));
  CHECK(advance(timeline, scene, 2000));
  CHECK(timeline.time == Approx(0.2));
  timeline.loop = false;
  CHECK(advance(timeline, scene, 4000));
  CHECK(timeline.time == 1);
  CHECK_FALSE(timeline.playing);
  CHECK_FALSE(advance(timeline, scene, 4100));
}

TEST_CASE("Timeline: steps by frames and keys") {
  Desk desk(kBar);
  set_two_keys(desk);
  go_to(desk, 0);
  act(desk, "time.forward");
  CHECK(desk.workspace.timeline.time == Approx(1 / 24.0));
  act(desk, "time.next_key");
  CHECK(desk.workspace.timeline.time == 1);
  act(desk, "time.next_key");
  CHECK(desk.workspace.timeline.time == 1);
  act(desk, "time.back");
  act(desk, "time.previous_key");
  CHECK(desk.workspace.timeline.time == 0);
  act(desk, "time.back");
  CHECK(desk.workspace.timeline.time == 0);
  act(desk, "time.delete_key");
  CHECK(desk.workspace.document.scene().keyframes.size() == 1);
}

TEST_CASE("Timeline: poses are copied, pasted and mirrored") {
  Desk desk(kBar);
  desk.drag({300, 0}, {360, 10});
  act(desk, "time.copy");
  act(desk, "edit.undo");
  act(desk, "time.paste");
  CHECK(desk.scene().pose.vertex(1) == Complex(360, 10));
  act(desk, "edit.undo");
  act(desk, "time.paste_mirrored");
  CHECK(desk.scene().pose.vertex(0) == Complex(-60, 10));
  CHECK(desk.scene().pose.vertex(1) == Complex(300, 0));
}
