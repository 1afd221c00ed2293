// The Select tool drags the layer under the pointer.
#include "edit/tools/layer_drag.h"

#include "edit/actions/actions.h"
#include "scene/keyframes.h"
#include "scene/layers.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/seeds.h"

namespace holomorph::layer_drag_test {

namespace {

/// A picture that is opaque in the left half only.
Image half_opaque(int width, int height) {
  Image image(width, height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width / 2; ++column) image.at(column, row)[3] = 255;
  return image;
}

/// A lower layer with a cage and an upper layer without one. Both show their left half.
struct Stack {
  TestWorkspace desk{Points{}};
  Workspace& w = desk.workspace;

  Stack() {
    Scene scene;
    std::vector<Layer> layers;
    for (const int size : {200, 100}) {
      const std::string file = "/nowhere/" + std::to_string(size) + ".png";
      const Picture picture{std::make_shared<const Image>(half_opaque(size, size)), "", {}};
      Layer layer;
      layer.id = size;
      layer.image = described(reference_in(file), picture);
      w.document.put_picture(*layer.image, picture);
      if (size == 200) layer.deformation = with_cage({}, shapes::rectangle(200, 200));
      layers.push_back(layer);
    }
    scene.layers = shared(layers);
    scene.edited = 1;
    REQUIRE(w.commit_layers("Add", scene));
    settle();
    w.tools.active = ToolId::select;
  }
  void settle() {
    for (int i = 0; i < 2000; ++i) {
      w.update_map({});
      if (!w.map().busy() && !w.maps.of(200).busy()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  const Deformation& lower() const { return w.document.scene().layers[0]->deformation; }
  const Deformation& upper() const { return w.document.scene().layers[1]->deformation; }
};

}  // namespace

TEST_CASE("The layer under the pointer is the topmost one with a visible pixel there") {
  Stack stack;
  CHECK(layer_at(stack.w, stack.w.display.viewport.px_at_plane({20, 50})) == 1u);  // both
  CHECK(layer_at(stack.w, stack.w.display.viewport.px_at_plane({70, 50})) ==
        0u);  // the upper one is transparent here
  CHECK(layer_at(stack.w, stack.w.display.viewport.px_at_plane({20, 150})) ==
        0u);  // beyond the upper one
  CHECK_FALSE(
      layer_at(stack.w, stack.w.display.viewport.px_at_plane({150, 150})));  // both are transparent
  CHECK_FALSE(layer_at(stack.w, stack.w.display.viewport.px_at_plane({-5, 50})));
  run("layer.visible", stack.w);
  CHECK(layer_at(stack.w, stack.w.display.viewport.px_at_plane({20, 50})) == 0u);
}

TEST_CASE("A drag moves the layer under the pointer, in one step, and gives it a box if needed") {
  Stack stack;
  const size_t steps = stack.desk.steps();
  stack.desk.drag({20, 50}, {50, 70});
  CHECK(stack.desk.steps() == steps + 1);
  CHECK(stack.upper().pose.vertex(0) == Complex(30, 20));
  CHECK(stack.upper().rest.vertex(0) == Complex(0, 0));
  CHECK(stack.lower().pose == stack.lower().rest);
  stack.settle();
  stack.desk.drag({20, 180}, {20, 160});  // the lower layer
  CHECK(stack.w.document.scene().edited == 0);
  CHECK(stack.lower().pose.vertex(0) == Complex(0, -20));
  CHECK(stack.upper().pose.vertex(0) == Complex(30, 20));
  run("edit.undo", stack.w);
  CHECK(stack.lower().pose == stack.lower().rest);
}

TEST_CASE("A click selects the layer without a step, and locked layers stay") {
  Stack stack;
  const size_t steps = stack.desk.steps();
  stack.desk.click({70, 50});
  CHECK(stack.w.document.scene().edited == 0);
  CHECK(stack.desk.steps() == steps);
  run("layer.lock", stack.w);
  const Scene before = stack.w.document.scene();
  stack.settle();
  stack.desk.drag({70, 50}, {90, 90});
  CHECK(stack.w.document.scene() == before);
}

TEST_CASE("A locked or hidden layer gives way to the layer under the pointer") {
  for (const char* closes : {"layer.lock", "layer.visible"}) {
    Stack stack;
    run(closes, stack.w);
    const Complex lower = stack.w.display.viewport.px_at_plane({70, 50});
    leave_closed_layer(stack.w, lower);
    CHECK(stack.w.document.scene().edited == 0);
    leave_closed_layer(stack.w, stack.w.display.viewport.px_at_plane({20, 50}));
    CHECK(stack.w.document.scene().edited == 0);  // it is open itself
  }
}

TEST_CASE("A layer without opacity does not cover the layers below") {
  Stack stack;
  Layer faint = *stack.w.document.scene().layers[1];
  faint.opacity = 0;
  REQUIRE(stack.w.commit_layers("Opacity", with_layer_at(stack.w.document.scene(), 1, faint)));
  stack.settle();
  CHECK(layer_at(stack.w, stack.w.display.viewport.px_at_plane({20, 50})) == 0u);
}

TEST_CASE("With Handles, a drag of the picture selects with a box") {
  Stack stack;
  stack.w.tools.drags_layers = false;
  run("layer.below", stack.w);
  stack.settle();
  stack.desk.drag({20, 150}, {-30, 230});
  CHECK(stack.w.selection.size() == 1);
  CHECK(stack.lower().pose == stack.lower().rest);
}

TEST_CASE("A layer is moved as a whole: its pose and its keyframes, but not its rest shape") {
  for (const unsigned seed : seeds_of("layer drag", {1, 2})) {
    std::mt19937 random(seed);
    Deformation deformation = with_cage({}, shapes::curved_star(7, 3, 0.1, random()));
    deformation.pins = {{{200, 200}, {210, 190}, 0.5, {}}};
    deformation.strokes = {{{{150, 200}, {250, 200}}, {{150, 210}, {250, 190}}, {}}};
    deformation = with_key(std::move(deformation), 0);
    const Complex by = 50.0 * random_complex(random);
    const Deformation moved = moved_as_whole(deformation, by);
    CHECK(moved.rest == deformation.rest);
    CHECK(moved.pins[0].rest == deformation.pins[0].rest);
    CHECK(moved.pins[0].angle == deformation.pins[0].angle);
    CHECK(moved.keyframes[0].pose == whole_pose_of(moved));
    for (Index i = 0; i < moved.pose.size(); ++i)
      CHECK(std::abs(moved.pose.vertex(i) - deformation.pose.vertex(i) - by) < 1e-9);
    const Deformation back = moved_as_whole(moved, -by);
    CHECK(std::abs(back.strokes[0].pose[1] - deformation.strokes[0].pose[1]) < 1e-9);
  }
}

}  // namespace holomorph::layer_drag_test
