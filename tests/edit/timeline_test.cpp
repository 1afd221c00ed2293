// The timeline: what is displayed at a time, what edits at a time do, and how time advances.
#include "edit/timeline.h"
#include "edit/actions/actions.h"
#include "edit/edits/curve_edits.h"
#include "edit/edits/method_edits.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::timeline_test {

namespace {

const Points kBar{{0, 0}, {300, 0}, {300, 100}, {0, 100}};

void act(TestWorkspace& desk, const char* id) {
  run(id, desk.workspace);
  desk.update();
}

void go_to(TestWorkspace& desk, double time) {
  desk.workspace.go_to_time(time);
  desk.update();
}

/// A bar with keyframes at 0 (at rest) and at 1 s (moved to the right by 40).
void set_two_keys(TestWorkspace& desk) {
  act(desk, "time.key");
  desk.workspace.shown.timeline.go_to(1);
  desk.workspace.shown.timeline.active = false;
  Deformation moved = desk.deformation();
  for (Points& segment : moved.pose.segments) segment[0] += 40.0;
  desk.workspace.commit("Move", moved);
  act(desk, "time.key");
}

}  // namespace

TEST_CASE("Timeline: between two keyframes, the blended picture is displayed") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  CHECK(desk.deformation().keyframes.size() == 2);
  CHECK(desk.workspace.shown.timeline.visible);
  go_to(desk, 0.5);
  CHECK(desk.deformation().pose.vertex(0).real() == Approx(20).margin(1e-3));
  CHECK(desk.workspace.shown.own().pose.vertex(0) == 40.0);  // the scene's own pose is unchanged
  CHECK(desk.workspace.map().map().f[0].real() -
            desk.workspace.map().prepared()->mesh->vertices[0].real() ==
        Approx(20).margin(1e-2));
}

TEST_CASE("Timeline: editing the pose stops displaying a time, and undo displays it again") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  go_to(desk, 0.5);
  const size_t steps = desk.steps();
  const Complex from = desk.deformation().pose.vertex(2);
  desk.press(from);
  desk.move({380, 170});
  desk.workspace.update_map({});  // as the window does during a drag
  desk.move({400, 200});
  desk.release({400, 200});
  CHECK_FALSE(desk.workspace.shown.timeline.active);
  CHECK(std::abs(desk.deformation().pose.vertex(2) - Complex(400, 200)) < 1e-6);
  CHECK(desk.deformation().pose.vertex(0).real() == Approx(20).margin(1e-3));
  CHECK(desk.deformation().keyframes.size() == 2);
  CHECK(desk.steps() == steps + 1);
  go_to(desk, 0.9);
  CHECK_FALSE(desk.workspace.messages.toasts.empty());  // the pose has no keyframe
  act(desk, "edit.undo");
  CHECK(desk.workspace.shown.timeline.time == 0.5);  // the time of the edit
  CHECK(desk.workspace.shown.timeline.active);
  CHECK_THAT(desk.deformation().pose.vertex(2).real(), Catch::WithinAbs(320, 1e-3));
  act(desk, "edit.redo");
  act(desk, "time.key");  // stores the pose as a keyframe
  CHECK(desk.deformation().keyframes.size() == 3);
  CHECK(desk.workspace.shown.timeline.active);
  CHECK(std::abs(desk.deformation().keyframes[1].pose.cage.vertex(2) - Complex(400, 200)) < 1e-6);
}

TEST_CASE("Timeline: with auto-key, edits of the pose set keyframes") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  act(desk, "time.auto_key");
  go_to(desk, 0.5);
  desk.drag(desk.deformation().pose.vertex(2), Complex(400, 200));
  desk.update();
  CHECK(desk.workspace.shown.timeline.active);
  REQUIRE(desk.deformation().keyframes.size() == 3);
  CHECK(desk.deformation().keyframes[1].time == 0.5);
  CHECK(std::abs(desk.deformation().pose.vertex(2) - Complex(400, 200)) < 1e-3);
  CHECK(desk.workspace.shown.own().pose.vertex(2) ==
        Complex(340, 100));  // the scene's own pose is unchanged
  act(desk, "edit.undo");
  CHECK(desk.deformation().keyframes.size() == 2);
  // The time is still displayed, so the next edit starts from the pose at this time.
  CHECK(desk.workspace.shown.timeline.active);
  CHECK(desk.deformation().pose.vertex(0).real() == Approx(20).margin(1e-3));
}

