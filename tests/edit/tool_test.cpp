// Tools and actions without a window: gestures as sequences of inputs.
#include <catch2/catch.hpp>
#include <set>

#include "core/error.h"
#include "edit/actions.h"
#include "edit/desk.h"
#include "edit/tool.h"
#include "scene/auto_cage.h"

using namespace holomorph;

namespace {

constexpr Modifiers kAlt{false, false, true}, kShift{false, true, false};

}  // namespace

TEST_CASE(
    "Viewport: window and plane are inverse to each other, and zoom keeps the cursor's place") {
  Viewport view{{30, 40}, 2.5, 10, 20, 800, 600};
  const Complex z{12, 99}, px{333, 222};
  CHECK(std::abs(view.plane_at_px(view.px_at_plane(z)) - z) < 1e-12);
  CHECK(view.px_at_plane(z + kI).imag() < view.px_at_plane(z).imag());  // y is up in the plane
  const Complex under = view.plane_at_px(px);
  view.zoom_at(px, 3);
  CHECK(std::abs(view.plane_at_px(px) - under) < 1e-12);
  view.fit(box_of(shapes::l_shape()));
  for (const Complex& v : shapes::l_shape()) CHECK(view.contains_px(view.px_at_plane(v)));
}

TEST_CASE("Select: a drag is one step, follows exactly, and Shift keeps the axis") {
  Desk desk(shapes::l_shape());
  desk.drag({200, 100}, {230, 90});
  CHECK(desk.scene().pose.vertex(2) == Complex(230, 90));
  CHECK(desk.scene().rest.vertex(2) == Complex(200, 100));
  CHECK(desk.steps() == 3);
  desk.drag({230, 90}, {260, 95}, kShift);
  CHECK(desk.scene().pose.vertex(2) == Complex(260, 90));
  desk.press({260, 90});
  desk.move({262, 90});  // below the threshold
  desk.release({262, 90});
  CHECK(desk.steps() == 4);
  run(action_named("edit.undo"), desk.workspace);
  CHECK(desk.scene().pose.vertex(2) == Complex(230, 90));
}

TEST_CASE("Select: Escape gives a drag up and leaves the scene") {
  Desk desk(shapes::l_shape());
  desk.press({0, 0});
  desk.move({50, 50});
  CHECK(desk.scene().pose.vertex(0) == Complex(50, 50));
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  CHECK(desk.scene().pose.vertex(0) == Complex(0, 0));
  CHECK(desk.steps() == 2);
}

TEST_CASE("Select: marquee and Shift pick, dragging one moves all") {
  Desk desk(shapes::l_shape());
  desk.drag({150, -50}, {250, 150});
  CHECK(desk.workspace.selection.size() == 2);
  desk.click({0, 0}, kShift);
  CHECK(desk.workspace.selection.size() == 3);
  desk.drag({200, 0}, {210, 5});
  CHECK(desk.scene().pose.vertex(0) == Complex(10, 5));
  CHECK(desk.scene().pose.vertex(2) == Complex(210, 105));
  CHECK(desk.scene().pose.vertex(3) == Complex(100, 100));
}

TEST_CASE("Inserting keeps rest and pose, deleting asks for three points to stay") {
  Desk desk(shapes::l_shape());
  desk.drag({200, 0}, {200, -40});
  desk.press({100, -20}, {}, true);
  desk.release({100, -20});
  REQUIRE(desk.scene().rest.size() == 7);
  CHECK(std::abs(desk.scene().pose.vertex(1) - Complex(100, -20)) < 1e-9);
  CHECK(std::abs(desk.scene().rest.vertex(1) - Complex(100, 0)) < 5);
  CHECK(desk.scene().rest.vertex(1).imag() == Approx(0).margin(1e-12));
  desk.click({100, -20}, kAlt);
  CHECK(desk.scene().rest.size() == 6);
  run(action_named("edit.select_all"), desk.workspace);
  run(action_named("edit.delete"), desk.workspace);
  CHECK(desk.scene().rest.size() == 6);
  CHECK(desk.workspace.toasts.size() == 1);
}

