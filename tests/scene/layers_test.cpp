// Layers: operations on the stack leave each layer unchanged, files keep the stack, and maps follow
// it.
#include "scene/layers.h"

#include <thread>

#include "core/error.h"
#include "scene/document.h"
#include "scene/formats/scene_json.h"
#include "scene/keyframes.h"
#include "scene/last_pictures.h"
#include "scene/layer_maps.h"
#include "scene/preferences.h"
#include "support/catch.h"
#include "support/complaint.h"
#include "support/folder.h"
#include "support/scenes.h"
#include "support/seeds.h"
#include "support/shapes.h"
#include "system/new_file.h"

namespace holomorph::layers_test {

namespace {

Scene layer(const std::string& name, double width) {
  Layer layer;
  layer.name = name;
  layer.deformation = with_cage({}, shapes::rectangle(width, 60));
  return scene_of(std::move(layer));
}

Scene with_edited(Scene scene, size_t number) {
  scene.edited = number;
  return scene;
}

/// A stack of a bottom, a middle and a top layer; the top one is edited.
Scene stack() {
  return with_layers_added(with_layers_added(layer("bottom", 100), layer("middle", 110)),
                           layer("top", 120));
}

std::string names(const Scene& scene) {
  std::string names;
  for (const SharedLayer& layer : scene.layers) names += layer->name.substr(0, 1);
  return names;
}

std::string complaint(const std::string& text) {
  return error_message_of([&] { scene_from_json(text, "s.json"); });
}

}  // namespace

TEST_CASE("Behind an opaque picture lies the original, and behind a cut-out nothing") {
  const Folder folder;
  Image image(20, 10);
  std::ranges::fill(image.pixels, std::uint8_t{255});
  for (const bool opaque : {true, false}) {
    if (!opaque) image.at(3, 4)[3] = 254;
    const Path file = folder.path / (opaque ? "photo.png" : "cut-out.png");
    write_file(file, encode_png(image));
    CHECK(scene_of_image(file).scene.background.fill ==
          (opaque ? Background::Fill::original : Background::Fill::transparent));
  }
}

TEST_CASE("Last pictures are kept by the hash of their scene, and damaged ones are ignored") {
  const Folder folder;
  ::setenv("XDG_STATE_HOME", folder.path.c_str(), 1);
  LastPicture picture{Image(3, 2), {}};
  picture.box.include({-1, 2}), picture.box.include({5, 6});
  picture.image.at(1, 1)[3] = 200;
  keep_last_picture("abc", picture);
  const auto found = last_picture_of("abc");
  REQUIRE(found);
  CHECK(found->image == picture.image);
  CHECK(found->box.left == -1);
  CHECK(found->box.top == 6);
  CHECK_FALSE(last_picture_of("abd"));
  CHECK_FALSE(last_picture_of(""));
  for (int i = 0; i < 45; ++i) keep_last_picture("n" + std::to_string(i), picture);
  int kept = 0;
  for (int i = 0; i < 45; ++i) kept += last_picture_of("n" + std::to_string(i)).has_value();
  CHECK(kept == 40);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(last_picture_folder()))
    if (entry.is_regular_file()) write_file(entry.path(), "not a picture");
  for (int i = 0; i < 45; ++i) CHECK_FALSE(last_picture_of("n" + std::to_string(i)));
  ::unsetenv("XDG_STATE_HOME");
}

TEST_CASE("Selecting a layer changes only which one is edited") {
  Scene scene = stack();
  scene.background = {Background::Fill::color, {1, 2, 3}};
  scene.extra = R"({"mood":"glad"})";
  scene = with_animation(scene, {12, true});
  CHECK(names(scene) == "bmt");
  CHECK(scene.edited == 2);
  for (const size_t other : {0, 1, 2}) {
    const Scene chosen = with_edited(scene, other);
    CHECK(chosen.edited == other);
    CHECK(names(chosen) == "bmt");
    CHECK(chosen.layer().name == scene.layers[other]->name);
    CHECK(chosen.layer() == *scene.layers[other]);
    CHECK(chosen.background == scene.background);
    CHECK(chosen.extra == scene.extra);
    CHECK(chosen.animation == scene.animation);
    CHECK(with_edited(chosen, 2) == scene);
  }
}

