// Strokes and outlines: drawing and bending them, how the map follows, and how folds are reported.

#include "edit/actions/actions.h"
#include "edit/tools/tool.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::drawing_test {

namespace {

constexpr Modifiers kAlt{false, false, true}, kShift{false, true, false};

}  // namespace

TEST_CASE("Stroke: drawing, moving, bending, redrawing and deleting are one step each") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  desk.workspace.tools.active = ToolId::stroke;
  size_t steps = desk.steps();
  const Points line{{20, 75}, {60, 76}, {100, 74}, {140, 75}, {180, 75}};
  desk.draw(line);
  desk.settle();
  REQUIRE(desk.deformation().strokes.size() == 1);
  CHECK(desk.deformation().method == "strokes");
  CHECK(desk.steps() == ++steps);
  const Points rest = desk.deformation().strokes[0].rest;
  for (size_t i = 0; i < rest.size(); ++i)
    CHECK(std::abs(desk.deformation().strokes[0].pose[i] - rest[i]) < 1e-9);
  CHECK(std::abs(rest.front() - line.front()) < 1e-9);
  CHECK(std::abs(rest.back() - line.back()) < 1e-9);

  desk.drag({100, 75}, {120, 135});  // a drag of the middle moves the whole stroke
  CHECK(desk.steps() == ++steps);
  for (size_t i = 0; i < rest.size(); ++i)
    CHECK(std::abs(desk.deformation().strokes[0].pose[i] - rest[i] - Complex(20, 60)) < 1e-9);
  CHECK(desk.deformation().strokes[0].rest == rest);
  desk.settle();
  const Complex middle{100, 75};
  CHECK(std::abs(posed_at(desk.workspace.map(), middle) - middle - Complex(20, 60)) < 1);

  desk.drag({200, 135}, {210, 175});  // a drag of an end bends it; the other end stays
  CHECK(desk.steps() == ++steps);
  CHECK(std::abs(desk.deformation().strokes[0].pose.back() - Complex(210, 175)) < 1e-9);
  CHECK(std::abs(desk.deformation().strokes[0].pose.front() - Complex(40, 135)) < 1e-9);

  // Redrawing from the other end does not reverse the stroke.
  desk.draw({{200, 40}, {120, 60}, {30, 40}}, kShift);
  CHECK(desk.steps() == ++steps);
  CHECK(std::abs(desk.deformation().strokes[0].pose.front() - Complex(30, 40)) < 1e-9);
  CHECK(std::abs(desk.deformation().strokes[0].pose.back() - Complex(200, 40)) < 1e-9);
  run("edit.reset", desk.workspace);
  CHECK(desk.deformation().strokes[0].pose == rest);
  CHECK(desk.steps() == ++steps);

  desk.settle();
  desk.click({100, 75}, kAlt);
  CHECK(desk.deformation().strokes.empty());
  CHECK(desk.steps() == ++steps);
  run("edit.undo", desk.workspace);
  CHECK(desk.deformation().strokes.size() == 1);
}

TEST_CASE("Stroke: a Ctrl-drag bends the stroke only near the pointer") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  desk.workspace.tools.active = ToolId::stroke;
  desk.draw({{20, 75}, {180, 75}});
  desk.settle();
  const Points before = desk.deformation().strokes[0].pose;
  desk.press({100, 75}, {true, false, false});
  desk.move({100, 85});
  desk.move({100, 105});
  desk.release({100, 105});
  const Points& after = desk.deformation().strokes[0].pose;
  double most = 0;
  int unmoved = 0;
  for (size_t i = 0; i < after.size(); ++i) {
    const Complex by = after[i] - before[i];
    CHECK(std::abs(by.real()) < 1e-12);
    most = std::max(most, by.imag());
    if (std::abs(before[i].real() - 100) < 45) continue;
    CHECK(by == Complex(0));
    ++unmoved;
  }
  CHECK(most > 29.9);
  CHECK(unmoved > 8);
}

