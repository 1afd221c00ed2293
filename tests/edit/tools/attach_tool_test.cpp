// Attaching the edited layer to another one with the pointer.

#include "edit/actions/actions.h"
#include "edit/tools/layer_drag.h"
#include "scene/keyframes.h"
#include "scene/layers.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::attach_tool_test {

namespace {

Image opaque(int width, int height) {
  Image image(width, height);
  for (size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
  return image;
}

/// A body of 200 x 100 with two pins, and a hat of 40 x 40 without a cage, which is edited.
struct Puppet {
  TestWorkspace desk{Points{}};
  Workspace& w = desk.workspace;

  Puppet() {
    std::vector<Layer> layers(2);
    for (int i = 0; i < 2; ++i) {
      const Picture picture{
          std::make_shared<const Image>(i == 0 ? opaque(200, 100) : opaque(40, 40)), "", {}};
      layers[i].id = i + 1;
      layers[i].name = i == 0 ? "body" : "hat";
      layers[i].image = described(reference_in("/nowhere/" + layers[i].name + ".png"), picture);
      w.document.put_picture(*layers[i].image, picture);
    }
    Deformation& body = layers[0].deformation;
    body = with_cage({}, shapes::rectangle(200, 100));
    body.method = "pins";
    body.pins = {{{20, 50}, {20, 50}, {}, ""}, {{180, 50}, {180, 50}, {}, ""}};
    Scene scene;
    scene.layers = shared(layers);
    scene.edited = 1;
    REQUIRE(w.commit_layers("Add", scene));
    settle();
  }
  void settle() {
    for (int i = 0; i < 5000; ++i) {
      w.update_map({});
      if (!w.map().busy() && !w.maps.of(1).busy() && w.maps.of(1).has_map()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  void edit(size_t layer) {
    w.choose_layer(layer);
    settle();
  }
  void attach(Complex z) {
    edit(1);
    run(w.actions.named("layer.attach"), w);
    CHECK(w.tools.active == ToolId::attach);
    desk.click(z);
    settle();
  }
  /// Turns the body by a right angle around its first pin.
  void turn_body() {
    edit(0);
    Deformation deformation = w.shown.deformation();
    deformation.pins[1].pose = {20, 210};
    REQUIRE(w.commit("Turn", deformation));
    settle();
  }
  const Layer& hat() const { return *w.document.scene().layers[1]; }
  Similarity hat_now() const { return w.placement(1); }
};

bool is_near(const Similarity& a, const Similarity& b, double far) {
  for (const Complex z : {Complex(0, 0), Complex(40, 0), Complex(0, 40)})
    if (std::abs(a(z) - b(z)) > far) return false;
  return true;
}

}  // namespace

TEST_CASE("attach tool: a hat follows a pin of a body, and is edited where it is shown") {
  Puppet puppet;
  Workspace& w = puppet.w;
  puppet.attach({180, 50});
  CHECK(w.tools.active == ToolId::select);
  REQUIRE(puppet.hat().attachment);
  CHECK(attachment_text(w.document.scene(), 1) == "pin 2 of body");
  CHECK(is_near(puppet.hat_now(), {}, 1e-3));

  puppet.turn_body();
  const Similarity turned{{0, 1}, {20, 50}, {20, 50}};
  CHECK(is_near(puppet.hat_now(), turned, 0.1));

  // The hat is picked where it is shown, and a drag moves it with the pointer.
  const Complex middle = turned({20, 20});
  CHECK(layer_at(w, w.display.viewport.px_at_plane(middle)) == 1u);
  w.tools.active = ToolId::select;
  puppet.desk.drag(middle, middle + Complex(30, 0));
  puppet.settle();
  CHECK(w.document.scene().edited == 1);
  CHECK(is_near(puppet.hat_now(), turned, 0.1));  // its own pose has moved
  const Points& corner = puppet.hat().deformation.pose.segments[0];
  CHECK(std::abs(puppet.hat_now()(corner[0]) - (turned(0) + Complex(30, 0))) < 0.1);
}

TEST_CASE("attach tool: arrow keys move what they select up on the canvas") {
  Puppet puppet;
  puppet.attach({100, 80});  // a place
  CHECK(puppet.hat().attachment->to == Attachment::To::place);
  puppet.turn_body();
  puppet.edit(1);
  Workspace& w = puppet.w;
  REQUIRE(w.commit("Box", with_box(w.shown.deformation(), *w.document.image())));
  puppet.settle();
  run(w.actions.named("edit.select_all"), w);
  const Complex before = puppet.hat_now()(puppet.hat().deformation.pose.vertex(0));
  run(w.actions.named("edit.nudge_up_10"), w);
  const Complex after = puppet.hat_now()(puppet.hat().deformation.pose.vertex(0));
  CHECK(std::abs(after - before - Complex(0, 10)) < 0.3);
}

TEST_CASE("attach tool: without its pin, a hat stays where it is, until undo") {
  Puppet puppet;
  Workspace& w = puppet.w;
  puppet.attach({180, 50});
  puppet.turn_body();
  const Similarity there = puppet.hat_now();
  w.erase({{Handle::Kind::pin, 1, 0}});
  puppet.settle();
  CHECK_FALSE(puppet.hat().attachment);
  CHECK(is_near(puppet.hat_now(), there, 1e-9));
  run(w.actions.named("edit.undo"), w);
  puppet.settle();
  CHECK(puppet.hat().attachment);

  // Also without the whole body.
  puppet.edit(0);
  run(w.actions.named("layer.delete"), w);
  REQUIRE(w.document.scene().layers.size() == 1);
  CHECK(is_near(w.placement(0), there, 1e-6));
}

TEST_CASE("attach tool: deleting another pin, detaching and cycles") {
  Puppet puppet;
  Workspace& w = puppet.w;
  puppet.attach({180, 50});
  puppet.turn_body();
  w.erase({{Handle::Kind::pin, 0, 0}});
  puppet.settle();
  CHECK(attachment_text(w.document.scene(), 1) == "pin 1 of body");
  // The body cannot follow its own hat.
  CHECK_FALSE(w.actions.named("layer.attach").enabled(w));
  puppet.edit(1);
  const Similarity there = puppet.hat_now();
  run(w.actions.named("layer.detach"), w);
  CHECK_FALSE(puppet.hat().attachment);
  CHECK(is_near(puppet.hat_now(), there, 1e-9));
  CHECK_FALSE(w.actions.named("layer.detach").enabled(w));
  puppet.edit(0);
  CHECK(w.actions.named("layer.attach").enabled(w));
}

TEST_CASE("attach tool: Escape and clicks outside all layers attach nothing") {
  Puppet puppet;
  Workspace& w = puppet.w;
  run(w.actions.named("layer.attach"), w);
  const size_t steps = puppet.desk.steps();
  puppet.desk.click({500, 500});
  CHECK(w.tools.active == ToolId::attach);
  CHECK(puppet.desk.tool().key(Key::escape, w));
  CHECK(w.tools.active == ToolId::select);
  CHECK(puppet.desk.steps() == steps);
}

TEST_CASE("A layer without keyframes is posed while the others keep the displayed time") {
  Puppet puppet;
  Workspace& w = puppet.w;
  puppet.edit(0);
  for (const double time : {0.0, 1.0}) {
    Deformation body = w.shown.own();
    body.pins[1].pose += Complex(0, 60 * time);
    REQUIRE(w.commit("Key", with_key(body, time), EditBase::document));
    puppet.settle();
  }
  w.go_to_time(0.5);
  puppet.edit(1);
  w.tools.active = ToolId::select;
  puppet.desk.drag({20, 20}, {30, 40});
  CHECK(puppet.hat().deformation.has_cage());
  CHECK(w.shown.timeline.active);
  CHECK(w.shown.timeline.time == 0.5);
  CHECK(w.shown.time_of_layers() == 0.5);
}

}  // namespace holomorph::attach_tool_test
