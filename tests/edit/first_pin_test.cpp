// What a newcomer gets: the first pin makes the cage and chooses the puppet.

#include "core/geometry/polyline.h"
#include "edit/actions/actions.h"
#include "edit/edits/edits.h"
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
  CHECK(deformation.method == "puppet");
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

TEST_CASE("The first pin says how many parts of the picture the cage leaves out") {
  TestWorkspace desk;
  Image image(200, 100);
  for (int r = 20; r < 80; ++r)
    for (int c = 10; c < 190; ++c)
      if (c < 100 || (c > 120 && c < 140) || c > 160) image.at(c, r)[3] = 255;
  const Folder folder;
  const Path picture = folder.path / "parts.png";
  write_file(picture, encode_png(image));
  desk.workspace.open(Document::open(picture));
  desk.workspace.tools.active = ToolId::pin;
  desk.click({50, 50});
  REQUIRE(desk.workspace.shown.deformation().has_cage());
  REQUIRE(desk.workspace.messages.toasts.size() == 1);
  CHECK_THAT(desk.workspace.messages.toasts[0].text, Catch::Contains("2 other parts"));
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
  CHECK(puppet.method == "puppet");
  CHECK(handles_of(puppet, EditMode::pose).size() == 1);
  CHECK(handles_of(puppet, EditMode::rest).size() == 5);
  rest.pose.segments[0][0] += Complex(10, 10);
  const Deformation both = with_pin(rest, {50, 50}, {50, 50}, {});
  CHECK(both.method == "pins");
  CHECK(handles_of(both, EditMode::pose).size() == 5);
}

}  // namespace holomorph::first_pin_test
