// Edits of keyframes of several layers at once.
#include "scene/key_selection.h"

#include "scene/layers.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::key_selection_test {

namespace {

/// A scene with layers 1, 2, ... that have keyframes at these times.
Scene keyed_scene(const std::vector<std::vector<double>>& times) {
  std::vector<Layer> layers;
  for (const std::vector<double>& of_layer : times) {
    Layer layer;
    layer.id = static_cast<int>(layers.size()) + 1;
    layer.deformation = with_cage({}, shapes::rectangle(100, 50));
    for (const double time : of_layer) {
      layer.deformation.pose.segments[0][0] = Complex(-time, time);  // recognizes the keyframe
      layer.deformation = with_key(std::move(layer.deformation), time);
    }
    layers.push_back(std::move(layer));
  }
  Scene scene;
  scene.layers = shared(std::move(layers));
  return scene;
}

std::vector<double> times_of(const Scene& scene, size_t layer) {
  std::vector<double> times;
  for (const Keyframe& key : scene.layers[layer]->deformation.keyframes) times.push_back(key.time);
  return times;
}
/// The time at which a keyframe was made.
double origin(const Keyframe& key) {
  return key.pose.cage.segments[0][0].imag();
}

using Times = std::vector<double>;

}  // namespace

TEST_CASE("keys: moving takes the selected keys along, in all layers") {
  const Scene scene = keyed_scene({{0, 1, 2}, {0.5, 1, 3}});
  const KeySelection keys{{1, 1}, {1, 2}, {2, 1}};
  const auto moved = with_keys_moved(scene, keys, {1, 0, 0.25});
  REQUIRE(moved);
  CHECK(times_of(moved->scene, 0) == Times{0, 1.25, 2.25});
  CHECK(times_of(moved->scene, 1) == Times{0.5, 1.25, 3});
  CHECK(moved->keys == KeySelection{{1, 1.25}, {1, 2.25}, {2, 1.25}});
  CHECK(origin(moved->scene.layers[0]->deformation.keyframes[2]) == 2);
  // They can pass other keys, but not meet them, and not leave the allowed range.
  const auto passed = with_keys_moved(scene, {{1, 0}}, {1, 0, 1.5});
  REQUIRE(passed);
  CHECK(times_of(passed->scene, 0) == Times{1, 1.5, 2});
  CHECK_FALSE(with_keys_moved(scene, {{1, 0}}, {1, 0, 1}));
  CHECK_FALSE(with_keys_moved(scene, keys, {1, 0, -1.5}));
  CHECK_FALSE(with_keys_moved(scene, keys, {1, 0, kMaxTime}));
  CHECK(with_keys_moved(scene, keys, {})->scene == scene);
}

TEST_CASE("keys: moving and moving back, stretching and shrinking give the same scene") {
  for (const unsigned seed : seeds_of("keys", {1, 2, 3})) {
    std::mt19937 random(seed);
    std::vector<Times> times(3);
    for (Times& of_layer : times)
      for (int i = 0; i < 6; ++i)
        of_layer.push_back(i + 0.9 * std::abs(random_complex(random).real()));
    const Scene scene = keyed_scene(times);
    KeySelection keys;
    for (const KeyId& key : all_keys(scene))
      if (random_complex(random).real() > 0) keys.insert(key);
    if (keys.empty()) continue;
    const double by = 50 + 10 * std::abs(random_complex(random).imag());
    for (const TimeMap& map : {TimeMap{1, 0, by}, TimeMap{2.5, 0, by}}) {
      const auto there = with_keys_moved(scene, keys, map);
      REQUIRE(there);
      CHECK(there->keys.size() == keys.size());
      const auto back =
          with_keys_moved(there->scene, there->keys, {1 / map.factor, map.to, map.from});
      REQUIRE(back);
      for (size_t layer = 0; layer < 3; ++layer) {
        const Times now = times_of(back->scene, layer);
        REQUIRE(now.size() == times[layer].size());
        for (size_t i = 0; i < now.size(); ++i)
          CHECK(now[i] == Approx(times[layer][i]).margin(1e-9));
      }
    }
  }
}

