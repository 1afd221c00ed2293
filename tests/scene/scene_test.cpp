// Scenes as files: nothing is lost, and every error says what is wrong.
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/document.h"
#include "scene/formats/export.h"
#include "scene/formats/scene_json.h"
#include "scene/live_map.h"
#include "scene/preferences.h"
#include "scene/prepared_map.h"
#include "scene/recovery.h"
#include "support/catch.h"
#include "support/complaint.h"
#include "support/folder.h"
#include "support/scenes.h"
#include "support/shapes.h"
#include "system/new_file.h"
#include "system/text.h"

namespace holomorph::scene_test {
namespace fs = std::filesystem;

namespace {

/// A scene with keys that this version does not know.
const char* const kText = R"({
  "format": "holomorph", "version": 1, "author": {"name": "x"},
  "cage": {"rest": [[[10,10]], [[180,10]], [[180,200]], [[10,200]]],
           "pose": [[[10,10]], [[180,10],[200,60],[190,120]], [[180,210.1234567890123]], [[10,200]]], "note": 1},
  "pins": [{"rest": [50,60], "pose": [55,80], "angle": 0.5, "colour": "red"}, {"rest": [90, 90]}],
  "strokes": [{"rest": [[20,20],[60,90]]}],
  "method": {"id": "pins", "parameters": {"exact": false, "smoothness": 1e-4}, "later": [1, {"a": null}]}
})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string complaint(const std::string& text) {
  return error_message_of([&] { scene_from_json(text, "scene.json"); });
}

}  // namespace

TEST_CASE("A scene survives writing and reading, unknown keys included") {
  const Scene scene = scene_from_json(kText, "scene.json");
  const Deformation& deformation = scene.deformation();
  CHECK(deformation.pose.degree(1) == 3);
  CHECK(deformation.pins[0].angle == 0.5);
  CHECK(deformation.pins[1].pose == deformation.pins[1].rest);
  const std::string written = json_of(scene);
  CHECK(scene_from_json(written, "again") == scene);
  CHECK(json_of(scene_from_json(written, "again")) == written);
  for (const char* kept :
       {"\"author\"", "\"strokes\"", "\"colour\"", "\"later\"", "\"note\"", "210.1234567890123"})
    CHECK_THAT(written, Catch::Contains(kept));
}

TEST_CASE("Errors in a scene name the file, the JSON pointer and the reason") {
  using Catch::Contains;
  CHECK_THAT(complaint("{"),
             Contains("scene.json") && Contains("damaged or ends too early, at line"));
  CHECK_THAT(complaint("[]"), Contains("expected an object"));
  CHECK_THAT(complaint("{}"), Contains("not a Holomorph scene"));
  CHECK_THAT(complaint(replaced(kText, "\"version\": 1", "\"version\": 5")),
             Contains("/version") && Contains("newer"));
  CHECK_THAT(complaint(replaced(kText, "[50,60]", "[50]")), Contains("/pins/0/rest"));
  CHECK_THAT(complaint(replaced(kText, "[50,60]", "[50,\"60\"]")),
             Contains("/pins/0/rest/1") && Contains("a string"));
  CHECK_THAT(complaint(replaced(kText, "[50,60]", "[50,1e999]")),
             Contains("scene.json") && Contains("the number '1e999' is too large"));
  CHECK_THAT(complaint(replaced(kText, "[50,60]", "[50,NaN]")),
             Contains("damaged or ends too early, at line"));
  CHECK_THAT(complaint(replaced(kText, "[50,60]", "[50,1e9]")), Contains("larger than"));
  CHECK_THAT(complaint(replaced(kText, "[[180,200]]", "[]")), Contains("/cage/rest/2"));
  CHECK_THAT(complaint(replaced(kText, "[[180,200]], ", "")),
             Contains("/cage/pose") && Contains("must agree"));
  CHECK_THAT(complaint(replaced(kText, "[[180,10]], [[180,200]]", "[[180,200]], [[180,10]]")),
             Contains("/cage/rest") && Contains("crosses itself"));
  CHECK_THAT(complaint(replaced(kText, "\"pins\", \"parameters\"", "\"magic\", \"parameters\"")),
             Contains("/method/id"));
  CHECK_THAT(complaint(replaced(kText, "1e-4", "7")), Contains("/method/parameters/smoothness"));
  CHECK_THAT(complaint(replaced(kText, "\"smoothness\"", "\"smothness\"")),
             Contains("no parameter 'smothness'"));
  CHECK_THAT(complaint(replaced(kText, "[55,80]", "{}")), Contains("/pins/0/pose"));
  const std::string deep(200000, '[');
  CHECK_THAT(complaint(replaced(kText, "{\"name\": \"x\"}", deep + std::string(200000, ']'))),
             Contains("nested"));
  Scene unspeakable = scene_from_json(kText, "x");
  change_layer(unspeakable, [](Layer& layer) {
    layer.image = ImageReference{"caf\xe9.png", "", 0, 0, {}, "", ""};
  });
  CHECK_THROWS_AS(json_of(unspeakable), Error);
  std::string many = R"({"format":"holomorph","version":1,"cage":{"rest":[)";
  for (int i = 0; i < 6000; ++i) many += "[[0,0]],";
  CHECK_THAT(complaint(many + "[[1,1]]]}}"), Contains("more than 5000"));
}

