// The ring of a selected pin: rotation, scale and the disk that the pin holds.
#include <random>

#include "edit/edits/edits.h"
#include "edit/picking.h"
#include "scene/formats/scene_json.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/pinned_bar.h"
#include "support/seeds.h"

namespace holomorph::pin_ring_test {

namespace {

constexpr Modifiers kCtrl{.ctrl = true};

/// A desk with the bar, whose middle pin is fixed and selected.
struct RingDesk : TestWorkspace {
  explicit RingDesk(const std::string& method, ToolId tool) {
    Deformation bar = pinned_bar(method);
    bar.pins[1].angle = 0.25;
    workspace.commit("Bar", bar);
    workspace.tools.active = tool;
    workspace.selection = {{Handle::Kind::pin, 1, 0}};
    settle();
  }
  const Pin& pin() const { return deformation().pins[1]; }
  double ring() const {
    return kRingRadius * workspace.display.handle_px / workspace.display.viewport.zoom;
  }
  void ctrl_drag(Complex from, Complex to) {
    press(from, kCtrl);
    move(0.5 * (from + to), kCtrl);
    move(to, kCtrl);
    release(to, kCtrl);
  }
};

}  // namespace

TEST_CASE("Ring: Ctrl changes the radius of the held disk in one step") {
  for (const unsigned seed : seeds_of("held disk drags", {1, 2})) {
    std::mt19937 random(seed);
    // Shorter drags than two thresholds do nothing.
    const double by = std::uniform_real_distribution<double>(2 * kDragThresholdPx + 1, 40)(random);
    const Complex side =
        std::polar(1.0, std::uniform_real_distribution<double>(0, 2 * kPi)(random));
    for (const ToolId tool : {ToolId::pin, ToolId::select})
      for (const char* method : {"puppet", "arap"}) {
        INFO(method << ", seed " << seed);
        RingDesk desk(method, tool);
        const double before = held_radius(desk.deformation(), 1, nullptr).value();
        const Complex at = desk.pin().pose;
        const size_t steps = desk.steps();
        desk.ctrl_drag(at + desk.ring() * side, at + (desk.ring() + by) * side);
        CHECK(desk.pin().radius.value() == Approx(before + by));
        CHECK(desk.pin().angle == 0.25);
        CHECK(desk.steps() == steps + 1);
        // The edge of the disk can be dragged as well.
        const double now = desk.pin().radius.value();
        desk.ctrl_drag(at + now * side, at + (now + 20) * side);
        CHECK(desk.pin().radius.value() == Approx(now + 20));
        CHECK(!desk.deformation().pins[0].radius);
        const Scene read = scene_from_json(json_of(desk.workspace.document.scene()), "ring.json");
        CHECK(read.layers[0]->deformation.pins[1].radius.value() == Approx(now + 20));
      }
  }
}

TEST_CASE("Ring: a drag without Ctrl rotates, and keeps the held disk") {
  RingDesk desk("puppet", ToolId::pin);
  const Complex at = desk.pin().pose;
  desk.drag(at + desk.ring(), at + std::polar(desk.ring(), 1.0));
  CHECK(desk.pin().angle.value() == Approx(1.25));
  CHECK(!desk.pin().radius);
}

TEST_CASE("Ring: the radius stays within the size of the cage") {
  RingDesk desk("puppet", ToolId::pin);
  const Complex at = desk.pin().pose;
  desk.ctrl_drag(at + desk.ring(), at + 5000.0);
  CHECK(desk.pin().radius.value() <= 610);
  desk.ctrl_drag(at + desk.ring(), at + Complex(0.5, 0));
  CHECK(desk.pin().radius.value() > 0);
}

TEST_CASE("Ring: it goes to the pin that is pressed, before the drag ends") {
  for (const ToolId tool : {ToolId::pin, ToolId::select}) {
    RingDesk desk("sheet", tool);
    const Complex first = desk.deformation().pins[0].pose;
    desk.hover(first);
    CHECK(desk.tool().overlay().ring == 1);
    desk.press(first);
    desk.move(first + Complex(10, 10));
    CHECK(desk.tool().overlay().ring == 0);
    CHECK_FALSE(desk.tool().overlay().ring_hovered);
    desk.release(first + Complex(10, 10));
  }
}

TEST_CASE("Ring: a pin that turned with the picture starts from there, and has its number") {
  for (const char* method : {"sheet", "puppet", "arap", "pins"}) {
    CAPTURE(method);
    Deformation bar = pinned_bar(method);
    // The right half of the bar turns.
    bar.pins[2].pose = {480, 220};
    TestWorkspace desk;
    desk.workspace.commit("Bar", bar);
    desk.workspace.tools.active = ToolId::select;
    desk.workspace.selection = {{Handle::Kind::pin, 2, 0}};
    desk.settle();
    const double turn = rotation_at(desk.workspace, 2);
    CHECK(turn > 0.2);
    CHECK(turn < 2);
    const double radius =
        kRingRadius * desk.workspace.display.handle_px / desk.workspace.display.viewport.zoom;
    const Complex at = bar.pins[2].pose;
    desk.press(at + radius * kI);
    desk.move(at + radius * kI * std::polar(1.0, 0.1));
    desk.move(at + radius * kI * std::polar(1.0, 0.2));
    desk.release(at + radius * kI * std::polar(1.0, 0.2));
    REQUIRE(desk.deformation().pins[2].angle);
    CHECK(std::abs(*desk.deformation().pins[2].angle - turn - 0.2) < 0.02);
    CHECK(rotation_at(desk.workspace, 2) == *desk.deformation().pins[2].angle);
  }
}

TEST_CASE("Ring: it is hidden and cannot be dragged where handles are hidden") {
  for (const bool holds : {false, true}) {
    RingDesk desk("sheet", ToolId::select);
    (holds ? desk.workspace.display.hide_overlays : desk.workspace.display.show_cage) = holds;
    const Complex at = desk.pin().pose + desk.ring();
    desk.drag(at, desk.pin().pose + desk.ring() * kI);
    CHECK(desk.pin().angle == 0.25);
  }
}

}  // namespace holomorph::pin_ring_test