TEST_CASE("Editing the rest keeps the pose; a crossing rest is refused with its place") {
  Desk desk(shapes::l_shape());
  desk.drag({200, 100}, {230, 120});
  run(action_named("cage.rest"), desk.workspace);
  const Cage pose = desk.scene().pose;
  desk.drag({200, 100}, {210, 90});
  CHECK(desk.scene().rest.vertex(2) == Complex(210, 90));
  CHECK(desk.scene().pose == pose);
  const size_t before = desk.steps();
  desk.drag({210, 90}, {-80, 50});
  CHECK(desk.steps() == before);
  CHECK(desk.scene().rest.vertex(2) == Complex(210, 90));
  REQUIRE(desk.workspace.toasts.size() == 1);
  CHECK(desk.workspace.toasts[0].where);
}

TEST_CASE("Pen: draw, take back, close by the first point, by Enter and by double-click") {
  for (const int way : {0, 1, 2}) {
    Desk desk;
    desk.workspace.tool = ToolId::pen;
    for (const Complex z : shapes::rectangle(200, 150)) desk.click(z);
    desk.click({-50, 60});
    CHECK(desk.tool().key(Key::backspace, desk.workspace));
    if (way == 0) desk.click({0, 0});
    if (way == 1) CHECK(desk.tool().key(Key::enter, desk.workspace));
    if (way == 2) desk.press({0, 150}, {}, true);
    REQUIRE(desk.scene().rest.size() == 4);
    CHECK(desk.scene().pose == desk.scene().rest);
    CHECK(desk.workspace.tool == ToolId::select);
  }
}

TEST_CASE("Stroke: drawn, moved, bent, redrawn and deleted, one step each") {
  Desk desk(shapes::rectangle(200, 150));
  desk.workspace.tool = ToolId::stroke;
  size_t steps = desk.steps();
  const Points line{{20, 75}, {60, 76}, {100, 74}, {140, 75}, {180, 75}};
  desk.draw(line);
  desk.settle();
  REQUIRE(desk.scene().strokes.size() == 1);
  CHECK(desk.scene().method == "strokes");
  CHECK(desk.steps() == ++steps);
  const Points rest = desk.scene().strokes[0].rest;
  for (size_t i = 0; i < rest.size(); ++i)
    CHECK(std::abs(desk.scene().strokes[0].pose[i] - rest[i]) < 1e-9);
  CHECK(std::abs(rest.front() - line.front()) < 1e-9);
  CHECK(std::abs(rest.back() - line.back()) < 1e-9);

  desk.drag({100, 75}, {120, 135});  // by its middle: as a whole
  CHECK(desk.steps() == ++steps);
  for (size_t i = 0; i < rest.size(); ++i)
    CHECK(std::abs(desk.scene().strokes[0].pose[i] - rest[i] - Complex(20, 60)) < 1e-9);
  CHECK(desk.scene().strokes[0].rest == rest);
  desk.settle();
  const Complex middle{100, 75};
  CHECK(std::abs(desk.workspace.posed_at(middle) - middle - Complex(20, 60)) < 1);

  desk.drag({200, 135}, {210, 175});  // by its end: bent, the other end stays
  CHECK(desk.steps() == ++steps);
  CHECK(std::abs(desk.scene().strokes[0].pose.back() - Complex(210, 175)) < 1e-9);
  CHECK(std::abs(desk.scene().strokes[0].pose.front() - Complex(40, 135)) < 1e-9);

  // Redrawn from the other end it does not turn around.
  desk.draw({{200, 40}, {120, 60}, {30, 40}}, kShift);
  CHECK(desk.steps() == ++steps);
  CHECK(std::abs(desk.scene().strokes[0].pose.front() - Complex(30, 40)) < 1e-9);
  CHECK(std::abs(desk.scene().strokes[0].pose.back() - Complex(200, 40)) < 1e-9);
  run(action_named("edit.reset"), desk.workspace);
  CHECK(desk.scene().strokes[0].pose == rest);
  CHECK(desk.steps() == ++steps);

  desk.settle();
  desk.click({100, 75}, kAlt);
  CHECK(desk.scene().strokes.empty());
  CHECK(desk.steps() == ++steps);
  run(action_named("edit.undo"), desk.workspace);
  CHECK(desk.scene().strokes.size() == 1);
}