TEST_CASE("Moving, duplicating and deleting a layer leaves the other layers unchanged") {
  const Scene scene = stack();
  CHECK(names(with_layer_moved(scene, 0)) == "tbm");
  CHECK(with_layer_moved(with_layer_moved(scene, 0), 2) == scene);
  CHECK(with_layer_moved(scene, 1).edited == 1);
  const Scene doubled = with_layer_duplicated(with_edited(scene, 1));
  CHECK(names(doubled) == "bmmt");
  CHECK(doubled.layer().name == "middle copy");
  CHECK(doubled.deformation() == scene.layers[1]->deformation);
  CHECK(without_layer(doubled) == with_edited(scene, 1));
  CHECK(names(without_layer(with_edited(scene, 0))) == "mt");
  // Ids do not change and are never shared.
  for (size_t i = 0; i < doubled.layers.size(); ++i) {
    const int id = doubled.layers[i]->id;
    CHECK(layer_index(doubled, id) == i);
  }
  CHECK(layer_index(doubled, 99) == doubled.layers.size());
  Layer hidden = *scene.layers[0];
  hidden.visible = false;
  hidden.id = 77;
  const Scene changed = with_layer_at(scene, 0, hidden);
  CHECK_FALSE(changed.layers[0]->visible);
  CHECK(changed.layers[0]->id == scene.layers[0]->id);
  CHECK(changed.layers[1] == scene.layers[1]);
  CHECK(changed != scene);
  // Another scene is added with all of its layers, and its edited layer becomes the edited one.
  const Scene both = with_layers_added(with_edited(scene, 0), with_edited(scene, 1));
  CHECK(names(both) == "bbmtmt");
  CHECK(both.edited == 2);
  Scene full = scene;
  while (full.layers.size() < kMaxLayers) full = with_layers_added(full, Scene{});
  CHECK_THROWS_AS(with_layers_added(full, Scene{}), Error);
}

TEST_CASE("Files keep layers, and a scene with a single plain layer is written without a list") {
  Scene scene = stack();
  scene = with_edited(scene, 1);
  Layer layer = scene.layer();
  layer.visible = false;
  layer.locked = true;
  layer.extra = R"({"tint":7})";
  layer.deformation = with_key(std::move(layer.deformation), 0.5);
  layer.deformation.stiffness = {{{30, 20}, 15, 0.5}, {{40.25, 20}, 15, -0.5}};
  scene = with_layer(std::move(scene), std::move(layer));
  scene.extra = R"({"mood":"glad"})";
  scene.background.fill = Background::Fill::original;
  CHECK(scene_from_json(json_of(scene), "s.json") == scene);
  CHECK(json_of(scene).find("\"version\": 2") != std::string::npos);
  const Scene plain = scene_of(with_cage({}, shapes::rectangle(90, 60)));
  CHECK(json_of(plain).find("\"version\": 1") != std::string::npos);
  CHECK(json_of(plain).find("layers") == std::string::npos);
  for (const Background background : {Background{},
                                      Background{Background::Fill::original},
                                      {Background::Fill::color, {250, 0, 16}}}) {
    Scene on = plain;
    on.background = background;
    change(on, [](Deformation& deformation) {
      deformation.pins = {{{10, 10}, {10, 10}, {}, {}}, {{20, 10}, {20, 10}, {}, {}, 1, -3}};
      deformation.stiffness = {{{30, 20}, 15, 0.5}};
    });
    CHECK(scene_from_json(json_of(on), "s.json") == on);
    CHECK(scene_from_json(json_of(on), "s.json").extra.empty());
  }
}

