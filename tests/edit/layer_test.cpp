// Layers in the editor: choosing, locking and hiding them, and undo.

#include "edit/actions/actions.h"
#include "edit/content.h"
#include "support/catch.h"
#include "support/desk.h"

namespace holomorph::layer_test {

namespace {

const Points kSquare{{0, 0}, {200, 0}, {200, 200}, {0, 200}};

/// Two layers with the same cage. The upper one is the edited layer.
struct TwoLayers : TestWorkspace {
  TwoLayers() : TestWorkspace(kSquare) {
    run("layer.double", workspace);
    settle();
  }
  Complex corner(size_t layer) const {
    return workspace.document.scene().layers[layer]->deformation.pose.vertex(0);
  }
};

}  // namespace

TEST_CASE(
    "Edits change only the edited layer, and undo steps back through the edits of both layers") {
  TwoLayers desk;
  desk.drag({0, 0}, {-20, 0});
  CHECK(desk.corner(1) == Complex(-20, 0));
  CHECK(desk.corner(0) == Complex(0, 0));
  desk.workspace.selection = {{Handle::Kind::cage, 0, 0}};
  run("layer.below", desk.workspace);
  CHECK(desk.workspace.selection.empty());
  desk.settle();
  desk.drag({0, 0}, {0, -30});
  CHECK(desk.corner(0) == Complex(0, -30));
  CHECK(desk.corner(1) == Complex(-20, 0));
  run("edit.undo", desk.workspace);
  CHECK(desk.corner(0) == Complex(0, 0));
  run("edit.undo", desk.workspace);
  CHECK(desk.corner(1) == Complex(0, 0));
  CHECK(desk.workspace.document.scene().edited == 1);
}

TEST_CASE("Selecting a layer is not an undo step and leaves no unsaved changes") {
  TwoLayers desk;
  Document& document = desk.workspace.document;
  const Path file = std::filesystem::temp_directory_path() / "holomorph-select-layer.json";
  document.save(file);
  std::filesystem::remove(file);
  const size_t steps = desk.steps();
  run("layer.below", desk.workspace);
  CHECK(document.scene().edited == 0);
  CHECK(desk.steps() == steps);
  CHECK_FALSE(document.modified());
  // What was undone can still be redone.
  run("layer.lock", desk.workspace);
  run("edit.undo", desk.workspace);
  run("layer.above", desk.workspace);
  CHECK_FALSE(document.modified());
  CHECK(desk.workspace.actions.named("edit.redo").enabled(desk.workspace));
  CHECK_FALSE(desk.workspace.actions.named("layer.above").enabled(desk.workspace));
}

TEST_CASE("A locked layer refuses edits and says so; other layers accept them") {
  TwoLayers desk;
  run("layer.lock", desk.workspace);
  const Scene before = desk.workspace.document.scene();
  desk.drag({0, 0}, {-20, 0});
  CHECK(desk.workspace.document.scene() == before);
  REQUIRE_FALSE(desk.workspace.messages.toasts.empty());
  CHECK(desk.workspace.messages.toasts.back().text.find("locked") != std::string::npos);
  run("layer.delete", desk.workspace);
  CHECK(desk.workspace.document.scene().layers.size() == 2);
  run("layer.down", desk.workspace);  // moving a locked layer is allowed
  CHECK(desk.workspace.document.scene().edited == 0);
  run("layer.above", desk.workspace);
  desk.settle();
  desk.drag({200, 200}, {220, 200});
  CHECK(desk.workspace.shown.own().pose.vertex(2) == Complex(220, 200));
  run("layer.below", desk.workspace);
  run("layer.lock", desk.workspace);
  desk.settle();
  desk.drag({0, 0}, {-20, 0});
  CHECK(desk.workspace.shown.own().pose.vertex(0) == Complex(-20, 0));
}

TEST_CASE("Actions hide, reorder and delete layers, and undo reverts each of them") {
  TwoLayers desk;
  const Scene before = desk.workspace.document.scene();
  for (const char* id : {"layer.visible", "layer.lock", "layer.down", "layer.delete",
                         "background.original", "background.color"}) {
    INFO(id);
    run(id, desk.workspace);
    CHECK(desk.workspace.document.scene() != before);
    run("edit.undo", desk.workspace);
    CHECK(desk.workspace.document.scene() == before);
  }
  run("layer.delete", desk.workspace);
  CHECK_FALSE(desk.workspace.actions.named("layer.delete").enabled(desk.workspace));
}

TEST_CASE(
    "All layers are shown at the current time, and a layer without keyframes keeps its pose") {
  TwoLayers desk;
  Workspace& w = desk.workspace;
  w.go_to_time(0);
  w.set_key();
  w.go_to_time(2);
  desk.settle();
  w.update_map({});
  desk.drag({0, 0}, {-40, 0});
  w.set_key();
  run("layer.below", w);
  CHECK(w.shown.own().keyframes.empty());
  w.go_to_time(1);
  CHECK_FALSE(w.shown.time());
  REQUIRE(w.shown.time_of_layers() == 1.0);
  w.update_map({});
  while (w.maps.of(w.document.scene().layers[1]->id).busy() || w.map().busy()) {
    std::this_thread::yield();
    w.update_map({});
  }
  const LiveMap& upper = w.maps.of(w.document.scene().layers[1]->id);
  REQUIRE(upper.timed());
  CHECK(upper.timed()->pose.vertex(0).real() == Approx(-20).margin(3));
  CHECK(w.shown.deformation().pose.vertex(0) == Complex(0, 0));
  CHECK(desk.workspace.actions.named("time.play").enabled(w));
}

TEST_CASE("Next fold visits the worst fold first, then the others, and then starts over") {
  // Two corners of the square cross the opposite side, one of them farther than the other.
  TestWorkspace desk({{0, 0}, {100, 0}, {200, 0}, {200, 200}, {100, 200}, {0, 200}});
  Workspace& w = desk.workspace;
  run("view.fold", w);
  CHECK(w.messages.toasts.back().text == "Nothing folds.");
  Deformation deformation = desk.deformation();
  deformation.method = "harmonic";
  w.commit("Harmonic", deformation);
  desk.settle();
  desk.drag({0, 0}, {120, 190});
  desk.settle();
  desk.drag({200, 200}, {150, 60});
  desk.settle();
  Points folds;
  for (const Fold& fold : w.folds()) folds.push_back(fold.at);
  REQUIRE_FALSE(folds.empty());
  for (size_t i = 0; i <= folds.size(); ++i) {
    run("view.fold", w);
    CHECK(w.display.viewport.center == folds[i % folds.size()]);
    CHECK(w.messages.toasts.back().problem);
  }
}

TEST_CASE("A box around a picture moves the whole picture, and its bounds follow") {
  TestWorkspace desk(Points{});
  ImageReference reference = reference_in("/nowhere/blank.png");
  const Picture blank{std::make_shared<const Image>(100, 80), "", {}};
  reference = described(reference, blank);
  Layer pictured;
  pictured.image = reference;
  desk.workspace.document.put_picture(reference, blank);
  REQUIRE(desk.workspace.commit_layers("Add", scene_of(pictured)));
  const auto corners = [&] {
    const Box box = content_box(desk.workspace);
    return std::pair(Complex(box.left, box.bottom), Complex(box.right, box.top));
  };
  CHECK(corners() == std::pair(Complex(0, 0), Complex(100, 80)));
  run("cage.box", desk.workspace);
  CHECK(desk.workspace.selection.size() == 4);
  CHECK(desk.deformation().rest.vertex(2) == Complex(100, 80));
  desk.settle();
  desk.drag({50, 40}, {350, 140});
  desk.workspace.update_map({});
  desk.settle();
  for (Index i = 0; i < 4; ++i)
    CHECK(std::abs(desk.deformation().pose.vertex(i) - desk.deformation().rest.vertex(i) -
                   Complex(300, 100)) < 1e-9);
  CHECK(std::abs(corners().first - Complex(300, 100)) < 1e-3);
  CHECK(std::abs(corners().second - Complex(400, 180)) < 1e-3);
}

}  // namespace holomorph::layer_test