TEST_CASE("Timeline: Delete removes the keyframe that was clicked, not points") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  go_to(desk, 1);
  CHECK_FALSE(desk.workspace.actions.named("edit.delete").enabled(desk.workspace));
  const int layer = desk.workspace.document.scene().layer().id;
  desk.workspace.shown.timeline.keys = {{layer, 1.0}};  // as the panel does
  act(desk, "edit.delete");
  CHECK(desk.workspace.shown.own().keyframes.size() == 1);
  CHECK(desk.workspace.shown.own().rest.size() == 4);
  act(desk, "edit.undo");
  go_to(desk, 0.5);  // at another time, no keyframe is selected
  CHECK_FALSE(desk.workspace.actions.named("edit.delete").enabled(desk.workspace));
}

TEST_CASE("Timeline: an edit whose result is the scene's own pose is not lost") {
  for (const bool auto_key : {false, true}) {
    TestWorkspace desk(kBar);
    set_two_keys(desk);
    desk.workspace.shown.timeline.auto_key = auto_key;
    // The scene's own pose equals the second keyframe's. Copy the pose there and paste it at the
    // first keyframe.
    go_to(desk, 1);
    act(desk, "time.copy");
    go_to(desk, 0);
    CHECK(desk.deformation().pose.vertex(0) == Complex(0, 0));
    act(desk, "time.paste");
    CHECK(desk.deformation().pose.vertex(0) == Complex(40, 0));
    CHECK(desk.workspace.shown.timeline.active == auto_key);
    if (auto_key) CHECK(desk.deformation().keyframes[0].pose.cage.vertex(0) == Complex(40, 0));
    act(desk, "edit.undo");
    go_to(desk, 0.5);
    act(desk, "edit.reset");
    CHECK(desk.deformation().pose.vertex(0) == Complex(0, 0));
  }
}

TEST_CASE("Timeline: while the picture at a time is being prepared, no keyframe is changed") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  go_to(desk, 0);
  desk.workspace.commit("Method", with_method(desk.deformation(), "harmonic"));
  desk.workspace.go_to_time(0.5);
  CHECK_FALSE(desk.workspace.shown.knows_pose());
  act(desk, "time.key");
  CHECK(desk.workspace.shown.own().keyframes.size() == 2);
  // If only the method changes, the handles at the displayed time are still known.
  desk.settle();
  go_to(desk, 1);
  desk.workspace.commit("Method", with_method(desk.deformation(), "mean_value"));
  act(desk, "time.key");
  CHECK(desk.workspace.shown.own().keyframes[1].pose.cage.vertex(0) == Complex(40, 0));
}

TEST_CASE("Timeline: a keyframe set during a rotation does not change the rotation") {
  TestWorkspace desk(kBar);
  act(desk, "time.key");
  desk.workspace.shown.timeline.time = 1;
  act(desk, "time.key");
  for (const int turns : {1, -2})
    for (const double time : {0.25, 0.4, 0.5, 0.625, 0.75}) {
      Deformation deformation = desk.workspace.shown.own();
      deformation.keyframes[1].turns = turns;
      deformation.keyframes[0].ease = Ease::linear;
      desk.workspace.commit("Turns", deformation, EditBase::document);
      const auto turned = [&](double at) {
        go_to(desk, at);
        return desk.workspace.map().motion().rotation_between(0, at);
      };
      const double before = turned(0.9), mid = turned(time);
      CHECK_THAT(before, Catch::WithinAbs(0.9 * 2 * kPi * turns, 1e-6));
      act(desk, "time.key");
      REQUIRE(desk.workspace.shown.own().keyframes.size() == 3);
      CHECK(desk.workspace.shown.own().keyframes[1].ease == Ease::linear);
      INFO(turns << " turns, a keyframe at " << time);
      CHECK_THAT(turned(time), Catch::WithinAbs(mid, 1e-6));
      CHECK_FALSE(desk.workspace.map().injectivity().folds());
      CHECK_THAT(turned(0.9), Catch::WithinAbs(before, 1e-6));
      act(desk, "edit.undo");
    }
}