TEST_CASE("A frame is kept, and files that have one are not for older programs") {
  using Catch::Contains;
  Scene scene = scene_from_json(kText, "x");
  CHECK_THAT(json_of(scene), Contains("\"version\": 1") && !Contains("\"frame\""));
  for (const Frame frame : {Frame::slide, Frame::fixed}) {
    change_layer(scene, [&](Layer& layer) { layer.deformation.frame = frame; });
    const std::string written = json_of(scene);
    CHECK_THAT(written, Contains("\"version\": 4") && Contains("\"frame\": "));
    CHECK(scene_from_json(written, "again") == scene);
  }
  change_layer(scene, [](Layer& layer) {
    layer.deformation.frame = Frame::free;
    layer.deformation.held_beyond = 12.5;
  });
  CHECK_THAT(json_of(scene), Contains("\"version\": 4") && Contains("\"held_beyond\": 12.5"));
  CHECK(scene_from_json(json_of(scene), "again") == scene);
  CHECK_THAT(complaint(replaced(json_of(scene), "12.5", "-1")), Contains("/held_beyond"));
  change_layer(scene, [](Layer& layer) { layer.deformation.frame = Frame::fixed; });
  CHECK_THAT(complaint(replaced(json_of(scene), "\"fixed\"", "\"golden\"")),
             Contains("/frame") && Contains("slide"));
}

TEST_CASE("Writing replaces a file as a whole or not at all") {
  const Folder folder;
  const Path path = folder.path / "a.json";
  write_file(path, "one");
  write_file(path, "two");
  CHECK(read_file(path) == "two");
  CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 1);  // nothing else is left
  CHECK_THROWS_AS(write_file(folder.path, "x"), Error);
  CHECK_THROWS_AS(write_file(folder.path / "no" / "where", "x"), Error);
  CHECK_THROWS_AS(read_file(folder.path), Error);
  CHECK_THROWS_AS(read_file(folder.path / "missing"), Error);
  fs::create_symlink(path, folder.path / "link");
  write_file(folder.path / "link", "three");
  CHECK(read_file(path) == "three");
  CHECK(fs::is_symlink(folder.path / "link"));
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  write_file(path, "four");
  CHECK((fs::status(path).permissions() & fs::perms::all) ==
        (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("A write that is interrupted in the middle leaves the old file and nothing else") {
  const Folder folder;
  const Path path = folder.path / "a.json";
  write_file(path, "the old content");
  const pid_t child = ::fork();
  if (child == 0) {  // a full disk, as far as this process can tell
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_file(path, std::string(1 << 20, 'x'));
      ::_exit(1);
    } catch (const Error&) {
      ::_exit(0);
    }
  }
  int status = -1;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(read_file(path) == "the old content");
  CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 1);
}