TEST_CASE("Stroke: with Ctrl only what is near is pulled along") {
  Desk desk(shapes::rectangle(200, 150));
  desk.workspace.tool = ToolId::stroke;
  desk.draw({{20, 75}, {180, 75}});
  desk.settle();
  const Points before = desk.scene().strokes[0].pose;
  desk.press({100, 75}, {true, false, false});
  desk.move({100, 85});
  desk.move({100, 105});
  desk.release({100, 105});
  const Points& after = desk.scene().strokes[0].pose;
  double most = 0;
  int far = 0;
  for (size_t i = 0; i < after.size(); ++i) {
    const Complex by = after[i] - before[i];
    CHECK(std::abs(by.real()) < 1e-12);
    most = std::max(most, by.imag());
    if (std::abs(before[i].real() - 100) < 45) continue;
    CHECK(by == Complex(0));
    ++far;
  }
  CHECK(most > 29.9);
  CHECK(far > 8);
}

TEST_CASE("Stroke: what lies beside the picture is clipped, clicks and Escape leave nothing") {
  Desk desk(shapes::rectangle(200, 150));
  desk.workspace.tool = ToolId::stroke;
  const size_t steps = desk.steps();
  desk.press({20, 75});
  desk.move({100, 75});
  CHECK(desk.tool().busy());
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  desk.release({100, 75});
  desk.click({50, 50});
  desk.draw({{300, 75}, {400, 75}});
  CHECK(desk.steps() == steps);
  CHECK(desk.workspace.toasts.size() == 1);  // it starts on the picture
  desk.draw({{100, 75}, {300, 75}});
  REQUIRE(desk.scene().strokes.size() == 1);
  CHECK(desk.scene().strokes[0].rest.back().real() <= 200);
  CHECK_THAT(desk.workspace.toasts[1].text, Catch::Contains("left out"));
  // At rest it is drawn where the picture rests, and nothing moves by it.
  desk.workspace.layer = Layer::rest;
  desk.settle();
  desk.draw({{30, 30}, {100, 30}});
  REQUIRE(desk.scene().strokes.size() == 2);
  CHECK(std::abs(desk.scene().strokes[1].rest.front() - Complex(30, 30)) < 1e-9);
  CHECK(std::abs(desk.scene().strokes[1].pose.front() - Complex(30, 30)) < 1e-6);
}

TEST_CASE("Select: strokes are picked, boxed, moved by arrows and deleted like other handles") {
  Desk desk(shapes::rectangle(200, 150));
  desk.workspace.commit(
      "Stroke", with_stroke(desk.scene(), {{40, 75}, {160, 75}}, {{40, 75}, {100, 75}, {160, 75}}));
  desk.settle();
  const Handle handle{Handle::Kind::stroke, 0, 0};
  desk.click({60, 77});
  CHECK(desk.workspace.selection == Selection{handle});
  desk.click({100, 120});
  CHECK(desk.workspace.selection.empty());
  desk.drag({-20, 60}, {110, 100});
  CHECK(desk.workspace.selection == Selection{handle});
  run(action_named("edit.delete"), desk.workspace);
  CHECK(desk.scene().strokes.empty());
  CHECK(desk.workspace.document.history().entries().back().label == "Delete stroke");
}