TEST_CASE("Preferences survive writing and reading, and damaged keys affect nothing else") {
  const Folder folder;
  ::setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
  Preferences preferences;
  preferences.theme = Theme::contrast;
  preferences.ui_scale = 1.5;
  preferences.native_dialogs = preferences.hints = false;
  preferences.recent = {"/tmp/a.json"};
  preferences.keys = {{"tool.pen", {"J"}}};
  save_preferences(preferences);
  CHECK(load_preferences() == preferences);
  const Path file = folder.path / "holomorph" / "preferences.json";
  std::string text = read_file(file);
  text.replace(text.find("\"J\""), 3, "7");
  write_file(file, text);
  preferences.keys.clear();
  CHECK(load_preferences() == preferences);
  ::unsetenv("XDG_CONFIG_HOME");
}

TEST_CASE("Errors in a layer name its position in the file") {
  const std::string text = json_of(stack());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return complaint(changed);
  };
  CHECK_THAT(with("\"edited\": 2", "\"edited\": 3"), Catch::Contains("/edited"));
  CHECK_THAT(with("\"middle\"", "7"), Catch::Contains("/layers/1/name"));
  CHECK_THAT(with("\"name\": \"top\"", "\"visible\": 1"), Catch::Contains("/layers/2/visible"));
  CHECK_THAT(with("\"edited\"", "\"background\": \"#12345\", \"edited\""),
             Catch::Contains("/background"));
  CHECK_THAT(complaint(R"({"format": "holomorph", "version": 2, "layers": []})"),
             Catch::Contains("/layers"));
}

TEST_CASE(
    "The film lasts as long as the keyframes of the longest layer, and plays if any layer does") {
  Scene scene = layer("bottom", 100);
  change(scene, [](Deformation& deformation) {
    deformation = with_key(with_key(std::move(deformation), 0), 3);
  });
  scene = with_layers_added(scene, layer("top", 100));
  CHECK(scene.deformation().keyframes.empty());
  CHECK(length_of(scene) == 3);
  CHECK(plays(scene));
  CHECK(has_keyframes(scene));
  CHECK_FALSE(plays(stack()));
}

TEST_CASE("Each layer keeps its map while layers are selected and moved") {
  LayerMaps maps;
  Scene scene = stack();
  maps.update_others(scene, {});
  for (const SharedLayer& layer : scene.layers) maps.of(layer->id).finish(layer->deformation, {});
  const LiveMap& lowest = maps.of(scene.layers[0]->id);
  REQUIRE(lowest.has_map());
  const unsigned preparation = lowest.preparation();
  scene = with_edited(with_layer_moved(scene, 0), 1);
  CHECK(scene.layer().name == "bottom");
  LiveMap& now = maps.of(scene.layer().id);
  CHECK(&now == &lowest);
  now.update(scene.deformation(), {});
  CHECK(now.preparation() == preparation);
  CHECK_FALSE(now.busy());
}

TEST_CASE("Maps of layers that are not edited follow every change, and only changes") {
  const auto settle = [](LayerMaps& maps, const Scene& scene, const Moment& moment) {
    const auto busy = [&](const SharedLayer& each) { return maps.of(each->id).busy(); };
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      maps.update_others(scene, moment);
      maps.of(scene.layer().id).update(scene.deformation(), {}, moment);
    } while (std::ranges::any_of(scene.layers, busy));
  };
  for (const unsigned seed : seeds_of("maps of layers", {1})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    Scene scene = stack();
    for (size_t i = 0; i < scene.layers.size(); ++i) {
      scene = with_edited(scene, i);
      change(scene, [&](Deformation& deformation) {
        deformation = with_key(std::move(deformation), 0);
        deformation.pose.segments[0][0] += 9.0 * random_complex(random);
        deformation = with_key(std::move(deformation), 1);
      });
    }
    LayerMaps maps;
    Moment moment;
    for (int step = 0; step < 12; ++step) {
      const size_t layer = random() % scene.layers.size();
      if (const unsigned kind = random() % 4; kind == 0)
        moment = {0.001 * static_cast<double>(random() % 1000)};
      else if (kind == 1)
        moment = {};
      else if (kind == 2)
        scene = with_edited(scene, layer);
      else
        change(scene, [&](Deformation& deformation) {
          deformation.pose.segments[1][0] += 5.0 * random_complex(random);
        });
      settle(maps, scene, moment);
      LayerMaps fresh;
      settle(fresh, scene, moment);
      for (const SharedLayer& each : scene.layers) {
        const VectorXc &f = maps.of(each->id).map().f, &expected = fresh.of(each->id).map().f;
        REQUIRE(f.size() == expected.size());
        CHECK((f - expected).cwiseAbs().maxCoeff() < 1e-9);
      }
      std::vector<unsigned> revisions;
      for (const SharedLayer& each : scene.layers)
        revisions.push_back(maps.of(each->id).revision());
      CHECK_FALSE(maps.update_others(scene, moment));
      for (size_t i = 0; i < revisions.size(); ++i)
        CHECK(maps.of(scene.layers[i]->id).revision() == revisions[i]);
    }
  }
}