TEST_CASE("Timeline: edits of keyframes do not set poses, even with auto-key") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  act(desk, "time.auto_key");
  go_to(desk, 0);
  const Pose first = desk.workspace.shown.own().keyframes[0].pose;
  const size_t steps = desk.steps();
  Workspace& w = desk.workspace;
  const int layer = w.document.scene().layer().id;
  REQUIRE(w.commit_layers("Ease", with_keys_eased(w.document.scene(), {{layer, 0}}, Ease::hold)));
  CHECK(desk.workspace.shown.own().keyframes[0].pose == first);
  CHECK(desk.steps() == steps + 1);
  CHECK(desk.workspace.shown.timeline.active);
  desk.update();
  for (const double time : {1.25, 1.5, 1.75}) {
    const double from = w.shown.own().keyframes[1].time;
    const auto moved = with_keys_moved(w.document.scene(), {{layer, from}}, {1, from, time});
    REQUIRE(moved);
    REQUIRE(w.commit_or_amend_layers("Move key", moved->scene));
    desk.workspace.go_to_time(time);
    desk.update();
  }
  CHECK(desk.workspace.shown.own().keyframes.size() == 2);
  CHECK(desk.workspace.shown.own().keyframes[1].time == 1.75);
  go_to(desk, 0);
  act(desk, "time.delete_key");
  CHECK(desk.workspace.shown.own().keyframes.size() == 1);
}

TEST_CASE("Timeline: a layer that loses its last keyframes stays as it is displayed") {
  for (const double time : {0.0, 0.25, 0.5, 0.9, 1.0, 3.0}) {
    CAPTURE(time);
    TestWorkspace desk(kBar);
    Workspace& w = desk.workspace;
    set_two_keys(desk);
    Deformation far = desk.deformation();
    for (Points& segment : far.pose.segments) segment[0] += Complex(0, 90);
    w.commit("Another own pose", far, EditBase::document);
    go_to(desk, time);
    const VectorXc before = w.map().map().f;
    w.shown.timeline.keys = all_keys(w.document.scene());
    act(desk, "time.delete_key");
    REQUIRE(w.shown.own().keyframes.empty());
    CHECK((w.map().map().f - before).cwiseAbs().maxCoeff() <= 1e-2);
    act(desk, "edit.undo");
    CHECK(w.shown.own().keyframes.size() == 2);
    CHECK(w.shown.own().pose.vertex(0).imag() == 90);
  }
}

TEST_CASE("Timeline: of several layers, those that lose their keyframes stay as displayed") {
  TestWorkspace desk(kBar);
  Workspace& w = desk.workspace;
  set_two_keys(desk);
  Scene two = w.document.scene();
  Layer second = two.layer();
  second.id = 77;
  second.deformation.keyframes.pop_back();  // one at rest
  two.layers.push_back(std::move(second));
  REQUIRE(w.commit_layers("Second layer", two));
  const auto settle_others = [&] {
    do desk.update();
    while (!w.maps.of(77).has_map() || w.maps.of(77).busy());
  };
  go_to(desk, 0.5);
  settle_others();
  const VectorXc before = w.map().map().f, before_77 = w.maps.of(77).map().f;
  w.shown.timeline.keys = all_keys(w.document.scene());
  act(desk, "time.delete_key");
  settle_others();
  CHECK_FALSE(has_keyframes(w.document.scene()));
  CHECK((w.map().map().f - before).cwiseAbs().maxCoeff() <= 1e-2);
  CHECK((w.maps.of(77).map().f - before_77).cwiseAbs().maxCoeff() <= 1e-2);
}