TEST_CASE("Outline: one stroke is closed, smoothed and becomes the method's target, as one step") {
  Desk desk(shapes::rectangle(200, 150));
  desk.workspace.tool = ToolId::outline;
  const size_t before = desk.steps();
  const auto around = [](int i) {
    return Complex(300, 300) + (100.0 + 1.5 * (i % 2)) * std::polar(1.0, 2 * kPi * i / 60);
  };
  desk.press(around(0));
  for (int i = 1; i < 60; ++i) desk.move(around(i));
  CHECK(desk.tool().busy());
  CHECK(desk.scene().outline.empty());
  desk.release(around(59));
  REQUIRE(desk.scene().outline.size() >= 24);
  CHECK(desk.steps() == before + 1);
  CHECK(desk.scene().method == "outline");
  // The tremor is gone.
  for (const Complex& z : desk.scene().outline)
    CHECK(std::abs(std::abs(z - Complex(300, 300)) - 100.75) <= 0.75);
  desk.settle();
  for (const int v : desk.workspace.map.prepared()->mesh->boundary)
    CHECK(std::abs(std::abs(desk.workspace.map.map().f[v] - Complex(300, 300)) - 100.75) <= 2);
  run(action_named("edit.undo"), desk.workspace);
  CHECK(desk.scene().outline.empty());
}

TEST_CASE("Outline: its convergence plays once, stops, steps and starts again") {
  Desk desk(shapes::rectangle(200, 150));
  desk.workspace.tool = ToolId::outline;
  Points around;
  for (int i = 0; i < 60; ++i)
    around.push_back(Complex(300, 300) +
                     Complex(140 * std::cos(kPi * i / 30), 60 * std::sin(kPi * i / 30)));
  desk.draw(around);
  Playback& playback = desk.workspace.playback;
  CHECK(playback.playing);
  const auto pose = [&] {
    desk.workspace.map.finish(desk.scene(), {false, false, playback.iteration});
    return desk.workspace.map.map().f;
  };
  const VectorXc first = pose();
  const LiveMap& map = desk.workspace.map;
  const int last = static_cast<int>(map.map().energies.size()) - 1;
  REQUIRE(last > 2);
  CHECK(map.map().iterations == 0);
  double now = 0;
  int shown = 0;
  for (; playback.playing; now += 10) {
    advance(playback, map, now);
    pose();
    CHECK(map.map().iterations >= shown);
    shown = map.map().iterations;
  }
  CHECK(now > 300);  // the first iteration is seen, too
  CHECK_FALSE(action_named("map.step").enabled(desk.workspace));
  CHECK(now < 4000);
  const VectorXc end = pose();
  CHECK(map.map().iterations == last);
  CHECK((end - first).cwiseAbs().maxCoeff() > 1e-3);
  for (int i = 0; i < last; ++i)
    CHECK(map.map().energies[static_cast<size_t>(i) + 1] <=
          map.map().energies[static_cast<size_t>(i)]);

  run(action_named("map.restart"), desk.workspace);
  CHECK(pose() == first);
  CHECK_FALSE(playback.playing);
  run(action_named("map.step"), desk.workspace);
  pose();
  CHECK(map.map().iterations == 1);
  run(action_named("map.play"), desk.workspace);
  CHECK(playback.playing);
  run(action_named("map.play"), desk.workspace);
  CHECK_FALSE(playback.playing);
  for (int i = 1; i < last; ++i) run(action_named("map.step"), desk.workspace);
  CHECK(pose() == end);
  // What is edited is seen at its end.
  run(action_named("map.restart"), desk.workspace);
  run(action_named("edit.undo"), desk.workspace);
  CHECK_FALSE(playback.iteration);
}

