// check_scene refuses exactly the scenes that could not be opened again.
#include "scene/check_scene.h"

#include <functional>
#include <limits>
#include <random>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/scene_json.h"
#include "scene/keyframes.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::check_scene_test {

namespace {

bool is_refused(const std::function<void()>& act) {
  try {
    act();
    return false;
  } catch (const Error&) {
    return true;
  }
}

/// A scene with every kind of part.
Scene full_scene() {
  Deformation deformation = with_cage({}, shapes::l_shape());
  deformation.pins = {{{20, 20}, {25, 22}, 0.5, {}}, {{40, 20}, {40, 20}, {}, {}, 1, -3}};
  deformation.strokes = {{{{10, 10}, {30, 10}}, {{10, 12}, {30, 14}}, {}}};
  deformation.outline = shapes::rectangle(50, 40);
  deformation.surface = SurfaceReference{"s.obj"};
  for (const Index v : {0, 2, 4}) deformation.corners.push_back({v});
  deformation.stiffness = {{{20, 20}, 15, 0.5}};
  deformation.method = "bounded";
  deformation.parameters = {{"k", 0.5}};
  deformation.other_parameters = {{"pins", {}}};
  deformation = with_key(with_key(deformation, 0), 2);
  Layer layer;
  layer.name = "hero";
  layer.image = ImageReference{"hero.png", "", 60, 50, {}, "", ""};
  layer.deformation = std::move(deformation);
  return scene_of(std::move(layer));
}

/// The nearest whole number within a million; 0 for NaN.
int whole(double x) {
  return std::isnan(x) ? 0 : static_cast<int>(std::clamp(x, -1e6, 1e6));
}

/// A change that puts a number into a scene, where it may or may not be allowed.
using Change = std::function<void(Layer&, double)>;

const std::vector<std::pair<const char*, Change>> kNumbersChanged{
    {"rest",
     [](Layer& l, double x) {
       l.deformation.rest.segments[1][0] = {x, 3};
     }},
    {"pose",
     [](Layer& l, double x) {
       l.deformation.pose.segments[1][0] = {3, x};
     }},
    {"pin at rest",
     [](Layer& l, double x) {
       l.deformation.pins[0].rest = {x, x};
     }},
    {"pin",
     [](Layer& l, double x) {
       l.deformation.pins[1].pose = {x, 1};
     }},
    {"angle", [](Layer& l, double x) { l.deformation.pins[0].angle = x; }},
    {"scale", [](Layer& l, double x) { l.deformation.pins[0].scale = x; }},
    {"radius", [](Layer& l, double x) { l.deformation.pins[0].radius = x; }},
    {"turn", [](Layer& l, double x) { l.deformation.pins[0].turn = x; }},
    {"depth", [](Layer& l, double x) { l.deformation.pins[0].depth = whole(x); }},
    {"stroke",
     [](Layer& l, double x) {
       l.deformation.strokes[0].pose[1] = {x, 0};
     }},
    {"outline",
     [](Layer& l, double x) {
       l.deformation.outline[2] = {x, 40};
     }},
    {"a corner's vertex", [](Layer& l, double x) { l.deformation.corners[1].vertex = whole(x); }},
    {"a corner's turn", [](Layer& l, double x) { l.deformation.corners[0].pose.before = x; }},
    {"tension", [](Layer& l, double x) { l.deformation.corners[0].pose.tension = x; }},
    {"a dab",
     [](Layer& l, double x) {
       l.deformation.stiffness[0].at = {1, x};
     }},
    {"a dab's radius", [](Layer& l, double x) { l.deformation.stiffness[0].radius = x; }},
    {"a dab's level", [](Layer& l, double x) { l.deformation.stiffness[0].level = x; }},
    {"a parameter", [](Layer& l, double x) { l.deformation.parameters["sigma"] = x; }},
    {"time", [](Layer& l, double x) { l.deformation.keyframes[1].time = x; }},
    {"turns", [](Layer& l, double x) { l.deformation.keyframes[1].turns = whole(x); }},
    {"a key's cage",
     [](Layer& l, double x) { l.deformation.keyframes[0].pose.cage.segments[0][0] = x; }},
    {"a key's pin",
     [](Layer& l, double x) {
       l.deformation.keyframes[0].pose.pins[0].position = {x, 0};
     }},
    {"a key's angle",
     [](Layer& l, double x) { l.deformation.keyframes[0].pose.pins[0].angle = x; }},
    {"a key's turn", [](Layer& l, double x) { l.deformation.keyframes[0].pose.pins[0].turn = x; }},
    {"a key's scale",
     [](Layer& l, double x) { l.deformation.keyframes[1].pose.pins[0].scale = x; }},
    {"a key's tension",
     [](Layer& l, double x) { l.deformation.keyframes[1].pose.corners[0].tension = x; }},
    {"a key's stroke",
     [](Layer& l, double x) {
       l.deformation.keyframes[1].pose.strokes[0][1] = {x, 0};
     }},
    {"a choice",
     [](Layer& l, double x) { l.deformation.parameters["space"] = std::abs(whole(x)) % 3; }},
    {"a picture's size", [](Layer& l, double x) { l.image->height = whole(x); }},
    {"an unknown key", [](Layer& l, double) { l.extra = R"({"mood":"glad"})"; }},
    {"a key's corner",
     [](Layer& l, double x) { l.deformation.keyframes[0].pose.corners[1].after = x; }},
    {"name", [](Layer& l, double x) { l.name = x > 0 ? "b\xff" : "b\xc3\xa4r"; }},
    {"file", [](Layer& l, double x) { l.image->file = x > 0 ? "" : "caf\xe9.png"; }}};
/// Changes that remove parts. Each is applied alone, because the other changes need these parts.
const std::vector<std::pair<const char*, Change>> kPartsChanged{
    {"short stroke", [](Layer& l, double) { l.deformation.strokes[0].rest.resize(1); }},
    {"surface alone", [](Layer& l, double) { l.deformation.outline.clear(); }},
    {"two corners", [](Layer& l, double) { l.deformation.corners.pop_back(); }},
    {"a followed method's",
     [](Layer& l, double x) { l.deformation.other_parameters["pins"]["smoothness"] = x; }},
    {"pins", [](Layer& l, double x) {
       l.deformation.pins.resize(static_cast<size_t>(std::clamp(whole(x), 0, 3000)));
     }}};

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kNumbers[] = {0,     1,     -1,     0.5,   5,      150,   151,    1000, 1001, 3600,
                           3601,  1e5,   100001, 1e8,   1.01e8, -1e8,  -2e8,   1e30, kNan, -kNan,
                           1e308, 0.009, 1e-300, 10.01, -10,    -10.5, 2000.4, 2001, 24,   241};

}  // namespace