TEST_CASE("Stroke: parts outside the picture are clipped; clicks and Escape draw nothing") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  desk.workspace.tools.active = ToolId::stroke;
  const size_t steps = desk.steps();
  desk.press({20, 75});
  desk.move({100, 75});
  CHECK(desk.tool().busy());
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  desk.release({100, 75});
  desk.click({50, 50});
  desk.draw({{300, 75}, {400, 75}});
  CHECK(desk.steps() == steps);
  CHECK(desk.workspace.messages.toasts.size() == 1);  // a stroke must start on the picture
  desk.draw({{100, 75}, {300, 75}});
  REQUIRE(desk.deformation().strokes.size() == 1);
  CHECK(desk.deformation().strokes[0].rest.back().real() <= 200);
  CHECK_THAT(desk.workspace.messages.toasts[1].text, Catch::Contains("left out"));
  // At rest, a stroke is drawn on the picture at rest, and nothing moves.
  desk.workspace.mode = EditMode::rest;
  desk.settle();
  desk.draw({{30, 30}, {100, 30}});
  REQUIRE(desk.deformation().strokes.size() == 2);
  CHECK(std::abs(desk.deformation().strokes[1].rest.front() - Complex(30, 30)) < 1e-9);
  CHECK(std::abs(desk.deformation().strokes[1].pose.front() - Complex(30, 30)) < 1e-6);
}

TEST_CASE("Select: strokes are clicked, selected with a box and deleted like other handles") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  desk.workspace.commit("Stroke", with_stroke(desk.deformation(), {{40, 75}, {160, 75}},
                                              {{40, 75}, {100, 75}, {160, 75}}));
  desk.settle();
  const Handle handle{Handle::Kind::stroke, 0, 0};
  desk.click({60, 77});
  CHECK(desk.workspace.selection == Selection{handle});
  desk.click({100, 120});
  CHECK(desk.workspace.selection.empty());
  desk.drag({-20, 60}, {110, 100});
  CHECK(desk.workspace.selection == Selection{handle});
  run("edit.delete", desk.workspace);
  CHECK(desk.deformation().strokes.empty());
  CHECK(desk.workspace.document.history().entries().back().label == "Delete stroke");
}

TEST_CASE("Outline: a freehand line is closed and smoothed and becomes the outline in one step") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  desk.workspace.tools.active = ToolId::outline;
  const size_t before = desk.steps();
  const auto around = [](int i) {
    return Complex(300, 300) + (100.0 + 1.5 * (i % 2)) * std::polar(1.0, 2 * kPi * i / 60);
  };
  desk.press(around(0));
  for (int i = 1; i < 60; ++i) desk.move(around(i));
  CHECK(desk.tool().busy());
  CHECK(desk.deformation().outline.empty());
  desk.release(around(59));
  REQUIRE(desk.deformation().outline.size() >= 24);
  CHECK(desk.steps() == before + 1);
  CHECK(desk.deformation().method == "outline");
  // The jitter is smoothed away.
  for (const Complex& z : desk.deformation().outline)
    CHECK(std::abs(std::abs(z - Complex(300, 300)) - 100.75) <= 0.75);
  desk.settle();
  for (const int v : desk.workspace.map().prepared()->mesh->boundary)
    CHECK(std::abs(std::abs(desk.workspace.map().map().f[v] - Complex(300, 300)) - 100.75) <= 2);
  run("edit.undo", desk.workspace);
  CHECK(desk.deformation().outline.empty());
}