TEST_CASE("What folds is told with its places, and made fold-free by the method that is asked") {
  Desk desk(shapes::rectangle(200, 150));
  CHECK_FALSE(desk.workspace.map.injectivity().folds());
  CHECK_FALSE(desk.workspace.map.injectivity().crossing);
  // Two corners change places.
  Scene scene = desk.scene();
  std::swap(scene.pose.segments[0], scene.pose.segments[1]);
  desk.workspace.commit("Twist", scene);
  desk.settle();
  const Injectivity& found = desk.workspace.map.injectivity();
  CHECK(found.folds());
  CHECK(found.fold);
  CHECK(found.crossing);
  CHECK(found.boundary_turns == Approx(2).margin(0.01));  // around a zero of f'
  run(action_named("map.fold_free"), desk.workspace);
  CHECK(desk.scene().method == "bounded");
  CHECK(choice(method_named("bounded"), desk.scene().parameters, "reference") == "cage");
  desk.settle();
  CHECK_FALSE(desk.workspace.map.injectivity().folds());
}

TEST_CASE("Outline: a drag on it bends it where it is taken, with Ctrl all of it moves") {
  Desk desk(shapes::rectangle(200, 150));
  Points round;
  for (int i = 0; i < 90; ++i)
    round.push_back(Complex(300, 300) + std::polar(100.0, 2 * kPi * i / 90));
  desk.workspace.commit("Outline", with_outline(desk.scene(), round));
  desk.workspace.tool = ToolId::outline;
  const size_t steps = desk.steps();
  desk.drag({400, 300}, {430, 300});
  CHECK(desk.steps() == steps + 1);
  const Points bent = desk.scene().outline;
  CHECK(std::abs(bent[0] - Complex(430, 300)) < 1e-9);
  CHECK(bent[1].real() > round[1].real() + 25);
  CHECK(bent[89].real() > round[89].real() + 25);
  CHECK(bent[45] == round[45]);
  desk.press({200, 300}, {true, false, false});
  desk.move({190, 310});
  desk.move({180, 320});
  desk.release({180, 320});
  for (size_t i = 0; i < bent.size(); ++i)
    CHECK(std::abs(desk.scene().outline[i] - bent[i] - Complex(-20, 20)) < 1e-9);
  // Bent through itself it is refused.
  desk.drag({410, 320}, {-100, 320});
  CHECK_FALSE(desk.workspace.toasts.empty());
  CHECK(std::abs(desk.scene().outline[45] - bent[45] - Complex(-20, 20)) < 1e-9);
  CHECK(desk.steps() == steps + 2);
}

TEST_CASE("Made fold-free, strokes and outlines are followed as they were set") {
  const auto followed = [](Desk& desk) {
    const VectorXc before = desk.workspace.map.map().f;
    run(action_named("map.fold_free"), desk.workspace);
    desk.settle();
    REQUIRE(desk.workspace.map.map().status == SampledMap::Status::certified);
    return (desk.workspace.map.map().f - before).cwiseAbs().maxCoeff();
  };
  Desk strokes(shapes::rectangle(200, 150));
  Points bent;
  for (int i = 0; i <= 20; ++i) bent.push_back({20.0 + 8 * i, 75 + 30 * std::sin(0.15 * i)});
  Scene scene = with_stroke(strokes.scene(), {{20, 75}, {180, 75}}, bent);
  scene.parameters["rigidity"] = 0.2;
  strokes.workspace.commit("Stroke", scene);
  strokes.settle();
  CHECK(followed(strokes) < 3);
  CHECK(strokes.scene().other_parameters.at("strokes").at("rigidity") == 0.2);
  // Another stroke stays with the method that follows strokes.
  CHECK(with_stroke(strokes.scene(), {{20, 20}, {80, 20}}, {{20, 20}, {80, 20}}).method ==
        "bounded");

  Desk outline(shapes::rectangle(200, 150));
  Points oval;
  for (int i = 0; i < 80; ++i)
    oval.push_back(Complex(100 + 130 * std::cos(kPi * i / 40), 75 + 90 * std::sin(kPi * i / 40)));
  outline.workspace.commit("Outline", with_outline(outline.scene(), oval));
  outline.settle();
  CHECK(followed(outline) < 12);  // but for the corners, where the derivative vanishes
}