TEST_CASE("Timeline: selected keyframes are copied and pasted at the current time") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  Workspace& w = desk.workspace;
  const int layer = w.document.scene().layer().id;
  const size_t before = w.shown.own().keyframes.size();
  const Pose second = w.shown.own().keyframes[1].pose;
  w.shown.timeline.keys = {{layer, w.shown.own().keyframes[1].time}};
  act(desk, "time.copy");
  w.go_to_time(4);
  act(desk, "time.paste");
  REQUIRE(w.shown.own().keyframes.size() == before + 1);
  CHECK(w.shown.own().keyframes.back().time == 4);
  CHECK(w.shown.own().keyframes.back().pose == second);
  // The copies are as they were when they were copied, even if the original is changed or cut.
  Deformation other = w.document.scene().deformation();
  for (Points& segment : other.keyframes[1].pose.cage.segments) segment[0] += 17.0;
  w.commit("Change keyframe", other, EditBase::document);
  REQUIRE(w.shown.own().keyframes[1].pose != second);
  w.go_to_time(6);
  act(desk, "time.paste");
  CHECK(w.shown.own().keyframes.back().pose == second);
  w.shown.timeline.keys = all_keys(w.document.scene());
  const size_t all = w.shown.timeline.keys.size();
  const std::vector<Keyframe> cut = w.shown.own().keyframes;
  act(desk, "time.copy");
  act(desk, "time.delete_key");
  CHECK(w.shown.own().keyframes.empty());
  w.go_to_time(10);
  REQUIRE(w.actions.named("time.paste").enabled(w));
  act(desk, "time.paste");
  REQUIRE(w.shown.own().keyframes.size() == all);
  for (size_t k = 0; k < all; ++k) {
    CHECK(w.shown.own().keyframes[k].pose == cut[k].pose);
    CHECK(w.shown.own().keyframes[k].time == Approx(cut[k].time + 10));
  }
  // Copies do not fit a cage with other points.
  act(desk, "edit.undo");
  act(desk, "edit.undo");
  w.commit("Insert point", inserted(w.document.scene().deformation(), 0, 0.5), EditBase::document);
  CHECK(fitting(w.document.scene(), w.copied_keys).empty());
  // Without selected keyframes, a pose is copied again.
  w.shown.timeline.keys.clear();
  desk.update();
  go_to(desk, 0);
  act(desk, "time.copy");
  CHECK(w.copied_keys.empty());
  CHECK(w.copied.has_value());
}

TEST_CASE("Timeline: playback stops at a whole frame") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  Workspace& w = desk.workspace;
  act(desk, "time.play");
  w.shown.timeline.time = 0.33168;
  act(desk, "time.play");
  CHECK_FALSE(w.shown.timeline.playing);
  CHECK(w.shown.timeline.time == Approx(8 / 24.0));
}

TEST_CASE("Timeline: two drags of a keyframe are two steps") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  const size_t steps = desk.steps();
  Workspace& w = desk.workspace;
  for (const double time : {1.25, 1.5}) {
    w.end_mergeable_step();  // as the panel does on a press
    for (const double nearer : {time - 0.125, time}) {
      const double from = w.shown.own().keyframes[1].time;
      const auto moved = with_keys_moved(
          w.document.scene(), {{w.document.scene().layer().id, from}}, {1, from, nearer});
      REQUIRE(moved);
      REQUIRE(w.commit_or_amend_layers("Move key", moved->scene));
    }
  }
  CHECK(desk.steps() == steps + 2);
  act(desk, "edit.undo");
  CHECK(w.shown.own().keyframes[1].time == 1.25);
}