TEST_CASE("keys: stretched keys are on whole frames, and none is lost") {
  const Scene scene = keyed_scene({{0, 0.5, 1}});
  const KeySelection keys = all_keys(scene);
  const auto longer = with_keys_moved(scene, keys, {1.3, 0, 0}, {.to_frames = true});
  REQUIRE(longer);
  for (const double time : times_of(longer->scene, 0))
    CHECK(std::abs(24 * time - std::round(24 * time)) < 1e-9);
  CHECK_FALSE(with_keys_moved(scene, keys, {0.01, 0, 0}, {.to_frames = true}));  // they would meet
}

TEST_CASE("keys: copies, ease, deletion and mirror images") {
  const Scene scene = keyed_scene({{0, 1}, {1}});
  const KeySelection keys{{1, 1}, {2, 1}};
  const auto copied = with_keys_moved(scene, keys, {1, 0, 2}, {.copies = true});
  REQUIRE(copied);
  CHECK(times_of(copied->scene, 0) == Times{0, 1, 3});
  CHECK(times_of(copied->scene, 1) == Times{1, 3});
  CHECK(origin(copied->scene.layers[1]->deformation.keyframes[1]) == 1);

  const Scene eased = with_keys_eased(scene, keys, Ease::hold);
  CHECK(common_ease(eased, keys) == Ease::hold);
  CHECK_FALSE(common_ease(eased, all_keys(eased)));
  CHECK(eased.layers[0]->deformation.keyframes[0].ease == Ease::smooth);

  const Scene fewer = without_keys(scene, keys);
  CHECK(times_of(fewer, 0) == Times{0});
  CHECK(times_of(fewer, 1).empty());

  const Scene twice = with_keys_mirrored(with_keys_mirrored(scene, keys), keys);
  CHECK(twice == scene);
  CHECK_FALSE(with_keys_mirrored(scene, keys) == scene);
}

TEST_CASE("keys: whole turns between mirrored keys go the other way") {
  Scene scene = keyed_scene({{0, 1, 2}});
  Layer layer = scene.layer();
  layer.deformation.keyframes[1].turns = 2;
  scene = with_layer_at(std::move(scene), 0, std::move(layer));
  const auto turns_of = [&](const KeySelection& keys) {
    return with_keys_mirrored(scene, keys).deformation().keyframes[1].turns;
  };
  CHECK(turns_of(all_keys(scene)) == -2);
  CHECK(turns_of({{1, 0}, {1, 1}}) == -2);
  CHECK(turns_of({{1, 1}, {1, 2}}) == 2);  // only one end of the turns is mirrored
  CHECK(turns_of({{1, 0}}) == 2);
  // If a key is deleted, those around it keep them.
  CHECK(without_keys(scene, {{1, 1}}).deformation().keyframes[1].turns == 2);
  CHECK(without_keys(scene, {{1, 0}}).deformation().keyframes[1].turns == 0);
  // A copy makes those turns only after a copy of the key before it.
  const auto copied = [&](const KeySelection& keys) {
    return with_keys_moved(scene, keys, {1, 0, 3}, {.copies = true})->scene.deformation().keyframes;
  };
  CHECK(copied({{1, 1}}).back().turns == 0);
  const std::vector<Keyframe> both = copied({{1, 0}, {1, 1}});
  CHECK(both[3].turns == 0);
  CHECK(both[4].turns == 2);
}