TEST_CASE("Outline: Escape, a click and a crossing line leave the scene alone") {
  Desk desk(shapes::rectangle(200, 150));
  desk.workspace.tool = ToolId::outline;
  const Scene before = desk.scene();
  desk.press({300, 300});
  desk.move({400, 300});
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  desk.release({400, 300});
  desk.click({10, 10});
  desk.press({300, 300});
  for (const Complex z : {Complex(400, 300), Complex(300, 400), Complex(400, 400)}) desk.move(z);
  desk.release({400, 400});
  CHECK(desk.scene() == before);
  CHECK(desk.workspace.toasts.size() >= 2);
}

TEST_CASE("Each method keeps its parameters, and none takes another's") {
  Scene scene = with_cage(Scene{}, shapes::rectangle(200, 150));
  scene = with_method(scene, "pins");
  scene.parameters["pin_weight"] = 0.01;
  const Scene outline = with_method(scene, "outline");
  CHECK(outline.parameters.empty());
  CHECK(with_method(outline, "pins") == scene);
  Scene soft = outline;
  soft.parameters["softness"] = 0.5;
  CHECK(with_method(with_method(soft, "bounded"), "outline").parameters == soft.parameters);
}

TEST_CASE("Pen: Escape drops the drawing and nothing else; a crossing drawing stays to be mended") {
  Desk desk(shapes::l_shape());
  desk.drag({200, 100}, {230, 90});
  const Scene before = desk.scene();
  desk.workspace.tool = ToolId::pen;
  desk.click({-300, -300});
  desk.click({-200, -300});
  CHECK(desk.workspace.layer == Layer::rest);
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  CHECK(desk.scene() == before);
  for (const Complex z :
       {Complex(-300, -300), Complex(-200, -200), Complex(-200, -300), Complex(-300, -200)})
    desk.click(z);
  CHECK(desk.tool().key(Key::enter, desk.workspace));
  CHECK(desk.scene() == before);
  CHECK(desk.tool().busy());
}

TEST_CASE("Pen: a click on an edge inserts there") {
  Desk desk(shapes::l_shape());
  desk.workspace.tool = ToolId::pen;
  desk.hover({60, 3});
  CHECK(desk.tool().overlay().insertion);
  desk.click({60, 3});
  CHECK(desk.scene().rest.size() == 7);
}

TEST_CASE(
    "Pin: a click sets a pin at the rest place under it and switches the method without a jump") {
  Desk desk(shapes::l_shape());
  desk.drag({200, 100}, {240, 130});
  desk.settle();
  const VectorXc before = desk.workspace.map.map().f;
  const Complex image = before[before.size() / 2],
                rest = desk.workspace.map.prepared()->mesh->vertices[before.size() / 2];
  desk.workspace.tool = ToolId::pin;
  desk.click(image);
  REQUIRE(desk.scene().pins.size() == 1);
  CHECK(desk.scene().method == "pins");
  CHECK(std::abs(desk.scene().pins[0].rest - rest) < 0.5);
  CHECK(desk.scene().pins[0].pose == image);
  desk.settle();
  CHECK((desk.workspace.map.map().f - before).cwiseAbs().maxCoeff() < 0.2);
  desk.drag(image, image + Complex(20, 10));
  desk.settle();
  CHECK(desk.scene().pins[0].pose == image + Complex(20, 10));
  desk.click({-300, -300});
  CHECK(desk.scene().pins.size() == 1);  // outside the picture nothing is set
  desk.click(image + Complex(20, 10), kAlt);
  CHECK(desk.scene().pins.empty());
}