TEST_CASE("Timeline: auto-key refuses more keyframes than a file may contain") {
  TestWorkspace desk(kBar);
  Deformation deformation = desk.deformation();
  for (size_t i = 0; i < kMaxKeyframes; ++i)
    deformation.keyframes.push_back({static_cast<double>(i), whole_pose_of(deformation)});
  REQUIRE(desk.workspace.commit("Many keys", deformation, EditBase::document));
  desk.workspace.shown.timeline.auto_key = true;
  desk.workspace.shown.timeline.time = 0.5;
  Deformation moved = deformation;
  moved.pose.segments[0][0] += 5.0;
  CHECK_FALSE(desk.workspace.commit("Move", moved));
  CHECK(desk.workspace.messages.toasts.back().problem);
  CHECK_FALSE(desk.workspace.amend(moved));
  CHECK(desk.workspace.shown.own() == deformation);
}

TEST_CASE("Timeline: edits that do not change the pose keep the scene's own pose and the time") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  go_to(desk, 0.25);
  Deformation other = with_method(desk.deformation(), "harmonic");
  desk.workspace.commit("Method", other);
  CHECK(desk.workspace.shown.timeline.active);
  CHECK(desk.workspace.shown.own().pose.vertex(0) == 40.0);
  // A point is inserted in all keyframes, and the displayed pose becomes the scene's own pose.
  desk.settle();
  desk.update();
  desk.workspace.commit("Insert", inserted(desk.deformation(), 0, 0.5));
  CHECK(playing_keys(desk.workspace.shown.own()).size() == 2);
  CHECK(desk.deformation().keyframes[1].pose.cage.vertex(1) == Complex(190, 0));
  CHECK(desk.workspace.shown.own().pose.vertex(0).real() == Approx(6.25).margin(0.01));
}

TEST_CASE("Timeline: a pin set at a time gets the position of its image in every keyframe") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  go_to(desk, 1);
  desk.workspace.tools.active = ToolId::pin;
  desk.click({190, 50});
  const Deformation& deformation = desk.workspace.shown.own();
  REQUIRE(deformation.pins.size() == 1);
  CHECK(playing_keys(deformation).size() == 2);
  CHECK(std::abs(deformation.keyframes[0].pose.pins[0].position - Complex(150, 50)) < 0.1);
  CHECK(std::abs(deformation.keyframes[1].pose.pins[0].position - Complex(190, 50)) < 0.1);
}

TEST_CASE("Timeline: a stroke drawn at a time gets the position of its image in every keyframe") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  go_to(desk, 1);
  desk.workspace.tools.active = ToolId::stroke;
  desk.draw({{120, 50}, {160, 52}, {220, 50}});
  const Deformation& deformation = desk.workspace.shown.own();
  REQUIRE(deformation.strokes.size() == 1);
  CHECK(playing_keys(deformation).size() == 2);
  const Points &first = deformation.keyframes[0].pose.strokes[0],
               &second = deformation.keyframes[1].pose.strokes[0];
  CHECK(std::abs(second.front() - Complex(120, 50)) < 0.1);
  REQUIRE(first.size() == second.size());
  for (size_t i = 0; i < first.size(); ++i)
    CHECK(std::abs(second[i] - first[i] - Complex(40, 0)) < 0.1);
}

