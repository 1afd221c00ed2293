// Editing the rest shape: points that are not posed follow, posed points keep their pose.

#include "edit/edits/rest_edits.h"
#include "edit/actions/actions.h"
#include "edit/edits/curve_edits.h"
#include "edit/tools/transform_box.h"
#include "scene/keyframes.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/seeds.h"

namespace holomorph::rest_edits_test {

namespace {

/// A curved star with pins, some of whose points and pins are posed.
Deformation partly_posed(std::mt19937& random) {
  Deformation deformation = with_cage(
      Deformation{}, shapes::curved_star(5 + static_cast<int>(random() % 6),
                                         1 + static_cast<int>(random() % 3), 0.1, random()));
  deformation.method = "pins";
  for (int i = 0; i < 4; ++i) {
    const Complex z = Complex(200, 200) + 40.0 * random_complex(random);
    deformation = with_pin(std::move(deformation), z, z);
  }
  for (const Handle& handle : handles_of(deformation, EditMode::pose))
    if (random() % 2 == 0)
      shift(deformation, handle, 30.0 * random_complex(random), EditMode::pose);
  return deformation;
}

Complex pose_at(const Deformation& deformation, const Handle& handle) {
  return position_of(deformation, handle, EditMode::pose);
}
Complex rest_at(const Deformation& deformation, const Handle& handle) {
  return position_of(deformation, handle, EditMode::rest);
}

/// Checks the rule for an edit of the rest shape that keeps the degrees.
void check_rule(const Deformation& before, const Deformation& after) {
  for (const Handle& handle : handles_of(before, EditMode::rest)) {
    INFO("handle " << static_cast<int>(handle.kind) << " " << handle.index << " "
                   << handle.control);
    if (pose_at(before, handle) == rest_at(before, handle))
      CHECK(pose_at(after, handle) == rest_at(after, handle));
    else
      CHECK(pose_at(after, handle) == pose_at(before, handle));
  }
}

}  // namespace

TEST_CASE("Moved rest points take along the points that are not posed") {
  for (const unsigned seed : seeds_of("rest edits", {1, 2, 3})) {
    std::mt19937 random(seed);
    for (int i = 0; i < 20; ++i) {
      INFO("seed " << seed << ", case " << i);
      const Deformation before = partly_posed(random);
      const std::vector<Handle> all = handles_of(before, EditMode::rest);
      Selection selection;
      for (const Handle& handle : all)
        if (random() % 3 == 0) selection.insert(handle);
      if (selection.empty()) selection.insert(all.front());
      const Complex by = 10.0 * random_complex(random);
      check_rule(before, moved(before, selection, by, EditMode::rest));
      check_rule(before, transformed(before, selection, Affine::turning(0.3, {200, 200}), 0.3,
                                     EditMode::rest));
      check_rule(before, placed(before, *selection.begin(), Complex(200, 200), EditMode::rest));
      if (is_tangent(*selection.rbegin()) && selection.rbegin()->kind == Handle::Kind::cage)
        check_rule(before, tangent_moved(before, *selection.rbegin(), Complex(250, 220),
                                         EditMode::rest, false));
      // The pose alone never changes the rest shape.
      const Deformation posed = moved(before, selection, by, EditMode::pose);
      CHECK_FALSE(differs_at_rest(before, posed));
    }
  }
}

TEST_CASE("Keyframes follow the rest shape by the same rule") {
  std::mt19937 random(4);
  Deformation deformation = partly_posed(random);
  deformation.keyframes = {Keyframe{0, whole_pose_of(at_rest(deformation))},
                           Keyframe{1, whole_pose_of(deformation)}};
  const Selection one{{Handle::Kind::cage, 0, 0}};
  const Deformation after = moved(deformation, one, {7, 5}, EditMode::rest);
  CHECK(after.keyframes[0].pose == whole_pose_of(at_rest(after)));
  check_rule(posed_as(deformation, deformation.keyframes[1].pose),
             posed_as(after, after.keyframes[1].pose));
}

TEST_CASE("A drag, a nudge and a curve of the rest shape leave an unposed picture at rest") {
  TestWorkspace desk(shapes::rectangle(200, 200));
  run("cage.rest", desk.workspace);
  desk.drag({200, 200}, {220, 230});
  CHECK(desk.deformation().rest.vertex(2) == Complex(220, 230));
  CHECK(desk.deformation().pose == desk.deformation().rest);
  desk.workspace.selection = {{Handle::Kind::cage, 1, 0}};
  run("edit.nudge_right", desk.workspace);
  CHECK(desk.deformation().pose == desk.deformation().rest);
  run("cage.raise", desk.workspace);
  CHECK(desk.deformation().rest.degree(1) == 2);
  CHECK(desk.deformation().pose == desk.deformation().rest);
}

TEST_CASE("With auto-key, an edit of the rest shape sets no keyframe") {
  TestWorkspace desk(shapes::rectangle(200, 200));
  Workspace& w = desk.workspace;
  w.shown.timeline.auto_key = true;
  run("cage.rest", w);
  desk.drag({200, 200}, {220, 230});
  CHECK(desk.deformation().keyframes.empty());
}

}  // namespace holomorph::rest_edits_test