TEST_CASE("A lock is held while its program runs, and not afterwards") {
  const Folder folder;
  const Path path = folder.path / "a.lock";
  CHECK_FALSE(FileLock::is_held(path));
  {
    const FileLock lock(path);
    CHECK(FileLock::is_held(path));
    CHECK_THROWS_AS(FileLock(path), Error);
  }
  CHECK_FALSE(fs::exists(path));
  const pid_t child = ::fork();
  if (child == 0) {
    const FileLock lock(path);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(WIFSIGNALED(status));
  CHECK(fs::exists(path));
  CHECK_FALSE(FileLock::is_held(path));
}

TEST_CASE("SHA-256 of the empty string has the published value") {
  CHECK(sha256_hex("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_CASE(
    "A document saves the path of a picture relative to the scene, wherever the scene is saved") {
  const Folder folder;
  fs::create_directories(folder.path / "pictures");
  write_file(folder.path / "pictures" / "dot.png", encode_png(Image(8, 6)));
  Document document = Document::open(folder.path / "pictures" / "dot.png");
  CHECK_FALSE(document.modified());
  CHECK(document.scene().layer().image->width == 8);
  document.commit("Cage", scene_with_cage(document.scene(), shapes::rectangle(8, 6)));
  CHECK(document.modified());
  fs::create_directories(folder.path / "scenes");
  document.save(folder.path / "scenes" / "s.json");
  CHECK_FALSE(document.modified());
  const Document again = Document::open(folder.path / "scenes" / "s.json", {true});
  CHECK(read_file(folder.path / "scenes" / "s.json").find("\"../pictures/dot.png\"") !=
        std::string::npos);
  CHECK(again.image_path() == folder.path / "pictures" / "dot.png");
  CHECK(again.image() != nullptr);
  CHECK(again.warning().empty());
  Image other(8, 6);
  other.pixels[3] = 200;
  write_file(folder.path / "pictures" / "dot.png", encode_png(other));
  CHECK_THAT(Document::open(folder.path / "scenes" / "s.json", {true}).warning(),
             Catch::Contains("has changed"));
  fs::remove(folder.path / "pictures" / "dot.png");
  CHECK_THAT(Document::open(folder.path / "scenes" / "s.json", {true}).warning(),
             Catch::Contains("/image/file"));
  CHECK_THROWS_WITH(load_scene(folder.path / "scenes" / "s.json", {false, {true}}),
                    Catch::Contains("/image/file"));
}

TEST_CASE("Neither saving nor exporting replaces a read-only file or a source of the scene") {
  const Folder folder;
  const Path kept = folder.path / "kept.json";
  write_file(kept, "mine");
  std::filesystem::permissions(kept, std::filesystem::perms::owner_read);
  Document document;
  CHECK_THROWS_WITH(document.save(kept), Catch::Contains("read-only"));
  CHECK_THROWS_WITH(check_may_write(kept, document.sources()), Catch::Contains("read-only"));
  CHECK(read_file(kept) == "mine");
  const Path free = folder.path / "free.json";
  check_may_write(free, document.sources());
  document.save(free);
  CHECK_THROWS_WITH(check_may_write(free, document.sources()), Catch::Contains("scene itself"));
}

TEST_CASE(
    "An autosave holds the last commit, remembers the file of its scene, and is found again") {
  const Folder folder;
  write_file(folder.path / "dot.png", encode_png(Image(8, 6)));
  Document document = Document::open(folder.path / "dot.png");
  const Path place = folder.path / "autosave";
  document.autosave(place);
  CHECK_FALSE(fs::exists(place));  // no unsaved changes yet
  document.commit("Cage", scene_with_cage(document.scene(), shapes::rectangle(8, 6)));
  document.autosave(place);
  CHECK(recoverable(place).empty());  // this program still owns it
  const Path orphan = place / "orphan.json";
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.path().extension() == ".json") fs::copy_file(entry.path(), orphan);
  REQUIRE(recoverable(place).size() == 1);
  CHECK_THAT(recoverable(place)[0].label, Catch::StartsWith("dot"));
  const Document recovered = Document::recover(orphan);
  CHECK(recovered.scene().deformation().rest == document.scene().deformation().rest);
  CHECK(recovered.modified());
  CHECK(recovered.path().empty());
  CHECK(recovered.image() != nullptr);
  discard(orphan);
  CHECK(recoverable(place).empty());
  // A recovered scene that has a file keeps it.
  document.save(folder.path / "kept.json");
  document.commit("Cage", scene_with_cage(document.scene(), shapes::rectangle(7, 5)));
  document.autosave(place);
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.path().extension() == ".json") fs::copy_file(entry.path(), orphan);
  const Document again = Document::recover(orphan);
  CHECK(again.path() == folder.path / "kept.json");
  CHECK(again.modified());
  CHECK(again.scene().extra.empty());
  CHECK_THAT(recoverable(place)[0].label, Catch::Contains("/kept.json, 4 cage points"));
  document.remove_autosave(place);
  write_file(folder.path / "file", "no folder");
  CHECK_FALSE(document.autosave(folder.path / "file"));
}

TEST_CASE("The autosave exists exactly while there are unsaved changes") {
  const Folder folder;
  write_file(folder.path / "dot.png", encode_png(Image(8, 6)));
  Document document = Document::open(folder.path / "dot.png");
  const Path place = folder.path / "autosave";
  const auto kept = [&] {
    document.autosave(place);
    int scenes = 0;
    if (fs::exists(place))
      for (const auto& entry : fs::directory_iterator(place))
        scenes += entry.path().extension() == ".json";
    return scenes;
  };
  document.commit("Cage", scene_with_cage(document.scene(), shapes::rectangle(8, 6)));
  CHECK(kept() == 1);
  document.remove_autosave(place);
  CHECK(kept() == 1);  // still modified: written again
  document.undo();
  CHECK(kept() == 0);
  document.redo();
  CHECK(kept() == 1);
  document.save(folder.path / "s.json");
  CHECK(kept() == 0);
}

TEST_CASE("History: undo and redo step through the scenes, and a commit discards undone steps") {
  Scene scene;
  History history(scene);
  for (int i = 1; i <= 3; ++i) {
    change(scene, [&](Deformation& d) { d.pins.push_back({{1.0 * i, 0}, {0, 0}, {}, {}}); });
    CHECK(history.commit("Pin", scene));
  }
  CHECK_FALSE(history.commit("Nothing", scene));
  CHECK(history.undo());
  CHECK(history.undo());
  CHECK(history.current().deformation().pins.size() == 1);
  CHECK(history.redo());
  CHECK(history.commit("Other", Scene{}));
  CHECK_FALSE(history.can_redo());
  CHECK(history.entries().size() == 4);
  history.go_to(0);
  CHECK_FALSE(history.undo());
}

TEST_CASE(
    "The live map follows the scene, keeps the last map on errors, and changes the pose without "
    "preparing again") {
  LiveMap map({600});
  Deformation deformation = with_cage(Deformation{}, shapes::l_shape());
  map.finish(deformation, {});
  REQUIRE(map.has_map());
  const unsigned first = map.preparation();
  deformation.pose.segments[2][0] += Complex(20, 10);
  CHECK(map.update(deformation, {true}));
  CHECK(map.preparation() == first);
  CHECK(map.map().fz.size() == map.map().f.size());
  const VectorXc posed = map.map().f;
  Deformation broken = deformation;
  broken.rest = broken.pose = polygon_cage(Points{{0, 0}, {10, 10}, {10, 0}, {0, 10}});
  map.finish(broken, {});
  REQUIRE(map.error());
  CHECK(map.error()->where());
  CHECK(map.map().f.size() == posed.size());
  CHECK(map.prepared()->mesh->vertices.size() == static_cast<size_t>(posed.size()));
  map.finish(deformation, {true});
  CHECK_FALSE(map.error());
  CHECK(map.map().f == posed);
  map.update(Deformation{}, {});
  CHECK_FALSE(map.has_map());
}

TEST_CASE("Mesh and map match, whatever the order of requests") {
  LiveMap map({400});
  Deformation deformation = with_cage(Deformation{}, shapes::l_shape());
  for (int i = 0; i < 60; ++i) {
    deformation.rest.segments[1][0] += Complex(0.5 * i, 0.1);
    deformation.pose.segments[0][0] += Complex(0.3, 0.2);
    if (i % 3 == 0) map.finish(deformation, {i % 2 == 1});
    map.update(deformation, {i % 2 == 1});
    if (map.has_map())
      CHECK(map.prepared()->mesh->vertices.size() == static_cast<size_t>(map.map().f.size()));
  }
}

TEST_CASE("The live map follows inserted and deleted points, pins and changes of the method") {
  LiveMap map({400});
  Deformation deformation = with_cage(Deformation{}, shapes::l_shape());
  deformation.method = "pins";
  std::mt19937 random(7);
  for (int i = 0; i < 40; ++i) {
    const auto pick = [&](Index count) { return static_cast<Index>(random() % count); };
    if (const int what = static_cast<int>(random() % 4); what == 0) {
      const Index segment = pick(deformation.rest.size());
      insert_vertex(deformation.rest, segment, 0.4);
      insert_vertex(deformation.pose, segment, 0.4);
    } else if (what == 1 && deformation.rest.size() > 8) {
      Deformation fewer = deformation;
      const Index vertex = pick(deformation.rest.size());
      erase_vertex(fewer.rest, vertex, 0.5);
      erase_vertex(fewer.pose, vertex, 0.5);
      if (!self_crossing(vertices_of(fewer.rest))) deformation = fewer;
    } else if (what == 2) {
      const Complex z(10 + 4.0 * i, 20 + i);
      deformation.pins.push_back({z, z + Complex(3, 2), {}, {}});
    } else if (!deformation.pins.empty()) {
      deformation.pins.erase(deformation.pins.begin() +
                             pick(static_cast<Index>(deformation.pins.size())));
      deformation.method = i % 2 ? "pins" : "cage";
    }
    if (i % 3 == 0)
      map.finish(deformation, {});
    else
      map.update(deformation, {});
    if (map.has_map())
      CHECK(map.prepared()->mesh->vertices.size() == static_cast<size_t>(map.map().f.size()));
  }
  map.finish(deformation, {true});
  const auto alone = prepared_map(deformation, Precision::single, {400});
  SampledMap expected = alone->deformer->deform(pose_of(deformation), {true});
  CHECK(map.map().f == expected.f);
  CHECK(map.map().fz == expected.fz);
}

TEST_CASE("CSV points: separators, headings, and errors in a line") {
  CHECK(points_of_csv("x,y\n1,2\n\n3 ; 4\r\n", "p").size() == 2);
  CHECK(points_of_csv("1\t2\n# comment\n", "p")[0] == Complex(1, 2));
  // As spreadsheets write them: no first row is lost as a heading.
  const Points two{{1.5, 2}, {3, -4.25}};
  for (const std::string text :
       {"1.5,2\n3,-4.25",
        "\xef\xbb\xbf"
        "1.5,2\r\n3,-4.25\r\n",
        "\"1.5\",\"2\"\n\"3\",\"-4.25\"\n", "1,5;2\r\n3;-4,25\r\n", "1,5\t2\n3\t-4,25\n",
        "\"x\";\"y\"\n\"1,5\";2\n3;\"-4,25\"", "1.5,2\r3,-4.25\r",
        "# from a table\nx (px), y (px)\n1.5, 2\n3, -4.25\n", "1.5 2\n3  -4.25"}) {
    INFO(text);
    CHECK(points_of_csv(text, "p") == two);
    std::string wide = "\xff\xfe";  // UTF-16, if the text has no mark of its own
    for (const char c : text) wide += {c, '\0'};
    if (text[0] != '\xef') CHECK(points_of_csv(wide, "p") == two);
  }
  for (const char* text : {"x,1\n2,3\n", "1,234.5;2\n", "1,2;3\n4,5,6\n", "1.2.3,4\n", "1,2\nx,y\n",
                           "1,,2\n", "\"1,2\n", "1;2;\n"})
    CHECK_THROWS_WITH(points_of_csv(text, "p"), Catch::Contains("line"));
  CHECK_THROWS_WITH(points_of_csv("1,2\n3\n", "p.csv"), Catch::Contains("p.csv: line 2"));
  CHECK_THROWS_AS(points_of_csv("1,2\nnan,4\n", "p"), Error);
  CHECK_THROWS_AS(points_of_csv("nan,4\n", "p"), Error);
  CHECK_THROWS_AS(points_of_csv("1,2,3\n", "p"), Error);
  CHECK_THROWS_AS(points_of_csv("1,2\n3,4,5\n", "p"), Error);
}

TEST_CASE("Files that are not pictures are rejected") {
  CHECK_THROWS_AS(decode_image("", "x"), Error);
  CHECK_THROWS_AS(decode_image("not a picture", "x"), Error);
  const std::string png = encode_png(Image(20, 20));
  CHECK_THROWS_AS(decode_image(png.substr(0, png.size() / 2), "x"), Error);
  CHECK(decode_image(png, "x") == Image(20, 20));
}

TEST_CASE("A scene can read its own folder, the allowed folders, and nothing else") {
  const Folder folder;
  const Path home = folder.path / "scenes", away = folder.path / "away";
  fs::create_directories(home / "deep");
  fs::create_directories(away);
  const std::string png = encode_png(Image(8, 6));
  for (const Path& file : {home / "a.png", home / "deep" / "a.png", away / "b.png"})
    write_file(file, png);
  fs::create_symlink(away / "b.png", home / "link.png");
  fs::create_symlink(away, home / "door");
  fs::create_symlink(home / "a.png", home / "near.png");
  const auto names = [&](const std::string& file) {
    write_file(home / "s.json", R"({"format":"holomorph","version":1,"image":{"file":")" + file +
                                    R"("},"cage":{"rest":[]}})");
  };
  for (const std::string& inside :
       {std::string("a.png"), std::string("deep/../deep/a.png"), std::string("near.png"),
        (home / "a.png").string(), std::string("../scenes/a.png")}) {
    CAPTURE(inside);
    names(inside);
    CHECK(load_scene(home / "s.json").image());
    CHECK(Document::open(home / "s.json").withheld().empty());
  }
  for (const std::string& outside :
       {std::string("../away/b.png"), (away / "b.png").string(), std::string("link.png"),
        std::string("door/b.png"), std::string("../away/none.png"), std::string("/dev/zero"),
        std::string("/etc/shadow/x")}) {
    CAPTURE(outside);
    names(outside);
    // The message does not depend on whether the file exists.
    const std::string said = error_message_of([&] { load_scene(home / "s.json"); });
    CHECK_THAT(said, Catch::Contains("--allow-outside") && Catch::Contains("/image/file"));
    const Document document = Document::open(home / "s.json");
    CHECK(document.withheld().size() == 1);
    CHECK_FALSE(document.image());
    CHECK(document.layers_without_picture().size() == 1);
  }
  names("../away/b.png");
  CHECK(Document::open(home / "s.json", {true}).image());
  CHECK(Document::open(home / "s.json", {false, {away}}).image());
  names("link.png");
  CHECK(Document::open(home / "s.json", {false, {fs::canonical(away)}}).image());
  fs::create_directories(away / "deep");
  write_file(away / "deep" / "c.png", png);
  names("../away/deep/c.png");
  CHECK_FALSE(Document::open(home / "s.json", {false, {away}}).image());
  // A link is judged by its target, even in allowed folders and even if the target does not exist.
  fs::create_symlink(folder.path / "elsewhere.png", away / "link.png");
  fs::create_symlink(folder.path / "nowhere.png", home / "dangling.png");
  write_file(folder.path / "elsewhere.png", png);
  for (const char* link : {"../away/link.png", "dangling.png"}) {
    names(link);
    CHECK(Document::open(home / "s.json", {false, {away, home}}).withheld().size() == 1);
  }
  // A picture that also lies next to the scene is taken from there.
  Document saved = Document::open(away / "b.png");
  saved.commit("Cage", scene_with_cage(saved.scene(), shapes::rectangle(8, 6)));
  saved.save(home / "s.json");
  write_file(home / "b.png", png);
  const LoadedScene beside = load_scene(home / "s.json");
  CHECK(beside.scene.layer().image->file == home / "b.png");
}