TEST_CASE("A document finds the pictures of all layers wherever it is saved") {
  const Folder folder;
  std::filesystem::create_directories(folder.path / "pictures");
  write_file(folder.path / "pictures" / "a.png", encode_png(Image(8, 6)));
  write_file(folder.path / "b.png", encode_png(Image(5, 4)));
  Document document = Document::open(folder.path / "pictures" / "a.png");
  LoadedScene other = scene_of_image(folder.path / "b.png");
  document.put_picture(*other.scene.layer().image,
                       *other.pictures.find(*other.scene.layer().image));
  document.commit("Add", with_layers_added(document.scene(), other.scene));
  CHECK(document.image()->width == 5);
  document.save(folder.path / "pictures" / "s.json");
  const std::string text = read_file(folder.path / "pictures" / "s.json");
  CHECK(text.find("\"a.png\"") != std::string::npos);
  CHECK(text.find("\"../b.png\"") != std::string::npos);
  const Document again = Document::open(folder.path / "pictures" / "s.json", {true});
  CHECK(again.image()->width == 5);
  CHECK(again.pictures().of(*again.scene().layers[0])->width == 8);
  for (const char* name : {"pictures/a.png", "b.png", "pictures/s.json"})
    CHECK_THROWS_AS(check_not_a_source(folder.path / name, again.sources()), Error);
  std::filesystem::remove(folder.path / "b.png");
  // A missing picture does not affect the others, and the scene still names it.
  const Document rest = Document::open(folder.path / "pictures" / "s.json", {true});
  CHECK_THAT(rest.warning(), Catch::Contains("/layers/1/image/file"));
  CHECK_FALSE(rest.image());
  CHECK(rest.scene().layer().image->file == (folder.path / "b.png").string());
  CHECK(rest.pictures().of(*rest.scene().layers[0]));
}

TEST_CASE(
    "A missing picture is looked for next to the scene, and the scene also opens without it") {
  const Folder folder;
  std::filesystem::create_directories(folder.path / "art");
  write_file(folder.path / "art" / "a.png", encode_png(Image(8, 6)));
  Document document = Document::open(folder.path / "art" / "a.png");
  document.commit("Cage", scene_with_cage(document.scene(), shapes::rectangle(8, 6)));
  document.save(folder.path / "s.json");
  std::filesystem::rename(folder.path / "art" / "a.png", folder.path / "a.png");
  const Document moved = Document::open(folder.path / "s.json");
  REQUIRE(moved.image());
  CHECK(moved.image_path() == folder.path / "a.png");
  CHECK(moved.layers_without_picture().empty());
  std::filesystem::remove(folder.path / "a.png");
  const Document without = Document::open(folder.path / "s.json");
  CHECK_FALSE(without.image());
  CHECK(without.layers_without_picture() == std::vector<size_t>{0});
  CHECK_THAT(without.warning(), Catch::Contains("a.png"));
  CHECK(without.image_path() == folder.path / "art" / "a.png");
  CHECK(without.scene().layer().image->sha256 == moved.scene().layer().image->sha256);
  CHECK_THROWS_AS(load_scene(folder.path / "s.json"), Error);  // without a window it is an error
}