TEST_CASE("Timeline: the onion skin shows the keyframes before and after") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  go_to(desk, 0.5);
  CHECK(desk.workspace.onion_skins().empty());
  act(desk, "time.onion");
  const std::vector<OnionSkin> skins = desk.workspace.onion_skins();
  REQUIRE(skins.size() == 2);
  const double rest = desk.workspace.map().prepared()->mesh->vertices[0].real();
  CHECK(skins[0].f[0].real() == Approx(rest).margin(1e-3));
  CHECK(skins[1].f[0].real() == Approx(rest + 40).margin(1e-3));
  // While the scene's own pose is displayed, the onion skin shows the current keyframes.
  Deformation deformation = desk.workspace.shown.own();
  for (Points& segment : deformation.keyframes[1].pose.cage.segments) segment[0] += 7.0;
  desk.workspace.commit("Key", deformation, EditBase::document);
  desk.workspace.shown.timeline.active = false;
  desk.update();
  CHECK(desk.workspace.onion_skins().back().f[0].real() == Approx(rest + 47).margin(1e-3));
  deformation.keyframes.insert(deformation.keyframes.begin() + 1,
                               {0.75, deformation.keyframes[0].pose});
  deformation.keyframes[1].pose.pins.push_back({{5, 5}});  // does not play
  desk.workspace.commit("Hollow", deformation, EditBase::document);
  desk.update();
  CHECK(desk.workspace.onion_skins().back().f[0].real() == Approx(rest + 47).margin(1e-3));
  CHECK(desk.workspace.onion_skins().back().later);
  go_to(desk, 0);
  CHECK(desk.workspace.onion_skins().size() == 1);
}

namespace {

using MotionPath = Complex (*)(double seconds);

/// Half a circle from (300, 100) in two seconds, and a straight path from the same point.
Complex on_arc(double seconds) {
  return Complex(250, 100) + std::polar(50.0, kPi / 2 * seconds);
}
Complex straight(double seconds) {
  return Complex(300, 100) + seconds * Complex(150, 40);
}

/// A Ctrl-drag of two seconds with sixty frames per second.
void record(TestWorkspace& desk, MotionPath path = on_arc) {
  constexpr Modifiers kCtrl{true, false, false};
  desk.now_ms = 5000;
  desk.press(path(0), kCtrl);
  desk.move(path(0) + Complex(0, 4), kCtrl);  // the clock starts
  for (int i = 1; i <= 120; ++i) {
    desk.now_ms = 5000 + 1000.0 / 60 * i;
    desk.move(path(i / 60.0), kCtrl);
    desk.workspace.update_map({});
  }
  desk.release(path(2), kCtrl);
  desk.update();
}

}  // namespace

TEST_CASE("Timeline: a Ctrl-drag records motion with only a few keyframes") {
  TestWorkspace desk(kBar);
  const size_t steps = desk.steps();
  record(desk);
  const Deformation& deformation = desk.workspace.shown.own();
  CHECK(desk.steps() == steps + 1);
  CHECK(deformation.keyframes.size() >= 5);
  CHECK(deformation.keyframes.size() <= 15);
  CHECK(deformation.keyframes.front().time == 0);
  CHECK(length_of(desk.workspace.document.scene()) == 2);
  CHECK(deformation.pose.vertex(2) == Complex(300, 100));  // the scene's own pose is unchanged
  CHECK(desk.workspace.shown.timeline.active);
  for (const double time : {0.3, 0.77, 1.31, 1.9}) {
    go_to(desk, time);
    INFO("at " << time << " s");
    CHECK(std::abs(desk.deformation().pose.vertex(2) - on_arc(time)) < 4);
  }
  act(desk, "edit.undo");
  CHECK(desk.workspace.shown.own().keyframes.empty());
}

TEST_CASE("Timeline: a straight motion is recorded as it was drawn") {
  TestWorkspace desk(kBar);
  record(desk, straight);
  CHECK(desk.workspace.shown.own().keyframes.size() <= 10);
  for (const double time : {0.2, 0.9, 1.5, 1.95}) {
    go_to(desk, time);
    INFO("at " << time << " s");
    CHECK(std::abs(desk.deformation().pose.vertex(2) - straight(time)) < 3);
  }
  CHECK(length_of(desk.workspace.document.scene()) == 2);
}