TEST_CASE("The ring of a selected pin turns the picture, beyond a full turn") {
  Desk desk(shapes::l_shape());
  desk.workspace.tool = ToolId::pin;
  desk.click({50, 50});
  desk.settle();
  desk.workspace.tool = ToolId::select;
  const double radius = kRingRadius * desk.workspace.handle_px;
  const auto on_ring = [&](double angle) { return Complex(50, 50) + std::polar(radius, angle); };
  desk.press(on_ring(0));
  for (double angle = 0.2; angle < 7.01; angle += 0.2) desk.move(on_ring(angle));
  desk.release(on_ring(7.0));
  REQUIRE(desk.scene().pins[0].angle);
  CHECK(*desk.scene().pins[0].angle == Approx(7.0).margin(0.05));
  CHECK(desk.scene().pins[0].pose == Complex(50, 50));
  const size_t steps = desk.steps();
  for (int i = 0; i < 5; ++i) {
    Input input = desk.at(on_ring(1.0));
    input.wheel = 2;
    CHECK(desk.tool().scroll(input, desk.workspace));
  }
  CHECK(desk.scene().pins[0].scale == Approx(std::pow(1.05, 10)));
  CHECK(desk.steps() == steps + 1);  // one step however often the wheel clicks
  Input aside = desk.at({120, 50});
  aside.wheel = 2;
  CHECK_FALSE(desk.tool().scroll(aside, desk.workspace));
  run(action_named("edit.free_angle"), desk.workspace);
  CHECK_FALSE(desk.scene().pins[0].angle);
}

TEST_CASE("Deleting refits curved neighbours, with Shift it keeps their tangents") {
  Scene scene = with_cage(Scene{}, shapes::l_shape());
  scene.pose.segments[1] = {{200, 0}, {230, 30}, {230, 70}};
  scene.pose.segments[2] = {{200, 100}, {170, 130}, {130, 130}};
  const Handle vertex{Handle::Kind::cage, 2, 0};
  const Scene refitted = erased(scene, {vertex}), kept = erased(scene, {vertex}, Refit::tangents);
  CHECK(refitted.pose.size() == scene.pose.size() - 1);
  CHECK(refitted.rest == kept.rest);
  CHECK(refitted.pose.degree(1) == 3);
  CHECK(kept.pose.controls(1) == Points{{200, 0}, {230, 30}, {130, 130}, scene.pose.vertex(3)});
  CHECK(refitted.pose != kept.pose);
}

TEST_CASE("Resetting every handle of a curved pose gives the rest") {
  Desk desk(shapes::l_shape());
  Scene scene = desk.scene();
  scene.rest.segments[2] = scene.pose.segments[2] = {{200, 100}, {170, 130}, {130, 130}};
  scene.pose.segments[1] = {{210, 5}, {230, 30}, {230, 70}};
  scene.pose.segments[2][1] += 9.0;
  desk.workspace.commit("Curves", scene);
  run(action_named("edit.select_all"), desk.workspace);
  run(action_named("edit.reset"), desk.workspace);
  const Scene& after = desk.scene();
  CHECK(after.pose.segments[2] == after.rest.segments[2]);
  for (Index e = 0; e < after.rest.size(); ++e) {
    const Points rest = elevated(after.rest.controls(e), after.pose.degree(e)),
                 pose = after.pose.controls(e);
    for (size_t m = 0; m < rest.size(); ++m) CHECK(std::abs(rest[m] - pose[m]) < 1e-12);
  }
}

TEST_CASE("Drawing a cage over a picture that pins bend is done at rest") {
  Desk desk(shapes::l_shape());
  desk.workspace.tool = ToolId::pin;
  desk.drag({50, 50}, {70, 60});
  CHECK(desk.steps() == 3);  // setting a pin and dragging it on is one step
  desk.settle();
  desk.workspace.tool = ToolId::pen;
  desk.click({400, 400});
  CHECK(desk.workspace.layer == Layer::rest);
}