TEST_CASE("Outline: the iterations play once; they can be stopped, stepped and restarted") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  // With softness, the method needs several iterations.
  Deformation soft = desk.deformation();
  soft.other_parameters["outline"] = {{"softness", 0.8}, {"smoothness", 1e-4}};
  desk.workspace.commit("Soft", soft);
  desk.workspace.tools.active = ToolId::outline;
  Points around;
  for (int i = 0; i < 60; ++i)
    around.push_back(Complex(300, 300) +
                     Complex(140 * std::cos(kPi * i / 30), 60 * std::sin(kPi * i / 30)));
  desk.draw(around);
  Playback& playback = desk.workspace.playback;
  CHECK(playback.playing);
  const auto pose = [&] {
    desk.workspace.map().finish(desk.deformation(), {false, false, playback.iteration});
    return desk.workspace.map().map().f;
  };
  const VectorXc first = pose();
  const LiveMap& map = desk.workspace.map();
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
  CHECK(now > 300);  // the first iteration is displayed, too
  CHECK_FALSE(desk.workspace.actions.named("map.step").enabled(desk.workspace));
  CHECK(now < 4000);
  const VectorXc end = pose();
  CHECK(map.map().iterations == last);
  CHECK((end - first).cwiseAbs().maxCoeff() > 1e-3);
  for (int i = 0; i < last; ++i)
    CHECK(map.map().energies[static_cast<size_t>(i) + 1] <=
          map.map().energies[static_cast<size_t>(i)]);

  run("map.restart", desk.workspace);
  CHECK(pose() == first);
  CHECK_FALSE(playback.playing);
  run("map.step", desk.workspace);
  pose();
  CHECK(map.map().iterations == 1);
  run("map.play", desk.workspace);
  CHECK(playback.playing);
  run("map.play", desk.workspace);
  CHECK_FALSE(playback.playing);
  for (int i = 1; i < last; ++i) run("map.step", desk.workspace);
  CHECK(pose() == end);
  // An edit shows the last iteration.
  run("map.restart", desk.workspace);
  run("edit.undo", desk.workspace);
  CHECK_FALSE(playback.iteration);
}

TEST_CASE("Folds are reported with their positions, and Make it fold-free removes them") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  CHECK_FALSE(desk.workspace.map().injectivity().folds());
  CHECK_FALSE(desk.workspace.map().injectivity().crossing);
  // Two corners are swapped.
  Deformation deformation = desk.deformation();
  std::swap(deformation.pose.segments[0], deformation.pose.segments[1]);
  desk.workspace.commit("Twist", deformation);
  desk.settle();
  const Injectivity& found = desk.workspace.map().injectivity();
  CHECK(found.folds());
  CHECK_FALSE(found.folds_at.empty());
  CHECK(found.crossing);
  CHECK(found.turning_number == Approx(2).margin(0.01));  // around a zero of f'
  run("map.fold_free", desk.workspace);
  CHECK(desk.deformation().method == "bounded");
  CHECK(choice(method_named("bounded"), desk.deformation().parameters, "reference") == "cage");
  desk.settle();
  CHECK_FALSE(desk.workspace.map().injectivity().folds());
}

TEST_CASE("Outline: a drag of the outline bends it, and a Ctrl-drag moves all of it") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  Points round;
  for (int i = 0; i < 90; ++i)
    round.push_back(Complex(300, 300) + std::polar(100.0, 2 * kPi * i / 90));
  desk.workspace.commit("Outline", with_outline(desk.deformation(), round));
  desk.workspace.tools.active = ToolId::outline;
  const size_t steps = desk.steps();
  desk.drag({400, 300}, {430, 300});
  CHECK(desk.steps() == steps + 1);
  const Points bent = desk.deformation().outline;
  CHECK(std::abs(bent[0] - Complex(430, 300)) < 1e-9);
  CHECK(bent[1].real() > round[1].real() + 25);
  CHECK(bent[89].real() > round[89].real() + 25);
  CHECK(bent[45] == round[45]);
  desk.press({200, 300}, {true, false, false});
  desk.move({190, 310});
  desk.move({180, 320});
  desk.release({180, 320});
  for (size_t i = 0; i < bent.size(); ++i)
    CHECK(std::abs(desk.deformation().outline[i] - bent[i] - Complex(-20, 20)) < 1e-9);
  // An outline that is bent through itself is refused.
  desk.drag({410, 320}, {-100, 320});
  CHECK_FALSE(desk.workspace.messages.toasts.empty());
  CHECK(std::abs(desk.deformation().outline[45] - bent[45] - Complex(-20, 20)) < 1e-9);
  CHECK(desk.steps() == steps + 2);
}