TEST_CASE(
    "Timeline: a recording keeps keyframes that do not play, and the whole turns of other keys") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  Deformation deformation = desk.workspace.shown.own();
  deformation.keyframes[0].pose.pins.push_back({{5, 5}});  // a different structure
  deformation.keyframes.push_back({3, deformation.keyframes[1].pose});
  deformation.keyframes.back().turns = 1;
  desk.workspace.commit("Hollow", deformation, EditBase::document);
  const Keyframe hollow = deformation.keyframes[0];
  go_to(desk, 0);
  const Complex from = desk.deformation().pose.vertex(2);
  CHECK(from == Complex(340, 100));
  constexpr Modifiers kCtrl{true, false, false};
  desk.press(from, kCtrl);
  for (int i = 1; i <= 60; ++i) {
    desk.now_ms = 1000.0 / 30 * i;
    desk.move(from + Complex(0, i), kCtrl);
  }
  desk.release(from + Complex(0, 60), kCtrl);
  const Deformation& after = desk.workspace.shown.own();
  CHECK(after.keyframes[0] == hollow);
  CHECK(after.keyframes.back().time == 3);
  go_to(desk, 3);
  CHECK(desk.workspace.map().motion().rotation_between(0, 3) == Approx(2 * kPi).margin(0.05));
}

TEST_CASE("Timeline: tangents that do not exist in all keyframes are not recorded") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  Deformation deformation = desk.workspace.shown.own();
  Points& segment = deformation.keyframes[1].pose.cage.segments[0];
  segment = {segment[0], segment[0] + Complex(100, -30), segment[0] + Complex(200, -30)};
  desk.workspace.commit("Curved", deformation, EditBase::document);
  desk.settle();
  go_to(desk, 1);
  const Handle tangent{Handle::Kind::cage, 0, 1};
  REQUIRE(exists(desk.deformation(), tangent, EditMode::pose));
  const Complex at = position_of(desk.deformation(), tangent, EditMode::pose);
  const size_t steps = desk.steps();
  constexpr Modifiers kCtrl{true, false, false};
  desk.press(at, kCtrl);
  for (int i = 1; i <= 30; ++i) {
    desk.now_ms = 50.0 * i;
    desk.move(at + Complex(0, -i), kCtrl);
  }
  desk.release(at, kCtrl);
  CHECK(desk.steps() == steps);
  CHECK_FALSE(desk.workspace.shown.timeline.recording);
  CHECK_FALSE(desk.workspace.messages.toasts.empty());
  // The tangent's vertex is recorded, and it moves the tangents that exist.
  desk.workspace.selection.clear();
  const Complex vertex = desk.deformation().pose.vertex(0);
  desk.press(vertex, kCtrl);
  for (int i = 1; i <= 30; ++i) {
    desk.now_ms = 5000 + 50.0 * i;
    desk.move(vertex + Complex(-i, 0), kCtrl);
  }
  desk.release(vertex + Complex(-30, 0), kCtrl);
  CHECK(desk.steps() == steps + 1);
  CHECK(desk.workspace.shown.own().keyframes.back().pose.cage.vertex(0).real() ==
        Approx(vertex.real() - 30).margin(1));
}

TEST_CASE("Timeline: a document that is opened during a recording keeps its own time") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  go_to(desk, 0.75);
  const Complex from = desk.deformation().pose.vertex(2);
  desk.press(from, {true, false, false});
  desk.move(from + Complex(20, 0), {true, false, false});
  REQUIRE(desk.workspace.shown.timeline.recording);
  desk.workspace.open(Document());
  desk.tool().cancel(desk.workspace);
  CHECK(desk.workspace.shown.timeline.time == 0);
  CHECK_FALSE(desk.workspace.shown.timeline.recording);
}

TEST_CASE("Timeline: existing motion continues during a recording") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  act(desk, "edit.reset");  // the recording starts from the scene's own pose
  CHECK_FALSE(desk.workspace.shown.timeline.active);
  desk.workspace.shown.timeline.time = 0;
  record(desk);
  const Deformation& deformation = desk.workspace.shown.own();
  REQUIRE(deformation.keyframes.size() > 3);
  const size_t there = key_at(deformation, 1);
  REQUIRE(there < deformation.keyframes.size());
  CHECK(deformation.keyframes[there].pose.cage.vertex(0) == Complex(40, 0));
  CHECK(std::abs(deformation.keyframes[there].pose.cage.vertex(2) - on_arc(1)) < 1);
  CHECK(deformation.keyframes.back().pose.cage.vertex(0) == Complex(40, 0));
  go_to(desk, 0.5);
  CHECK(desk.deformation().pose.vertex(0).real() == Approx(20).margin(2));
}

