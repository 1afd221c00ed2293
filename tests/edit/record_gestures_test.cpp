// Ctrl-drags of rings, arms and edges are recorded as keyframes.

#include "edit/actions/actions.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/edits.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/pinned_bar.h"

namespace holomorph::record_gestures_test {

namespace {

constexpr Modifiers kCtrl{.ctrl = true};

/// Drags along a path for two seconds, with Ctrl.
template <class Path>
void record(TestWorkspace& desk, Path path) {
  constexpr int kSteps = 60;
  desk.now_ms += 5000;
  const double start = desk.now_ms;
  desk.press(path(0.0), kCtrl);
  for (int i = 1; i <= kSteps; ++i) {
    desk.now_ms = start + 2000.0 * i / kSteps;
    desk.move(path(static_cast<double>(i) / kSteps), kCtrl);
  }
  desk.release(path(1.0), kCtrl);
  desk.settle();
}

struct RingDesk : TestWorkspace {
  explicit RingDesk(const std::string& method, std::optional<double> angle = 0.25) {
    Deformation bar = pinned_bar(method);
    bar.pins[1].angle = angle;
    workspace.commit("Bar", bar);
    workspace.tools.active = ToolId::pin;
    workspace.selection = {{Handle::Kind::pin, 1, 0}};
    settle();
  }
  double ring() const { return kRingRadius * workspace.display.handle_px; }
};

}  // namespace

TEST_CASE("Recording a ring turns its pin over time, also more than once around") {
  for (const char* method : {"pins", "puppet", "arap"}) {
    INFO(method);
    RingDesk desk(method);
    const Complex at = desk.deformation().pins[1].pose;
    const size_t steps = desk.steps();
    record(desk, [&](double t) { return at + std::polar(desk.ring(), 7 * t * t); });
    const Deformation& own = desk.workspace.shown.own();
    CHECK(desk.steps() == steps + 1);
    REQUIRE(own.keyframes.size() > 3);  // 7 t^2 is not linear
    CHECK(own.pins[1].angle == 0.25);
    CHECK_FALSE(own.pins[1].radius);
    CHECK(own.keyframes.front().pose.pins[1].angle == Approx(0.25).margin(0.25));
    // Time runs as soon as the pointer has moved by a few pixels.
    const double late = 2 - own.keyframes.back().time;
    CHECK(late < 0.5);
    CHECK(own.keyframes.back().pose.pins[1].angle == Approx(7.25).margin(0.02));
    for (const Keyframe& key : own.keyframes) {
      const double t = (key.time + late) / 2;
      if (key.time > 0) CHECK(key.pose.pins[1].angle == Approx(0.25 + 7 * t * t).margin(0.3));
      CHECK(key.pose.pins[0] == own.keyframes.front().pose.pins[0]);
      CHECK(key.pose.pins[1].position == at);
    }
  }
}

TEST_CASE("Recording a ring fixes the rotation of a free pin") {
  RingDesk desk("pins", {});
  const Complex at = desk.deformation().pins[1].pose;
  record(desk, [&](double t) { return at + std::polar(desk.ring(), t); });
  const Deformation& own = desk.workspace.shown.own();
  REQUIRE(own.keyframes.size() >= 2);
  CHECK(own.pins[1].angle.has_value());
  CHECK(own.keyframes.back().pose.pins[1].angle == Approx(1).margin(0.02));
}

TEST_CASE("Recording a ring keeps the motion of the other pins") {
  RingDesk desk("pins");
  Workspace& w = desk.workspace;
  w.shown.timeline.time = 0;
  w.set_key();
  desk.settle();
  w.go_to_time(1);
  w.update_map({});
  Deformation moved = w.shown.deformation();
  moved.pins[0].pose += Complex(0, 40);
  w.shown.timeline.auto_key = true;
  REQUIRE(w.commit("Move", moved));
  w.shown.timeline.auto_key = false;
  w.go_to_time(0);
  desk.update();
  REQUIRE(w.shown.knows_pose());
  desk.settle();
  w.update_map({});
  w.selection = {{Handle::Kind::pin, 1, 0}};
  const Complex at = w.shown.deformation().pins[1].pose;
  record(desk, [&](double t) { return at + std::polar(desk.ring(), 2 * t); });
  const Deformation& own = w.shown.own();
  const size_t there = key_at(own, 1);
  REQUIRE(there < own.keyframes.size());
  CHECK(own.keyframes[there].pose.pins[0].position == moved.pins[0].pose);
  CHECK(own.keyframes[there].pose.pins[1].angle == Approx(1.35).margin(0.15));
  CHECK(own.keyframes.back().pose.pins[1].angle == Approx(2.25).margin(0.02));
}

TEST_CASE("Recording a ring loses no keyframes: they must know the rotation of the pin") {
  RingDesk desk("pins", {});
  Workspace& w = desk.workspace;
  for (const double time : {0.0, 1.0}) {
    w.go_to_time(time);
    w.update_map({});
    desk.settle();
    w.set_key();
    desk.settle();
    w.update_map({});
  }
  w.go_to_time(0);
  desk.update();
  REQUIRE(w.shown.knows_pose());
  const Deformation before = w.shown.own();
  REQUIRE(before.keyframes.size() == 2);
  w.selection = {{Handle::Kind::pin, 1, 0}};
  const size_t steps = desk.steps();
  const Complex at = w.shown.deformation().pins[1].pose;
  record(desk, [&](double t) { return at + std::polar(desk.ring(), t); });
  CHECK(desk.steps() == steps);
  CHECK(w.shown.own() == before);
  CHECK_FALSE(w.messages.toasts.empty());
}

TEST_CASE("Recording rings, arms and tensions of corners") {
  const Points bar{{0, 0}, {300, 0}, {300, 100}, {0, 100}};
  const auto start = [](TestWorkspace& desk) {
    desk.workspace.tools.active = ToolId::angle;
    desk.click({300, 0});
    desk.settle();
  };
  {
    TestWorkspace desk(bar);
    start(desk);
    record(desk, [](double t) { return Complex(300, 0) + std::polar(28.0, 1.2 * t); });
    const Deformation& own = desk.workspace.shown.own();
    REQUIRE(own.keyframes.size() >= 2);
    CHECK(own.method == "angles");
    CHECK(corner_at(own, 1).before == 0);  // only the keyframes turn
    const Deformation end = posed_as(own, own.keyframes.back().pose);
    CHECK(corner_at(end, 1).before == Approx(1.2).margin(0.02));
    CHECK(corner_at(end, 1).after == Approx(1.2).margin(0.02));
    CHECK(corner_at(end, 2) == PoseCorner{});
  }
  {
    TestWorkspace desk(bar);
    start(desk);
    desk.hover({300, 0});
    const CornerMark mark = desk.tool().overlay().corner.value();
    const Complex arm = desk.workspace.display.viewport.plane_at_px(mark.after);
    const Complex center(300, 0);
    record(desk, [&](double t) { return center + (arm - center) * std::polar(1.0, -0.5 * t); });
    const Deformation& own = desk.workspace.shown.own();
    REQUIRE(own.keyframes.size() >= 2);
    const Deformation end = posed_as(own, own.keyframes.back().pose);
    CHECK(std::abs(corner_opening(end, 1)) == Approx(1).margin(0.05));
  }
  {
    TestWorkspace desk(bar);
    start(desk);
    record(desk, [](double t) { return Complex(150, 0) - Complex(0, 90 * t); });
    const Deformation& own = desk.workspace.shown.own();
    REQUIRE(own.keyframes.size() >= 2);
    const Deformation end = posed_as(own, own.keyframes.back().pose);
    CHECK(corner_at(end, 0).tension == Approx(0.4).margin(0.02));
    CHECK(corner_at(own, 0).tension == 1);
  }
}

TEST_CASE("Escape cancels the recording of a ring") {
  RingDesk desk("puppet");
  const Complex at = desk.deformation().pins[1].pose;
  const size_t steps = desk.steps();
  desk.press(at + desk.ring(), kCtrl);
  desk.now_ms = 300;
  desk.move(at + std::polar(desk.ring(), 0.4), kCtrl);
  desk.now_ms = 600;
  desk.move(at + std::polar(desk.ring(), 0.8), kCtrl);
  CHECK(desk.workspace.shown.timeline.recording);
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  CHECK_FALSE(desk.workspace.shown.timeline.recording);
  CHECK_FALSE(desk.workspace.shown.preview);
  CHECK(desk.steps() == steps);
}

}  // namespace holomorph::record_gestures_test