TEST_CASE("A change of the scene file by another program is detected") {
  const Folder folder;
  const Path path = folder.path / "s.json";
  write_file(folder.path / "dot.png", encode_png(Image(20, 20)));
  Document document = Document::open(folder.path / "dot.png");
  document.commit("Cage", scene_with_cage(document.scene(), shapes::rectangle(20, 20)));
  CHECK_FALSE(document.changed_on_disk());
  document.save(path);
  CHECK_FALSE(document.changed_on_disk());
  Document second = Document::open(path);
  Scene moved = second.scene();
  change(moved, [](Deformation& d) { d.pose.segments[0][0] += 1; });
  second.commit("Move", moved);
  second.save(path);
  CHECK(document.changed_on_disk());
  CHECK_FALSE(second.changed_on_disk());
  document.save(path);
  CHECK_FALSE(document.changed_on_disk());
  CHECK(second.changed_on_disk());
  // A file that was touched, or written again with the same content, has not changed.
  Document third = Document::open(path);
  write_file(path, read_file(path));
  fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(5));
  CHECK_FALSE(third.changed_on_disk());
  // A recovered document knows the earlier content of its scene's file.
  third.commit("Move", moved);
  change(moved, [](Deformation& d) { d.pose.segments[1][0] += 1; });
  third.commit("Move", moved);
  REQUIRE(third.autosave(folder.path / "autosave"));
  Path autosave;
  for (const auto& entry : fs::directory_iterator(folder.path / "autosave"))
    if (entry.path().extension() == ".json") autosave = entry.path();
  Document recovered = Document::recover(autosave);
  CHECK(recovered.path() == path);
  CHECK_FALSE(recovered.changed_on_disk());
  second.save(path);
  write_file(path, read_file(path) + " ");
  CHECK(recovered.changed_on_disk());
  CHECK(recovered.scene().extra.empty());
  // An untrusted scene cannot state where it was saved.
  Scene stranger = second.scene();
  stranger.extra = R"({"autosave_of":"/home/you/precious.json","autosave_of_sha256":"x","y":1})";
  write_file(path, json_of(portable(stranger, folder.path)));
  CHECK(load_scene(path).scene.extra == R"({"y":1})");
  fs::remove(path);
  CHECK_FALSE(third.changed_on_disk());
}