TEST_CASE("Make it fold-free follows strokes and outlines with their parameters") {
  const auto followed = [](TestWorkspace& desk) {
    const VectorXc before = desk.workspace.map().map().f;
    run("map.fold_free", desk.workspace);
    desk.settle();
    REQUIRE(desk.workspace.map().map().status == SampledMap::Status::certified);
    return (desk.workspace.map().map().f - before).cwiseAbs().maxCoeff();
  };
  TestWorkspace strokes(shapes::rectangle(200, 150));
  Points bent;
  for (int i = 0; i <= 20; ++i) bent.push_back({20.0 + 8 * i, 75 + 30 * std::sin(0.15 * i)});
  Deformation deformation = with_stroke(strokes.deformation(), {{20, 75}, {180, 75}}, bent);
  deformation.parameters["rigidity"] = 0.2;
  strokes.workspace.commit("Stroke", deformation);
  strokes.settle();
  CHECK(followed(strokes) < 3);
  CHECK(strokes.deformation().other_parameters.at("strokes").at("rigidity") == 0.2);
  // Adding a stroke keeps the method that follows strokes.
  CHECK(with_stroke(strokes.deformation(), {{20, 20}, {80, 20}}, {{20, 20}, {80, 20}}).method ==
        "bounded");

  TestWorkspace outline(shapes::rectangle(200, 150));
  Points oval;
  for (int i = 0; i < 80; ++i)
    oval.push_back(Complex(100 + 130 * std::cos(kPi * i / 40), 75 + 90 * std::sin(kPi * i / 40)));
  outline.workspace.commit("Outline", with_outline(outline.deformation(), oval));
  outline.settle();
  CHECK(followed(outline) < 12);  // large only at the corners, where the derivative vanishes
}

TEST_CASE("Outline: Escape, a click and a line that crosses itself do not change the scene") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  desk.workspace.tools.active = ToolId::outline;
  const Deformation before = desk.deformation();
  desk.press({300, 300});
  desk.move({400, 300});
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  desk.release({400, 300});
  desk.click({10, 10});  // sets the first point of a path
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  desk.press({300, 300});
  for (const Complex z : {Complex(400, 300), Complex(300, 400), Complex(400, 400)}) desk.move(z);
  desk.release({400, 400});
  CHECK(desk.deformation() == before);
  CHECK(!desk.workspace.messages.toasts.empty());
}

TEST_CASE(
    "Outline: clicks set points, a drag makes one smooth, Enter and the first point close it") {
  TestWorkspace desk(shapes::rectangle(200, 150));
  desk.workspace.tools.active = ToolId::outline;
  const size_t steps = desk.steps();
  desk.click({10, 10});
  CHECK(desk.tool().busy());
  desk.click({300, 10});
  CHECK(desk.tool().key(Key::enter, desk.workspace));  // too few points: a toast says so
  CHECK(desk.tool().busy());
  CHECK_FALSE(desk.workspace.messages.toasts.empty());
  desk.click({300, 200});
  desk.click({150, 280});
  CHECK(desk.tool().key(Key::backspace, desk.workspace));
  desk.drag({10, 200}, {-20, 160});  // smooth
  CHECK(desk.tool().overlay().line_points.size() == 4);
  CHECK(desk.deformation().outline.empty());
  desk.click({10, 10});
  CHECK_FALSE(desk.tool().busy());
  CHECK(desk.steps() == steps + 1);
  CHECK(desk.deformation().method == "outline");
  const Points outline = desk.deformation().outline;
  CHECK(outline.size() > 8);  // two sides are curves
  desk.press({600, 600});     // the next path does not start at the last point of this one
  desk.release({600, 600});
  CHECK_FALSE(desk.tool().overlay().closes);
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  CHECK(std::ranges::count(outline, Complex(300, 10)) == 1);
  CHECK(std::ranges::count(outline, Complex(150, 280)) == 0);
  CHECK(desk.workspace.playback.playing);

  // Closed with Enter. A path that crosses itself is refused but not discarded, and can be
  // corrected.
  for (const Complex z : {Complex(60, 50), {280, 180}, {280, 50}, {60, 180}}) desk.click(z);
  CHECK(desk.tool().key(Key::enter, desk.workspace));
  CHECK(desk.tool().busy());
  CHECK(desk.steps() == steps + 1);
  CHECK(desk.workspace.messages.toasts.back().problem);
  CHECK(desk.tool().key(Key::backspace, desk.workspace));
  CHECK(desk.tool().key(Key::enter, desk.workspace));
  CHECK(desk.steps() == steps + 2);
  CHECK(desk.deformation().outline.size() == 3);
  desk.click({400, 400});
  CHECK(desk.tool().key(Key::escape, desk.workspace));
  CHECK_FALSE(desk.tool().busy());
}

}  // namespace holomorph::drawing_test
