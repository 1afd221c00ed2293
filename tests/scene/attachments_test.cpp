// Layers that follow a pin, a stroke or a place of another layer.
#include "scene/attachments.h"

#include "core/error.h"
#include "scene/formats/scene_json.h"
#include "scene/layers.h"
#include "scene/prepared_map.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::attachments_test {

namespace {

/// Three layers: a parent with a cage, pins and a stroke, and two without.
Scene three_layers() {
  std::vector<Layer> layers(3);
  for (int i = 0; i < 3; ++i) {
    layers[i].id = i + 1;
    layers[i].name = std::string("layer ") + "abc"[i];
  }
  Deformation& parent = layers[0].deformation;
  parent = with_cage({}, shapes::rectangle(200, 100));
  parent.pins = {{{50, 50}, {50, 50}, {}, ""}, {{150, 50}, {150, 50}, {}, ""}};
  parent.strokes = {{{{20, 20}, {100, 30}, {180, 20}}, {{20, 20}, {100, 30}, {180, 20}}, ""}};
  Scene scene;
  scene.layers = shared(std::move(layers));
  return scene;
}

std::vector<AttachmentTarget> all_targets() {
  return {{0, Attachment::To::pin, 1},
          {0, Attachment::To::stroke, 0},
          {0, Attachment::To::place, 0, {120, 70}},
          {0, Attachment::To::place, 0, {-40, 300}}};  // beyond the cage
}

/// The scene with layer 1 attached to a target and layer 2 to a place of layer 1.
Scene chained(const AttachmentTarget& target) {
  auto [attachment, scene] = attachment_to(three_layers(), target);
  scene = with_attachment(std::move(scene), 1, attachment);
  auto [second, both] = attachment_to(scene, {1, Attachment::To::place, 0, {5, 5}});
  return with_attachment(std::move(both), 2, second);
}

double distance(const Similarity& a, const Similarity& b) {
  double most = 0;
  for (const Complex z : {Complex(0, 0), Complex(100, 0), Complex(30, 200)})
    most = std::max(most, std::abs(a(z) - b(z)));
  return most;
}

/// The placement of a layer when the vertices of layer 0 are moved by a map.
template <class Map>
Similarity placed(const Scene& scene, size_t layer, const PreparedMap& prepared, Map map) {
  Points positions;
  for (const Complex& z : prepared.mesh->vertices) positions.push_back(map(z));
  return placement_of(scene, layer, [&](size_t child) {
    const Layer& it = *scene.layers[child];
    if (it.attachment->layer != 1) return Similarity{};  // layer 1 has no cage of its own
    return Anchor(prepared.mesh, scene.layers[0]->deformation, *it.attachment).motion(positions);
  });
}

}  // namespace

TEST_CASE("attachments: layers follow a similarity exactly, also through others") {
  for (const unsigned seed : seeds_of("attachments", {1, 2, 3})) {
    std::mt19937 random(seed);
    const Complex drawn = random_complex(random);
    const Similarity moved{std::polar(std::exp(drawn.real()), 3 * drawn.imag()), 0,
                           100.0 * random_complex(random)};
    for (const AttachmentTarget& target : all_targets()) {
      const Scene scene = chained(target);
      const auto prepared =
          prepared_map(scene.layers[0]->deformation, Precision::full, MeshOptions{300});
      CHECK(distance(placed(scene, 0, *prepared, moved), {}) == 0);
      CHECK(distance(placed(scene, 1, *prepared, moved), moved) < 1e-9);
      CHECK(distance(placed(scene, 2, *prepared, moved), moved) < 1e-9);
    }
  }
}

TEST_CASE("attachments: an attached layer stays where it is, however its parent is posed") {
  const auto bend = [](Complex z) { return Complex(1.3, 0.4) * z + 2e-3 * z * z + 7.0; };
  for (const AttachmentTarget& target : all_targets()) {
    Scene scene = three_layers();
    const auto prepared =
        prepared_map(scene.layers[0]->deformation, Precision::full, MeshOptions{300});
    Points positions;
    for (const Complex& z : prepared->mesh->vertices) positions.push_back(bend(z));
    const Similarity before{{0.8, 0.1}, 0, {12, -5}};
    auto [attachment, with_id] = attachment_to(std::move(scene), target);
    const Anchor anchor(prepared->mesh, with_id.layers[0]->deformation, attachment);
    const Similarity motion = anchor.motion(positions);
    scene = with_attachment(with_id, 1, attachment, composed(inverse(motion), before));
    CHECK(distance(placed(scene, 1, *prepared, bend), before) < 1e-9);
    // It turns by what the parent turns there.
    if (target.to != Attachment::To::stroke && target.place.imag() < 200) {
      const Complex at = target.to == Attachment::To::pin ? Complex(150, 50) : target.place;
      CHECK(std::abs(motion.factor - (Complex(1.3, 0.4) + 4e-3 * at)) < 0.05);
      CHECK(std::abs(motion(at) - bend(at)) < 0.5);
    }
  }
}