TEST_CASE("Nudges merge while they go on, and never into another's step") {
  Desk desk(shapes::l_shape());
  Workspace& w = desk.workspace;
  desk.click({0, 0});
  for (int i = 0; i < 3; ++i) run(action_named("edit.nudge_right"), w);
  CHECK(desk.steps() == 3);
  desk.click({200, 0});
  run(action_named("edit.nudge_right"), w);
  CHECK(desk.steps() == 4);
  desk.click({3, 0});
  w.go_to(2);
  run(action_named("edit.nudge_up"), w);
  CHECK(desk.steps() == 4);  // a step of its own, after the first nudges
  CHECK(desk.scene().pose.vertex(0) == Complex(3, 1));
  run(action_named("edit.undo"), w);
  CHECK(desk.scene().pose.vertex(0) == Complex(3, 0));
}

TEST_CASE("A selection never means another point after undo, or a pin that the method hides") {
  Desk desk(shapes::l_shape());
  Workspace& w = desk.workspace;
  w.tool = ToolId::pen;
  desk.click({100, 0});
  CHECK(w.selection.size() == 1);
  run(action_named("edit.undo"), w);
  CHECK(w.selection.empty());
  w.tool = ToolId::pin;
  desk.settle();
  desk.click({50, 50});
  CHECK(w.selection.size() == 1);
  w.commit("Method", with_method(desk.scene(), "cage"));
  CHECK(w.selection.empty());
}

TEST_CASE("Hidden handles cannot be grabbed") {
  Desk desk(shapes::l_shape());
  desk.workspace.show_cage = false;
  CHECK_FALSE(handle_at(desk.workspace, desk.workspace.viewport.px_at_plane({0, 0})));
  desk.workspace.show_cage = true;
  CHECK(handle_at(desk.workspace, desk.workspace.viewport.px_at_plane({0, 0})));
}

TEST_CASE("Several handles move together around their middle") {
  const Scene scene = with_cage(Scene{}, shapes::l_shape());
  const Selection two{{Handle::Kind::cage, 0, 0}, {Handle::Kind::cage, 2, 0}};
  CHECK(center_of(scene, two, Layer::pose) == Complex(100, 50));
  CHECK(center_of(moved(scene, two, {5, -3}, Layer::pose), two, Layer::pose) == Complex(105, 47));
}

TEST_CASE("Nudging, resetting and methods act on the scene as named") {
  Desk desk(shapes::l_shape());
  desk.click({0, 0});
  for (const char* id : {"edit.nudge_right", "edit.nudge_up_10", "edit.nudge_left_fine"})
    run(action_named(id), desk.workspace);
  CHECK(std::abs(desk.scene().pose.vertex(0) - Complex(0.9, 10)) < 1e-12);
  run(action_named("edit.reset"), desk.workspace);
  CHECK(desk.scene().pose == desk.scene().rest);
  Scene scene = with_method(desk.scene(), "pins");
  scene.parameters["smoothness"] = 1e-4;
  CHECK(with_method(scene, "cage").parameters.empty());
}

TEST_CASE("The action table: ids and keys are unique, icons and labels are there") {
  std::set<std::string> ids, keys;
  for (const Action& action : actions()) {
    CHECK(ids.insert(action.id).second);
    CHECK_FALSE(action.label.empty());
    for (const Shortcut& key : action.keys) {
      INFO(action.id << " " << text_of(key));
      CHECK(keys.insert(text_of(key) + (key.mods.shift ? "S" : "")).second);
    }
  }
  Desk desk(shapes::l_shape());
  CHECK(action_for(Shortcut('V'), desk.workspace) == &action_named("tool.select"));
  CHECK(action_for(Shortcut('Z', {true, false, false}), desk.workspace) ==
        &action_named("edit.undo"));
  CHECK(action_for(Shortcut(Key::del), desk.workspace) == nullptr);  // nothing is selected
  CHECK(label_with_keys(action_named("edit.undo")) == "Undo (Ctrl+Z)");
}