TEST_CASE("A write removes what a killed write left behind, and nothing that is in use") {
  const Folder folder;
  const auto leftovers = [&] {
    const std::vector<std::string> names = folder.names();
    return std::ranges::count_if(names, [](const std::string& name) { return name[0] == '.'; });
  };
  for (int kill = 0; kill < 3; ++kill) {
    const pid_t child = ::fork();
    if (child == 0) {
      auto* file = new NewFile(folder.path / "a.json");  // never put in place
      file->write("half");
      if (kill == 2) new NewFolder(folder.path / "b.png");
      ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
  }
  CHECK(leftovers() == 2);  // from the last kill; each write removed the previous leftovers
  fs::create_symlink(folder.path / "precious", folder.path / ".holomorph-00000000");
  write_file(folder.path / "precious", "x");  // removes the leftovers
  CHECK(leftovers() == 1);                    // a planted link is neither followed nor removed
  // Folders with similar names or with other content are kept.
  fs::create_directories(folder.path / ".holomorph-settings");
  fs::create_directories(folder.path / ".holomorph-0badcafe" / "mine");
  fs::permissions(folder.path / ".holomorph-0badcafe", fs::perms::owner_all);
  CHECK(read_file(folder.path / "precious") == "x");
  {
    NewFile busy(folder.path / "b.json");
    const NewFolder full(folder.path / "c.png");
    busy.write("b");
    const pid_t child = ::fork();
    if (child == 0) {  // another program, which has not cleaned up this folder yet
      ::setenv("HOLOMORPH_TEST_FOLDER", folder.path.c_str(), 1);
      ::execl("/proc/self/exe", "test_scene", "[cleaner]", nullptr);
      ::_exit(1);
    }
    ::waitpid(child, nullptr, 0);
    CHECK(read_file(folder.path / "written.json") == "x");
    CHECK(leftovers() == 5);
    busy.put_in_place();
  }
  CHECK(leftovers() == 3);
  CHECK(read_file(folder.path / "b.json") == "b");
}

TEST_CASE("Names of 255 bytes are written, and longer ones are an error") {
  const Folder folder;
  const Path longest = folder.path / std::string(255, 'n');
  write_file(longest, "x");
  write_file(longest, "y");
  CHECK(read_file(longest) == "y");
  CHECK_THROWS_WITH(write_file(folder.path / std::string(256, 'n'), "x"),
                    Catch::Contains("too long"));
  CHECK_THROWS_WITH(read_file(folder.path / std::string(256, 'n')), Catch::Contains("too long"));
  fs::create_symlink("nowhere", folder.path / "dangling");
  CHECK_THROWS_WITH(read_file(folder.path / "dangling"), Catch::Contains("link to nowhere"));
  fs::create_symlink("round", folder.path / "round");
  CHECK_THROWS_WITH(read_file(folder.path / "round"), Catch::Contains("leads back to itself"));
}

TEST_CASE("Autosaves can be read only by their owner") {
  const Folder folder;
  Document document;
  document.commit("Cage", scene_of(with_cage({}, shapes::rectangle(20, 20))));
  const Path autosave = folder.path / "state" / "autosave";
  fs::create_directories(autosave);
  fs::permissions(autosave, fs::perms::all);
  CHECK(document.autosave(autosave));
  CHECK((fs::status(autosave).permissions() & fs::perms::mask) == fs::perms::owner_all);
  for (const auto& entry : fs::directory_iterator(autosave))
    CHECK((entry.status().permissions() & fs::perms::all) ==
          (fs::perms::owner_read | fs::perms::owner_write));
  Document homeless;
  homeless.commit("Cage", scene_of(with_cage({}, shapes::rectangle(20, 20))));
  CHECK_FALSE(homeless.autosave(""));
}

TEST_CASE("Any text gives valid preferences") {
  for (const char* text :
       {"", "[]", "3", "{", R"({"recent":[""]})", R"({"recent":["relative",5]})",
        R"({"recent":7,"keys":[1],"theme":{},"ui_scale":"x","hints":0})",
        R"({"keys":{"file.open":5}})", R"({"ui_scale":1e308})", R"({"ui_scale":-1})"}) {
    CAPTURE(text);
    const Preferences preferences = preferences_of_json(text);
    CHECK(preferences.recent.empty());
    CHECK((preferences.ui_scale == 0 || preferences.ui_scale == 4));
  }
  // Valid entries next to invalid ones are kept.
  const Preferences some = preferences_of_json(
      R"({"theme":"light","hints":"yes","recent":["/a","","/a","/b\u0000c","/d"],"keys":{"x":["F3"]}})");
  CHECK(some.theme == Theme::light);
  CHECK(some.hints);
  CHECK(some.recent == std::vector<Path>{"/a", "/d"});
  CHECK(some.keys.at("x") == std::vector<std::string>{"F3"});
}

TEST_CASE("JSON is read in linear time and little memory, and unknown keys are kept exactly") {
  const auto seconds = [](const std::string& text) {
    const auto start = std::chrono::steady_clock::now();
    const Scene scene = scene_from_json(text, "s.json");
    CHECK(scene_from_json(json_of(scene), "again") == scene);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const auto with_keys = [](int count) {
    std::string text = R"({"format":"holomorph","version":1,"cage":{"rest":[]})";
    for (int i = 0; i < count; ++i) text += ",\"k" + std::to_string(i) + "\":0";
    return text + "}";
  };
  // In linear time, ten times as many keys take about ten times as long. In quadratic time, they
  // take 100 times as long.
  const double few = seconds(with_keys(10000)), many = seconds(with_keys(100000));
  CHECK(many < 40 * std::max(few, 0.01));
  const Scene odd = scene_from_json(
      R"({"format":"holomorph","version":1,"cage":{"rest":[]},"a":1,"n":18446744073709551615,
          "m":-9223372036854775808,"f":0.1,"g":1e300,"s":"\u00e9\"\\\n","a":{"b":[[],{},null,true]}})",
      "s.json");
  CHECK(odd.extra ==
        "{\"a\":{\"b\":[[],{},null,true]},\"n\":18446744073709551615,"
        "\"m\":-9223372036854775808,\"f\":0.1,\"g\":1e+300,\"s\":\"\u00e9\\\"\\\\\\n\"}");
}

