// Drags of keyframes on the timeline.
#include "edit/tools/key_drag.h"

#include "edit/actions/actions.h"
#include "scene/layers.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::key_drag_test {

namespace {

/// Two layers with keyframes at 0, 1, 2 and 0, 1.
struct Keyed {
  TestWorkspace desk{Points{}};
  Workspace& w = desk.workspace;
  Timeline& timeline = w.shown.timeline;

  Keyed() {
    std::vector<Layer> layers(2);
    for (int i = 0; i < 2; ++i) {
      layers[i].id = i + 1;
      Deformation& deformation = layers[i].deformation;
      deformation = with_cage({}, shapes::rectangle(100, 50));
      for (const double time : {0.0, 1.0, 2.0}) {
        if (i == 1 && time > 1) break;
        deformation.pose.segments[0][0] = Complex(-time, time);
        deformation = with_key(std::move(deformation), time);
      }
    }
    Scene scene;
    scene.layers = shared(layers);
    REQUIRE(w.commit_layers("Add", scene));
  }
  std::vector<double> times(size_t layer) const {
    std::vector<double> all;
    for (const Keyframe& key : w.document.scene().layers[layer]->deformation.keyframes)
      all.push_back(key.time);
    return all;
  }
  void drag(KeyDrag::Kind kind, double from, const std::vector<double>& path, bool freely = false) {
    KeyDrag drag;
    drag.start(w, kind, from);
    for (const double time : path) drag.follow(w, time, freely);
    drag.end();
  }
};

using Times = std::vector<double>;

}  // namespace

TEST_CASE("key drag: one step, on whole frames, past other keys but never onto them") {
  Keyed keyed;
  const size_t steps = keyed.desk.steps();
  keyed.timeline.keys = {{1, 0.0}, {2, 0.0}};
  keyed.drag(KeyDrag::Kind::move, 0, {0.2, 0.51, 1.0, 1.26});
  CHECK(keyed.times(0) == Times{1, 1.25, 2});
  CHECK(keyed.times(1) == Times{1, 1.25});
  CHECK(keyed.timeline.keys == KeySelection{{1, 1.25}, {2, 1.25}});
  CHECK(keyed.desk.steps() == steps + 1);
  // A second drag is a step of its own. It waits in front of the key at 2.
  keyed.timeline.keys = {{1, 1.0}};
  keyed.drag(KeyDrag::Kind::move, 1, {1.5, 2.0});
  CHECK(keyed.times(0) == Times{1.25, 1.5, 2});
  CHECK(keyed.desk.steps() == steps + 2);
  run(keyed.w.actions.named("edit.undo"), keyed.w);
  run(keyed.w.actions.named("edit.undo"), keyed.w);
  CHECK(keyed.times(0) == Times{0, 1, 2});
}

TEST_CASE("key drag: to the start at most, and freely with Alt") {
  Keyed keyed;
  keyed.timeline.keys = {{1, 1.0}, {1, 2.0}};
  keyed.drag(KeyDrag::Kind::move, 2, {1.7, 1.513}, true);
  CHECK(keyed.times(0)[1] == Approx(0.513));
  CHECK(keyed.times(0)[2] == Approx(1.513));
  keyed.timeline.keys = {{2, 1.0}};
  keyed.drag(KeyDrag::Kind::move, 1, {0.5, -3.0});
  CHECK(keyed.times(1) == Times{0, 0.5});  // 0 is taken
}

TEST_CASE("key drag: the bars of the box stretch time, copies stay") {
  Keyed keyed;
  keyed.timeline.keys = {{1, 0.0}, {1, 1.0}, {1, 2.0}, {2, 1.0}};
  keyed.drag(KeyDrag::Kind::stretch_end, 2, {2.5, 4.0});
  CHECK(keyed.times(0) == Times{0, 2, 4});
  CHECK(keyed.times(1) == Times{0, 2});
  keyed.drag(KeyDrag::Kind::stretch_start, 0, {1.0, 2.0});
  CHECK(keyed.times(0) == Times{2, 3, 4});
  // Squeezed until they would meet.
  keyed.drag(KeyDrag::Kind::stretch_end, 4, {2.5, 0.0, -9.0});
  CHECK(keyed.times(0).size() == 3);
  CHECK(keyed.times(0)[2] == Approx(2.5).margin(1e-9));

  Keyed other;
  other.timeline.keys = {{1, 1.0}, {2, 1.0}};
  other.drag(KeyDrag::Kind::copy, 1, {1.4, 1.5});
  CHECK(other.times(0) == Times{0, 1, 1.5, 2});
  CHECK(other.times(1) == Times{0, 1, 1.5});
}

TEST_CASE("key drag: each drag is one step, in the rest shape too") {
  Keyed keyed;
  keyed.w.mode = EditMode::rest;
  keyed.timeline.keys = {{1, 0.0}, {1, 1.0}, {1, 2.0}};
  size_t steps = keyed.desk.steps();
  keyed.drag(KeyDrag::Kind::stretch_end, 2, {2.2, 2.5, 3.0});
  CHECK(keyed.desk.steps() == steps + 1);
  // The second stretch begins with positions that round to the same frames.
  keyed.drag(KeyDrag::Kind::stretch_end, 3, {3.001, 3.002, 4.0});
  CHECK(keyed.desk.steps() == steps + 2);
  run(keyed.w.actions.named("edit.undo"), keyed.w);
  CHECK(keyed.times(0) == Times{0, 1.5, 3});
  // A drag that goes nowhere is no step.
  steps = keyed.desk.steps();
  keyed.timeline.keys = {{1, 1.5}};
  keyed.drag(KeyDrag::Kind::move, 1.5, {1.501, 1.499});
  CHECK(keyed.desk.steps() == steps);
}

TEST_CASE("key actions: duplicate at the current time, delete all in one step") {
  Keyed keyed;
  Workspace& w = keyed.w;
  run(w.actions.named("time.select_keys"), w);
  CHECK(keyed.timeline.keys.size() == 5);
  w.go_to_time(3);
  run(w.actions.named("time.copy_keys"), w);
  CHECK(keyed.times(0) == Times{0, 1, 2, 3, 4, 5});
  CHECK(keyed.times(1) == Times{0, 1, 3, 4});
  CHECK(keyed.timeline.keys.size() == 5);
  const size_t steps = keyed.desk.steps();
  run(w.actions.named("edit.delete"), w);
  CHECK(keyed.times(0) == Times{0, 1, 2});
  CHECK(keyed.times(1) == Times{0, 1});
  CHECK(keyed.desk.steps() == steps + 1);
  CHECK(keyed.timeline.keys.empty());
}

}  // namespace holomorph::key_drag_test
