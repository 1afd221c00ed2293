// What a newcomer gets: the first pin makes the cage and chooses the puppet.

#include "core/geometry/polyline.h"
#include "edit/actions/actions.h"
#include "edit/edits/edits.h"
#include "edit/frame.h"
#include "edit/method_choice.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/folder.h"
#include "system/new_file.h"

namespace holomorph::first_pin_test {

namespace {

void open(TestWorkspace& desk, const std::string& picture) {
  desk.workspace.open(Document::open(HOLOMORPH_SOURCE "/assets/" + picture));
  desk.workspace.tools.active = ToolId::pin;
}

}  // namespace

TEST_CASE("The first pin makes the cage and chooses Puppet, in one step") {
  TestWorkspace desk;
  open(desk, "octopus.png");
  Workspace& workspace = desk.workspace;
  const size_t before = workspace.document.history().index();
  desk.click({500, 600});
  const Deformation& deformation = workspace.shown.deformation();
  REQUIRE(deformation.has_cage());
  CHECK(workspace.document.history().index() == before + 1);
  CHECK(deformation.method == "sheet");
  CHECK(deformation.pins.size() == 1);
  CHECK(deformation.pins[0].rest == Complex(500, 600));
  CHECK(workspace.tools.active == ToolId::pin);
  CHECK(deformation.rest.size() > 20);
  CHECK(winding_number(outline_of(deformation.rest), {500, 600}) == 1);
  desk.settle();
  CHECK(workspace.map().map().status == SampledMap::Status::certified);
  run("edit.undo", workspace);
  CHECK_FALSE(workspace.shown.deformation().has_cage());
  CHECK(workspace.shown.deformation().pins.empty());
}

TEST_CASE("The first pin on a photograph makes a frame, with nothing behind it") {
  TestWorkspace desk;
  Image image(300, 200);
  for (int r = 0; r < 200; ++r)
    for (int c = 0; c < 300; ++c) image.at(c, r)[3] = 255;
  const Folder folder;
  const Path picture = folder.path / "photograph.png";
  write_file(picture, encode_png(image));
  desk.workspace.open(Document::open(picture));
  Workspace& workspace = desk.workspace;
  workspace.tools.active = ToolId::pin;
  desk.click({150, 100});
  CHECK(workspace.shown.deformation().method == "sheet");
  CHECK(workspace.shown.deformation().frame == Frame::slide);
  CHECK(can_choose_frame(workspace));
  CHECK(workspace.document.scene().background.fill == Background::Fill::transparent);
  CHECK(workspace.document.history().index() == 1);
  // A moved pin does not move the frame.
  for (int i = 0; i <= 5; ++i) {
    const Complex at(150.0 + 8 * i, 100);
    i == 0 ? desk.press(at) : desk.move(at);
  }
  desk.release({190, 100});
  desk.settle();
  const Mesh& mesh = *workspace.map().prepared()->mesh;
  for (const int v : mesh.boundary) {
    const Complex z = mesh.vertices[static_cast<size_t>(v)], w = workspace.map().map().f[v];
    if (z.real() == 0 || z.real() == 300) CHECK(std::abs(w.real() - z.real()) < 1e-9);
    if (z.imag() == 0 || z.imag() == 200) CHECK(std::abs(w.imag() - z.imag()) < 1e-9);
  }
  CHECK(std::abs(*workspace.map().pin_image(0) - Complex(190, 100)) < 2);
  // Another method and back: a frame that was chosen stays.
  choose_method(workspace, "pins");
  choose_method(workspace, "sheet");
  CHECK(workspace.shown.deformation().frame == Frame::slide);
  run("edit.undo", workspace);
  run("edit.undo", workspace);
  run("edit.undo", workspace);
  run("edit.undo", workspace);
  CHECK_FALSE(workspace.shown.deformation().has_cage());
}

TEST_CASE("A press sets the first pin, and the same drag moves it") {
  TestWorkspace desk;
  open(desk, "octopus.png");
  desk.press({500, 600});
  for (int i = 1; i <= 10; ++i) desk.move({500.0 + 5 * i, 600});
  desk.release({550, 600});
  const Deformation& deformation = desk.workspace.shown.deformation();
  REQUIRE(deformation.pins.size() == 1);
  CHECK(std::abs(deformation.pins[0].pose - Complex(550, 600)) < 1e-6);
  CHECK(desk.workspace.document.history().index() == 1);
}

TEST_CASE("The first pin gives each part of the picture an outline, and says what is left out") {
  TestWorkspace desk;
  Image image(200, 100);
  for (int r = 20; r < 80; ++r)
    for (int c = 10; c < 190; ++c)
      if (c < 100 || (c > 120 && c < 140) || c > 160) image.at(c, r)[3] = 255;
  for (int c = 10; c < 16; ++c) image.at(c, 5)[3] = 255;  // too small to see
  const Folder folder;
  const Path picture = folder.path / "parts.png";
  write_file(picture, encode_png(image));
  desk.workspace.open(Document::open(picture));
  desk.workspace.tools.active = ToolId::pin;
  desk.click({175, 50});
  const auto shown = [&desk] { return desk.workspace.shown.deformation(); };
  CHECK(shown().rest.part_count() == 3);
  CHECK(shown().method == "sheet");
  CHECK(PartFinder(shown().rest).at(shown().pins.at(0).rest) > 0);
  REQUIRE(desk.workspace.messages.toasts.size() == 1);
  CHECK_THAT(desk.workspace.messages.toasts[0].text,
             Catch::Contains("A part of the picture stays"));

  // Pins act on their part, and other parts follow.
  desk.click({50, 40});
  desk.click({50, 60});
  desk.press({50, 60});
  for (int i = 1; i <= 5; ++i) desk.move({50.0 + 2 * i, 60.0 + i});
  desk.release({60, 65});
  CHECK(shown().pins.size() == 3);
  CHECK(shown().pins[2].pose == Complex(60, 65));
  desk.settle();
  CHECK(desk.workspace.map().map().status == SampledMap::Status::certified);

  // Another method has one outline around everything, and undo brings the parts back.
  const Cage parts = shown().rest;
  choose_method(desk.workspace, "pins");
  CHECK(shown().rest.part_count() == 1);
  CHECK(shown().pins.size() == 3);
  run("edit.undo", desk.workspace);
  CHECK(shown().rest == parts);
}

TEST_CASE("A click beside the picture's content makes nothing") {
  TestWorkspace desk;
  open(desk, "octopus.png");
  desk.click({20, 980});
  CHECK_FALSE(desk.workspace.shown.deformation().has_cage());
  CHECK(desk.workspace.document.history().index() == 0);
  CHECK_FALSE(desk.workspace.messages.toasts.empty());
}

TEST_CASE("Pins that replace the cage hide its points; pins beside a bent cage do not") {
  const Points square{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  Deformation rest = with_cage(Deformation{}, square);
  const Deformation puppet = with_pin(rest, {50, 50}, {50, 50}, {});
  CHECK(puppet.method == "sheet");
  CHECK(handles_of(puppet, EditMode::pose).size() == 1);
  CHECK(handles_of(puppet, EditMode::rest).size() == 5);
  rest.pose.segments[0][0] += Complex(10, 10);
  const Deformation both = with_pin(rest, {50, 50}, {50, 50}, {});
  CHECK(both.method == "pins");
  CHECK(handles_of(both, EditMode::pose).size() == 5);
}

}  // namespace holomorph::first_pin_test