TEST_CASE("Timeline: Escape cancels a recording, and a Ctrl-click records nothing") {
  TestWorkspace desk(kBar);
  constexpr Modifiers kCtrl{true, false, false};
  const size_t steps = desk.steps();
  desk.press({300, 100}, kCtrl);
  desk.now_ms = 700;
  desk.move({320, 120}, kCtrl);
  CHECK(desk.workspace.shown.timeline.recording);
  CHECK(desk.workspace.shown.timeline.time == 0);
  desk.now_ms = 1200;
  desk.move({330, 120}, kCtrl);
  CHECK(desk.workspace.shown.timeline.time == 0.5);  // (1200 - 700) / 1000, exact
  desk.tool().key(Key::escape, desk.workspace);
  CHECK_FALSE(desk.workspace.shown.timeline.recording);
  CHECK(desk.workspace.shown.timeline.time == 0);
  CHECK(desk.steps() == steps);
  desk.click({300, 100}, kCtrl);
  CHECK(desk.deformation().keyframes.empty());
  CHECK(is_smooth(desk.deformation(), 2, EditMode::pose));
}

TEST_CASE("Timeline: time advances, loops, and stops at the end") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  Timeline& timeline = desk.workspace.shown.timeline;
  const Scene& scene = desk.workspace.document.scene();
  timeline.go_to(0.2);
  timeline.playing = true;
  CHECK(advance(timeline, scene, 1000));
  CHECK(advance(timeline, scene, 1500));
  constexpr double kRounding = 1e-15;  // three operations on times below 2, 2^-53 each
  CHECK_THAT(timeline.time, Catch::WithinAbs(0.7, kRounding));
  CHECK(advance(timeline, scene, 2000));
  CHECK_THAT(timeline.time, Catch::WithinAbs(0.2, kRounding));
  timeline.loop = false;
  CHECK(advance(timeline, scene, 4000));
  CHECK(timeline.time == 1);
  CHECK_FALSE(timeline.playing);
  CHECK_FALSE(advance(timeline, scene, 4100));
}

TEST_CASE("Timeline: steps by frames and keyframes") {
  TestWorkspace desk(kBar);
  set_two_keys(desk);
  go_to(desk, 0);
  act(desk, "time.forward");
  CHECK(desk.workspace.shown.timeline.time == 1 / 24.0);
  act(desk, "time.next_key");
  CHECK(desk.workspace.shown.timeline.time == 1);
  act(desk, "time.next_key");
  CHECK(desk.workspace.shown.timeline.time == 1);
  act(desk, "time.back");
  act(desk, "time.previous_key");
  CHECK(desk.workspace.shown.timeline.time == 0);
  act(desk, "time.back");
  CHECK(desk.workspace.shown.timeline.time == 0);
  act(desk, "time.delete_key");
  CHECK(desk.workspace.shown.own().keyframes.size() == 1);
}

TEST_CASE("Timeline: poses are copied, pasted and mirrored") {
  TestWorkspace desk(kBar);
  desk.drag({300, 0}, {360, 10});
  act(desk, "time.copy");
  act(desk, "edit.undo");
  act(desk, "time.paste");
  CHECK(desk.deformation().pose.vertex(1) == Complex(360, 10));
  act(desk, "edit.undo");
  act(desk, "time.paste_mirrored");
  CHECK(desk.deformation().pose.vertex(0) == Complex(-60, 10));
  CHECK(desk.deformation().pose.vertex(1) == Complex(300, 0));
}

}  // namespace holomorph::timeline_test