TEST_CASE("Texts from files cannot control a terminal") {
  CHECK(printable("a\x1b[31mb\x07\tc\nd\x7f") == "a?[31mb??c\nd?");
  CHECK(printable("x\u202ey\u2066z\u0085") == "x?y?z?");
  CHECK(printable("\u00e9\u20ac\u4e2d") == "\u00e9\u20ac\u4e2d");
}

TEST_CASE("Another program writes here", "[.][cleaner]") {
  if (const char* folder = std::getenv("HOLOMORPH_TEST_FOLDER"))
    write_file(Path(folder) / "written.json", "x");
}

TEST_CASE("Samples of an earlier release keep their methods, parameters and handles") {
  for (const std::string name : {"gecko", "giraffe", "octopus"}) {
    const std::string text = read_file(HOLOMORPH_SOURCE "/tests/data/scenes/" + name + ".json");
    const auto before = nlohmann::json::parse(text);
    const Scene scene = scene_from_json(text, name);
    INFO(name);
    CHECK(scene.deformation().method == before["method"]["id"].get<std::string>());
    CHECK(scene.deformation().method != "puppet");
    const auto after = nlohmann::json::parse(json_of(scene));
    CHECK(after["method"] == before["method"]);
    CHECK(after["cage"] == before["cage"]);
    const auto none = nlohmann::json::array();
    CHECK(after.value("pins", none) == before.value("pins", none));
  }
}

TEST_CASE("The schema names all parameters of all methods, with their ranges") {
  const auto schema =
      nlohmann::ordered_json::parse(read_file(HOLOMORPH_SOURCE "/schema/scene.schema.json"));
  const std::string text = schema.dump();
  for (const Method& method : methods()) {
    // The part of the schema that is about this method.
    const size_t at = text.find("\"const\":\"" + method.id + "\"");
    if (at == std::string::npos) continue;  // it has no parameters, or shares a part
    const std::string part = text.substr(at, text.find("additionalProperties", at) - at);
    for (const ParameterSpec& spec : method.parameters) {
      CAPTURE(method.id, spec.key);
      CHECK(part.find("\"" + spec.key + "\":") != std::string::npos);
    }
  }
}

}  // namespace holomorph::scene_test