TEST_CASE("A scene is refused exactly when its file could not be read again") {
  const Scene scene = full_scene();
  REQUIRE_NOTHROW(check_scene(scene));
  int refused = 0, all = 0;
  const auto compare = [&](const Scene& changed) {
    const bool now = is_refused([&] { check_scene(changed); }),
               later = is_refused([&] { scene_from_json(json_of(changed), "s.json"); });
    CHECK(now == later);
    refused += now;
    ++all;
  };
  std::vector<std::pair<const char*, Change>> changes = kNumbersChanged;
  changes.insert(changes.end(), kPartsChanged.begin(), kPartsChanged.end());
  const auto apply = [](Scene& scene, const std::pair<const char*, Change>& row, double number) {
    change_layer(scene, [&](Layer& layer) { row.second(layer, number); });
  };
  for (const auto& row : changes)
    for (const double number : kNumbers) {
      INFO(row.first << " = " << number);
      Scene changed = scene;
      apply(changed, row, number);
      compare(changed);
    }
  for (const unsigned seed : seeds_of("check_scene", {1, 2})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> exponent(-4, 12), unit(-1, 1);
    for (int i = 0; i < 300; ++i) {
      Scene changed = scene;
      for (int k = 0; k < 2; ++k) {
        const auto& row = kNumbersChanged[random() % kNumbersChanged.size()];
        const double number = unit(random) * std::pow(10, exponent(random));
        INFO(row.first << " = " << number);
        apply(changed, row, number);
      }
      compare(changed);
    }
  }
  CHECK(refused > all / 5);  // many scenes are refused, and many are accepted
  CHECK(refused < 4 * all / 5);
}

TEST_CASE("A scene that would be larger than the budget is refused, with its size") {
  Scene scene = full_scene();
  const Budget before = budget();
  Budget small = before;
  small.scene = static_cast<double>(json_of(scene).size());
  set_budget(small);
  CHECK_NOTHROW(check_scene(scene));
  small.scene -= 1;
  set_budget(small);
  CHECK_THROWS_WITH(check_scene(scene), Catch::Contains("--max-scene-size"));
  set_budget(before);
}

TEST_CASE("Unknown keys that are too large or too deeply nested for a file are refused") {
  Scene scene = full_scene();
  CHECK_NOTHROW(check_scene(scene));
  // Readers accept 200 levels of nesting, so 300 levels are too many.
  std::string deep = "0";
  for (int i = 0; i < 300; ++i) deep = "[" + deep + "]";
  change_layer(scene, [&](Layer& layer) { layer.extra = "{\"deep\":" + deep + "}"; });
  CHECK_THROWS_AS(check_scene(scene), Error);
  CHECK_THROWS_AS(scene_from_json(json_of(scene), "s.json"), Error);
}

TEST_CASE("The frame rate, choices and the number of the edited layer are checked") {
  for (const double rate : {0.5, 1.0, 24.0, 240.0, 241.0, kNan}) {
    Scene scene = full_scene();
    scene.animation.frames_per_second = rate;
    INFO(rate);
    CHECK(is_refused([&] { check_scene(scene); }) ==
          is_refused([&] { scene_from_json(json_of(scene), "s.json"); }));
  }
  Scene scene = full_scene();
  scene.edited = 1;
  CHECK_THROWS_AS(check_scene(scene), Error);
  for (const double none : {-1.0, 3.0}) {  // choices that cannot even be written
    Scene chosen = full_scene();
    change(chosen, [&](Deformation& deformation) { deformation.parameters["space"] = none; });
    CHECK_THROWS_AS(check_scene(chosen), Error);
  }
}

TEST_CASE("An error in one of several layers gives the layer's number") {
  Scene scene = full_scene();
  scene.layers.insert(scene.layers.begin(), scene_of(with_cage({}, shapes::l_shape())).layers[0]);
  scene.edited = 1;
  change(scene, [](Deformation& deformation) { deformation.pins[1].pose = {1e9, 0}; });
  CHECK_THROWS_WITH(check_scene(scene), Catch::Contains("layer 2") && Catch::Contains("pin 2") &&
                                            Catch::Contains("larger than 1e8"));
}

}  // namespace holomorph::check_scene_test