TEST_CASE("attachments: files keep them by ids") {
  for (const AttachmentTarget& target : all_targets()) {
    const Scene scene = chained(target);
    const Scene read = scene_from_json(json_of(scene), "the file");
    CHECK(read == scene);
    CHECK(json_of(read) == json_of(scene));
    CHECK(attachment_text(read, 1) == attachment_text(scene, 1));
    CHECK(follows(read, 2, 0));
    // The order of layers does not matter.
    Scene turned = scene;
    std::ranges::reverse(turned.layers);
    const Scene again = scene_from_json(json_of(turned), "the file");
    CHECK(follows(again, 0, 2));
    CHECK_FALSE(follows(again, 2, 0));
  }
}

TEST_CASE("attachments: files keep what this version does not know") {
  std::string text = json_of(chained({0, Attachment::To::pin, 1}));
  const std::string known = "\"pin\": 1";
  text.replace(text.find(known), known.size(), known + ", \"delay\": 0.5");
  CHECK(json_of(scene_from_json(text, "the file")).find("\"delay\": 0.5") != std::string::npos);
}

TEST_CASE("attachments: a pin keeps what is attached to it when other pins are deleted") {
  Scene scene = chained({0, Attachment::To::pin, 1});
  Layer parent = *scene.layers[0];
  parent.deformation.pins.erase(parent.deformation.pins.begin());
  scene = with_layer_at(std::move(scene), 0, parent);
  CHECK(attachment_text(scene, 1) == "pin 1 of layer a");
  const Similarity here{{0, 2}, 0, {3, 4}};
  const auto placed = [&](int id) { return id == 2 ? here : Similarity{}; };
  CHECK(without_lost_parents(scene, placed) == scene);

  parent.deformation.pins.clear();
  scene = without_lost_parents(with_layer_at(std::move(scene), 0, parent), placed);
  CHECK_FALSE(scene.layers[1]->attachment);
  CHECK(scene.layers[1]->placement == here);
  CHECK(scene.layers[2]->attachment);
}

TEST_CASE("attachments: copies of layers follow the same parent, added scenes their own") {
  Scene scene = chained({0, Attachment::To::pin, 0});
  scene.edited = 1;
  const Scene doubled = with_layer_duplicated(scene);
  CHECK(parent_of(doubled, doubled.layer()) == 0u);
  const Scene both = with_layers_added(scene, scene);
  REQUIRE(both.layers.size() == 6);
  for (size_t i = 0; i < 6; ++i) {
    const auto parent = parent_of(both, *both.layers[i]);
    if (!parent) continue;
    const bool added = i >= 2 && i < 5;  // above the edited layer
    CHECK((*parent >= 2 && *parent < 5) == added);
  }
}

TEST_CASE("attachments: files with cycles or missing parents are refused") {
  const std::string text = json_of(chained({0, Attachment::To::pin, 1}));
  const auto refuses = [&](const std::string& from, const std::string& to, const char* message) {
    std::string changed = text;
    const size_t at = changed.find(from);
    INFO(from << " in " << text);
    REQUIRE(at != std::string::npos);
    changed.replace(at, from.size(), to);
    CHECK_THROWS_WITH(scene_from_json(changed, "the file"), Catch::Contains(message));
  };
  refuses("\"pin\": 1", "\"pin\": 7", "layer 2 is attached to a layer, pin or stroke that does");
  refuses("\"layer\": 1", "\"layer\": 9", "no layer has this id");
  refuses("\"layer\": 2", "\"layer\": 3", "no layer has this id");
  refuses("\"id\": 2", "\"id\": 1", "another layer has the same id");

  Scene circle = chained({0, Attachment::To::place, 0, {9, 9}});
  Layer first = *circle.layers[0];
  first.attachment = Attachment{2, Attachment::To::place, 0, {1, 1}, {}};
  circle = with_layer_at(std::move(circle), 0, first);
  CHECK_THROWS_WITH(check_attachments(circle), Catch::Contains("attached to itself"));
  CHECK_THROWS_WITH(scene_from_json(json_of(circle), "the file"),
                    Catch::Contains("attached to itself"));
}

}  // namespace holomorph::attachments_test
