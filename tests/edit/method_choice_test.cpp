// Methods and the switch "Prevent folds".
#include "edit/method_choice.h"

#include "edit/edits/method_edits.h"
#include "edit/picking.h"
#include "scene/keyframes.h"
#include "support/catch.h"
#include "support/desk.h"
#include "support/seeds.h"

namespace holomorph::method_choice_test {

TEST_CASE("Prevent folds is a switch of every method, except of those that never fold") {
  for (const Method& method : methods()) {
    INFO(method.id);
    if (method.follows_others) continue;
    Deformation deformation;
    deformation.method = method.id;
    const bool has_switch = method.id != "puppet" && method.id != "sheet" && method.id != "angles";
    CHECK(can_prevent_folds(method) == has_switch);
    CHECK_FALSE(prevents_folds(deformation));
    const Deformation on = with_folds_prevented(deformation, true);
    CHECK(prevents_folds(on) == has_switch);
    CHECK(chosen_method(on).id == method.id);
    const Deformation off = with_folds_prevented(on, false);
    CHECK(off.method == method.id);
  }
}

TEST_CASE("The switch keeps its state from method to method, and while a method has none") {
  Deformation deformation;
  deformation.method = "cage";
  deformation = with_folds_prevented(deformation, true);
  deformation = with_parameter(deformation, "bounded", "k", 0.4);
  deformation = with_chosen_method(deformation, "pins");
  CHECK(prevents_folds(deformation));
  CHECK(chosen_method(deformation).id == "pins");
  deformation = with_chosen_method(deformation, "puppet");
  CHECK(deformation.method == "puppet");
  deformation = with_chosen_method(deformation, "harmonic");
  CHECK(prevents_folds(deformation));
  CHECK(chosen_method(deformation).id == "harmonic");
  CHECK(deformation.parameters.at("k") == 0.4);
  deformation = with_folds_prevented(deformation, false);
  deformation = with_chosen_method(deformation, "puppet");
  deformation = with_chosen_method(deformation, "cage");
  CHECK(deformation.method == "cage");
}

TEST_CASE("Parameters of a method are kept while it is followed, and while another is chosen") {
  Deformation deformation;
  deformation.method = "pins";
  deformation = with_parameter(deformation, "pins", "exact", 1);
  deformation = with_folds_prevented(deformation, true);
  CHECK(chosen_parameters(deformation).at("exact") == 1);
  deformation = with_parameter(deformation, "pins", "smoothness", 1e-3);
  deformation = with_chosen_method(deformation, "cage");
  deformation = with_chosen_method(with_folds_prevented(deformation, false), "pins");
  CHECK(deformation.parameters == Parameters{{"exact", 1}, {"smoothness", 1e-3}});
}

TEST_CASE("Handles stay where they are displayed when the method changes") {
  for (const unsigned seed : seeds_of("method choice", {1, 2})) {
    std::mt19937 random(seed);
    INFO("seed " << seed);
    TestWorkspace desk(shapes::star(7 + static_cast<int>(random() % 8), 0.3, random()));
    Workspace& w = desk.workspace;
    Deformation deformation = desk.deformation();
    deformation.method = "puppet";
    for (int i = 0; i < 4; ++i) {
      const Complex z = Complex(200, 200) + 50.0 * random_complex(random);
      deformation.pins.push_back({z, z + 25.0 * random_complex(random), {}, {}});
    }
    w.commit("Puppet", deformation);
    desk.settle();
    REQUIRE(w.map().map().status == SampledMap::Status::certified);
    Points displayed, pins;
    for (Index i = 0; i < deformation.rest.size(); ++i) {
      const int vertex = w.map().prepared()->mesh->cage_vertices[static_cast<size_t>(i)];
      displayed.push_back(w.map().map().f[vertex]);
    }
    for (const char* id : {"cage", "pins", "harmonic", "mean_value"}) {
      INFO(id);
      choose_method(w, id);
      REQUIRE(chosen_method(w.shown.deformation()).id == id);
      for (Index i = 0; i < deformation.rest.size(); ++i)
        CHECK(std::abs(w.shown.deformation().pose.vertex(i) - displayed[static_cast<size_t>(i)]) <
              1);
      for (size_t i = 0; i < deformation.pins.size(); ++i)  // kept, even where they have no effect
        CHECK(w.shown.deformation().pins[i].pose == deformation.pins[i].pose);
      choose_method(w, "puppet");
      CHECK(pose_of(w.shown.deformation()).pins == pose_of(deformation).pins);
      desk.settle();
    }
  }
}

TEST_CASE("A change of the method at a time changes no pose, and sets no keyframe") {
  TestWorkspace desk(shapes::rectangle(200, 200));
  Workspace& w = desk.workspace;
  Deformation deformation = desk.deformation();
  deformation.method = "puppet";
  deformation.pins = {{{40, 40}, {40, 40}, {}, {}}, {{160, 160}, {160, 160}, {}, {}}};
  deformation = with_key(std::move(deformation), 0);
  deformation.pins[1].pose = {150, 190};
  deformation = with_key(std::move(deformation), 1);
  w.commit("Keys", deformation);
  w.shown.timeline.auto_key = true;
  const auto settle = [&] {
    for (int i = 0; i < 3000; ++i) {
      w.update_map({});
      if (!w.map().busy() && w.map().follow_keys()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  w.go_to_time(0.5);
  settle();
  REQUIRE(w.shown.is_timed());
  choose_method(w, "cage");
  CHECK(w.shown.own().method == "cage");
  CHECK(w.shown.own().pose == deformation.pose);
  CHECK(w.shown.own().pins == deformation.pins);
  REQUIRE(w.shown.own().keyframes.size() == 2);
  CHECK(w.shown.timeline.time == 0.5);
  CHECK(w.shown.timeline.active);
  // The cage of the second keyframe has the shape that its pins gave it.
  const Cage& cage = w.shown.own().keyframes[1].pose.cage;
  CHECK(std::abs(cage.vertex(2) - Complex(200, 200)) > 5);
}

TEST_CASE("From a cage to a puppet without pins and back, cage points stay") {
  TestWorkspace desk(shapes::rectangle(200, 200));
  desk.drag({200, 200}, {230, 220});
  const Cage posed = desk.deformation().pose;
  choose_method(desk.workspace, "puppet");
  CHECK(desk.deformation().pose == posed);
  choose_method(desk.workspace, "pins");
  CHECK(desk.deformation().pose == posed);
}

}  // namespace holomorph::method_choice_test