TEST_CASE("keys: turns are those between the same keys wherever keys are put") {
  Scene scene = keyed_scene({{0, 1, 2, 3}});
  Layer layer = scene.layer();
  for (const size_t k : {1, 2, 3}) layer.deformation.keyframes[k].turns = static_cast<int>(k);
  scene = with_layer(scene, layer);
  const auto turns_of = [&](const KeySelection& keys, const TimeMap& map, KeyMove how = {}) {
    const Scene moved = with_keys_moved(scene, keys, map, how)->scene;
    std::vector<int> turns;
    for (const Keyframe& key : moved.deformation().keyframes) turns.push_back(key.turns);
    return turns;
  };
  using Turns = std::vector<int>;
  CHECK(turns_of({{1, 1}}, {1, 0, 0.5}) == Turns{0, 1, 2, 3});
  CHECK(turns_of({{1, 1}}, {1, 0, 1.5}) == Turns{0, 3, 0, 3});
  CHECK(turns_of({{1, 1}, {1, 2}}, {1, 0, 5}) == Turns{0, 6, 0, 2});
  CHECK(turns_of({{1, 0}}, {1, 0, 1.5}) == Turns{0, 0, 2, 3});
  // Copies between the originals make no turns of their own.
  CHECK(turns_of({{1, 0}, {1, 1}, {1, 2}, {1, 3}}, {1, 0, 0.25}, {.copies = true}) ==
        Turns{0, 0, 1, 0, 2, 0, 3, 0});
}

TEST_CASE("keys: copies are pasted as they were, where they fit") {
  Scene scene = keyed_scene({{0, 1, 2}, {1}});
  Layer first = *scene.layers[0];
  first.deformation.keyframes[1].turns = 2;
  first.deformation.keyframes[1].ease = Ease::hold;
  first.deformation.keyframes[2].turns = -1;
  scene = with_layer_at(scene, 0, first);
  const CopiedKeys copied = copied_keys(scene, all_keys(scene));
  CHECK(copied.keys() == all_keys(scene));
  CHECK(copied_keys(scene, {{1, 1}}).layers.at(1)[0].turns == 0);  // without the key before it

  // What happens to the originals does not matter.
  const Scene cut = without_keys(scene, all_keys(scene));
  const auto pasted = with_keys_pasted(cut, fitting(cut, copied), {1, 0, 5});
  REQUIRE(pasted);
  CHECK(pasted->keys == KeySelection{{1, 5}, {1, 6}, {1, 7}, {2, 6}});
  for (size_t layer = 0; layer < 2; ++layer) {
    const auto &before = scene.layers[layer]->deformation.keyframes,
               &after = pasted->scene.layers[layer]->deformation.keyframes;
    REQUIRE(after.size() == before.size());
    for (size_t k = 0; k < after.size(); ++k) {
      CHECK(after[k].pose == before[k].pose);
      CHECK(after[k].ease == before[k].ease);
      CHECK(after[k].turns == before[k].turns);
    }
  }
  CHECK_FALSE(with_keys_pasted(scene, copied, {1, 0, 1}));  // they would meet others

  // Layers that are gone, hidden, locked or have another cage get none.
  const auto fits_in = [&](auto change) {
    Layer layer = *cut.layers[0];
    change(layer);
    const CopiedKeys left = fitting(with_layer_at(cut, 0, layer), copied);
    CHECK(left.layers.contains(2));
    return left.layers.contains(1);
  };
  CHECK(fits_in([](Layer&) {}));
  Scene fewer = cut;
  fewer.edited = 0;
  CHECK_FALSE(fitting(without_layer(fewer), copied).layers.contains(1));
  CHECK_FALSE(fits_in([](Layer& layer) { layer.visible = false; }));
  CHECK_FALSE(fits_in([](Layer& layer) { layer.locked = true; }));
  CHECK_FALSE(fits_in([](Layer& layer) {
    layer.deformation = with_cage({}, {{0, 0}, {10, 0}, {5, 9}});
  }));
}

TEST_CASE("keys: those of locked and hidden layers cannot be chosen") {
  Scene scene = keyed_scene({{0, 1}, {1}});
  Layer second = *scene.layers[1];
  second.locked = true;
  scene = with_layer_at(scene, 1, second);
  CHECK(editable_keys(scene, all_keys(scene)) == KeySelection{{1, 0}, {1, 1}});
  CHECK(editable_keys(scene, {{1, 0.5}, {7, 1}}).empty());
  CHECK(span_of(all_keys(scene)) == std::pair(0.0, 1.0));
}

}  // namespace holomorph::key_selection_test