TEST_CASE("A file of the same name next to the scene is not taken for the picture") {
  const Folder folder;
  std::filesystem::create_directories(folder.path / "a");
  std::filesystem::create_directories(folder.path / "b");
  write_file(folder.path / "a" / "hero.png", encode_png(Image(8, 6)));
  write_file(folder.path / "b" / "hero.png", encode_png(Image(5, 4)));
  Document document = Document::open(folder.path / "a" / "hero.png");
  const LoadedScene other = scene_of_image(folder.path / "b" / "hero.png");
  document.put_picture(*other.scene.layer().image,
                       *other.pictures.find(*other.scene.layer().image));
  document.commit("Add", with_layers_added(document.scene(), other.scene));
  document.save(folder.path / "s.json");
  std::filesystem::rename(folder.path / "a" / "hero.png", folder.path / "hero.png");
  std::filesystem::remove(folder.path / "b" / "hero.png");
  const Document opened = Document::open(folder.path / "s.json");
  CHECK(opened.layers_without_picture() == std::vector<size_t>{1});
  CHECK(opened.pictures().of(*opened.scene().layers[0])->width == 8);
  CHECK_THROWS_AS(load_scene(folder.path / "s.json"), Error);
}

TEST_CASE("Pictures are written in the format of their file name and read back") {
  Image image(37, 21);
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c) {
      const std::uint8_t pixel[4] = {static_cast<std::uint8_t>(7 * c),
                                     static_cast<std::uint8_t>(12 * r), 90,
                                     static_cast<std::uint8_t>(c < 20 ? 255 : 0)};
      std::copy_n(pixel, 4, image.at(c, r));
    }
  const auto written = [&](const char* name) {
    return decode_image(picture_format_of(name).encode(image, 8), name);
  };
  CHECK(written("a.png") == image);
  CHECK(written("a") == image);
  const Image webp = written("a.WEBP"), jpeg = written("a.jpeg");
  REQUIRE(webp.width == image.width);
  REQUIRE(jpeg.height == image.height);
  CHECK(is_opaque(jpeg));
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c) {
      CHECK(webp.at(c, r)[3] == image.at(c, r)[3]);
      for (int k = 0; k < 3 && c < 16; ++k) {
        CHECK(webp.at(c, r)[k] == image.at(c, r)[k]);
        CHECK(std::abs(jpeg.at(c, r)[k] - image.at(c, r)[k]) < 24);
      }
      if (c >= 24) CHECK(std::min({jpeg.at(c, r)[0], jpeg.at(c, r)[1], jpeg.at(c, r)[2]}) > 240);
    }
  CHECK_THROWS_AS(picture_format_of("a.bmp"), Error);
}

TEST_CASE("A pasted picture is saved with the scene, even if its own file is gone") {
  const Folder folder;
  ::setenv("XDG_DATA_HOME", (folder.path / "data" / "..").c_str(), 1);
  std::filesystem::create_directories(folder.path / "data");
  Document document;
  const LoadedScene pasted = scene_of_pasted(encode_png(Image(7, 5)));
  document.put_picture(*pasted.scene.layer().image,
                       *pasted.pictures.find(*pasted.scene.layer().image));
  document.commit("Paste", pasted.scene);
  std::filesystem::remove(pasted.scene.layer().image->file);
  document.save(folder.path / "s.json");
  CHECK_FALSE(document.modified());
  const Path copy = document.image_path();
  CHECK(copy.parent_path() == folder.path);
  CHECK(document.image()->width == 7);
  CHECK_THROWS_AS(check_not_a_source(copy, document.sources()), Error);
  CHECK(Document::open(folder.path / "s.json").image()->width == 7);
  // The scene can also be recovered, even if the picture is gone.
  document.commit("Cage", scene_with_cage(document.scene(), shapes::rectangle(7, 5)));
  CHECK(document.autosave(folder.path / "autosave"));
  std::filesystem::remove(copy);
  const auto left = std::filesystem::directory_iterator(folder.path / "autosave");
  for (const auto& entry : left)
    if (entry.path().extension() == ".json")
      CHECK(Document::recover(entry.path()).scene().deformation().has_cage());
  ::unsetenv("XDG_DATA_HOME");
}

}  // namespace holomorph::layers_test
