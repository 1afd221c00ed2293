// Scenes as files: nothing is lost, everything wrong is named.
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "core/error.h"
#include "scene/document.h"
#include "scene/export.h"
#include "scene/live_map.h"
#include "scene/scene_json.h"
#include "support/complaint.h"
#include "support/folder.h"
#include "support/shapes.h"

using namespace holomorph;
namespace fs = std::filesystem;

namespace {

/// A folder that goes away with the test.
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
  return complaint_of([&] { scene_from_json(text, "scene.json"); });
}

}  // namespace

TEST_CASE("A scene survives writing and reading, unknown keys included") {
  const Scene scene = scene_from_json(kText, "scene.json");
  CHECK(scene.pose.degree(1) == 3);
  CHECK(scene.pins[0].angle == 0.5);
  CHECK(scene.pins[1].pose == scene.pins[1].rest);
  const std::string written = json_of(scene);
  CHECK(scene_from_json(written, "again") == scene);
  CHECK(json_of(scene_from_json(written, "again")) == written);
  for (const char* kept :
       {"\"author\"", "\"strokes\"", "\"colour\"", "\"later\"", "\"note\"", "210.1234567890123"})
    CHECK_THAT(written, Catch::Contains(kept));
}

TEST_CASE("What is wrong with a scene is said with the file, the pointer and the reason") {
  using Catch::Contains;
  CHECK_THAT(complaint("{"),
             Contains("scene.json") && Contains("damaged or ends too early, at line"));
  CHECK_THAT(complaint("[]"), Contains("an object is wanted"));
  CHECK_THAT(complaint("{}"), Contains("not a Holomorph scene"));
  CHECK_THAT(complaint(replaced(kText, "\"version\": 1", "\"version\": 3")),
             Contains("/version") && Contains("newer"));
  CHECK_THAT(complaint(replaced(kText, "[50,60]", "[50]")), Contains("/pins/0/rest"));
  CHECK_THAT(complaint(replaced(kText, "[50,60]", "[50,\"60\"]")),
             Contains("/pins/0/rest/1") && Contains("a string"));
  CHECK_THAT(complaint(replaced(kText, "[50,60]", "[50,1e999]")), Contains("scene.json"));
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
  unspeakable.image = ImageReference{"caf\xe9.png", "", 0, 0, "", ""};
  CHECK_THROWS_AS(json_of(unspeakable), Error);
  std::string many = R"({"format":"holomorph","version":1,"cage":{"rest":[)";
  for (int i = 0; i < 6000; ++i) many += "[[0,0]],";
  CHECK_THAT(complaint(many + "[[1,1]]]}}"), Contains("more than 5000"));
}

TEST_CASE("Writing replaces a file whole, or leaves it") {
  const Folder folder;
  const Path path = folder.path / "a.json";
  write_file(path, "one");
  write_file(path, "two");
  CHECK(read_file(path) == "two");
  CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 1);  // nothing is left beside it
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

TEST_CASE("A write that is cut off in the middle leaves the old file and nothing beside it") {
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

TEST_CASE("A lock is held while its program runs, and never after it") {
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

TEST_CASE("SHA-256 of the empty text is the published one") {
  CHECK(sha256_hex("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_CASE("A document saves a picture's path relative to the scene, wherever that goes") {
  const Folder folder;
  fs::create_directories(folder.path / "pictures");
  write_file(folder.path / "pictures" / "dot.png", encode_png(Image(8, 6)));
  Document document = Document::open(folder.path / "pictures" / "dot.png");
  CHECK_FALSE(document.modified());
  CHECK(document.scene().image->width == 8);
  document.commit("Cage", with_cage(document.scene(), shapes::rectangle(8, 6)));
  CHECK(document.modified());
  fs::create_directories(folder.path / "scenes");
  document.save(folder.path / "scenes" / "s.json");
  CHECK_FALSE(document.modified());
  const Document again = Document::open(folder.path / "scenes" / "s.json");
  CHECK(read_file(folder.path / "scenes" / "s.json").find("\"../pictures/dot.png\"") !=
        std::string::npos);
  CHECK(again.image_path() == folder.path / "pictures" / "dot.png");
  CHECK(again.image() != nullptr);
  CHECK(again.warning().empty());
  Image other(8, 6);
  other.pixels[3] = 200;
  write_file(folder.path / "pictures" / "dot.png", encode_png(other));
  CHECK_THAT(Document::open(folder.path / "scenes" / "s.json").warning(),
             Catch::Contains("has changed"));
  fs::remove(folder.path / "pictures" / "dot.png");
  CHECK_THAT(Document::open(folder.path / "scenes" / "s.json").warning(),
             Catch::Contains("/image/file"));
  CHECK_THROWS_WITH(load_scene(folder.path / "scenes" / "s.json"), Catch::Contains("/image/file"));
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

TEST_CASE("An autosave holds the last commit, moves with its scene, and is found again") {
  const Folder folder;
  write_file(folder.path / "dot.png", encode_png(Image(8, 6)));
  Document document = Document::open(folder.path / "dot.png");
  const Path place = folder.path / "autosave";
  document.autosave(place);
  CHECK_FALSE(fs::exists(place));  // nothing to lose yet
  document.commit("Cage", with_cage(document.scene(), shapes::rectangle(8, 6)));
  document.autosave(place);
  CHECK(recoverable(place).empty());  // this program still owns it
  const Path orphan = place / "orphan.json";
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.path().extension() == ".json") fs::copy_file(entry.path(), orphan);
  REQUIRE(recoverable(place).size() == 1);
  CHECK_THAT(recoverable(place)[0].label, Catch::StartsWith("dot"));
  const Document recovered = Document::recover(orphan);
  CHECK(recovered.scene().rest == document.scene().rest);
  CHECK(recovered.modified());
  CHECK(recovered.path().empty());
  CHECK(recovered.image() != nullptr);
  discard(orphan);
  CHECK(recoverable(place).empty());
  // A scene that has a file goes back to it.
  document.save(folder.path / "kept.json");
  document.commit("Cage", with_cage(document.scene(), shapes::rectangle(7, 5)));
  document.autosave(place);
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.path().extension() == ".json") fs::copy_file(entry.path(), orphan);
  const Document again = Document::recover(orphan);
  CHECK(again.path() == folder.path / "kept.json");
  CHECK(again.modified());
  CHECK(again.scene().extra.empty());
  CHECK_THAT(recoverable(place)[0].label, Catch::StartsWith("kept.json, 4 cage points"));
  document.remove_autosave(place);
  write_file(folder.path / "file", "no folder");
  CHECK_FALSE(document.autosave(folder.path / "file"));
}

TEST_CASE("The autosave is there exactly while there is something to lose") {
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
  document.commit("Cage", with_cage(document.scene(), shapes::rectangle(8, 6)));
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

TEST_CASE("History: undo and redo walk the line, a commit forgets what was undone") {
  Scene scene;
  History history(scene);
  for (int i = 1; i <= 3; ++i) {
    scene.pins.push_back({{1.0 * i, 0}, {0, 0}, {}, {}});
    CHECK(history.commit("Pin", scene));
  }
  CHECK_FALSE(history.commit("Nothing", scene));
  CHECK(history.undo());
  CHECK(history.undo());
  CHECK(history.current().pins.size() == 1);
  CHECK(history.redo());
  CHECK(history.commit("Other", Scene{}));
  CHECK_FALSE(history.can_redo());
  CHECK(history.entries().size() == 4);
  history.go_to(0);
  CHECK_FALSE(history.undo());
}

TEST_CASE(
    "The live map follows the scene, keeps the last map on errors, and poses without preparing") {
  LiveMap map({600});
  Scene scene = with_cage(Scene{}, shapes::l_shape());
  map.finish(scene, {});
  REQUIRE(map.has_map());
  const unsigned first = map.preparation();
  scene.pose.segments[2][0] += Complex(20, 10);
  CHECK(map.update(scene, {true}));
  CHECK(map.preparation() == first);
  CHECK(map.map().fz.size() == map.map().f.size());
  const VectorXc posed = map.map().f;
  Scene broken = scene;
  broken.rest = broken.pose = polygon_cage(Points{{0, 0}, {10, 10}, {10, 0}, {0, 10}});
  map.finish(broken, {});
  REQUIRE(map.error());
  CHECK(map.error()->where());
  CHECK(map.map().f.size() == posed.size());
  CHECK(map.prepared()->mesh->vertices.size() == static_cast<size_t>(posed.size()));
  map.finish(scene, {true});
  CHECK_FALSE(map.error());
  CHECK(map.map().f == posed);
  map.update(Scene{}, {});
  CHECK_FALSE(map.has_map());
}

TEST_CASE("Mesh and map belong together whatever is asked in whatever order") {
  LiveMap map({400});
  Scene scene = with_cage(Scene{}, shapes::l_shape());
  for (int i = 0; i < 60; ++i) {
    scene.rest.segments[1][0] += Complex(0.5 * i, 0.1);
    scene.pose.segments[0][0] += Complex(0.3, 0.2);
    if (i % 3 == 0) map.finish(scene, {i % 2 == 1});
    map.update(scene, {i % 2 == 1});
    if (map.has_map())
      CHECK(map.prepared()->mesh->vertices.size() == static_cast<size_t>(map.map().f.size()));
  }
}

TEST_CASE("The live map follows inserted and deleted points, pins and methods") {
  LiveMap map({400});
  Scene scene = with_cage(Scene{}, shapes::l_shape());
  scene.method = "pins";
  std::mt19937 random(7);
  for (int i = 0; i < 40; ++i) {
    const auto pick = [&](Index count) { return static_cast<Index>(random() % count); };
    if (const int what = static_cast<int>(random() % 4); what == 0) {
      const Index segment = pick(scene.rest.size());
      insert_vertex(scene.rest, segment, 0.4);
      insert_vertex(scene.pose, segment, 0.4);
    } else if (what == 1 && scene.rest.size() > 8) {
      Scene fewer = scene;
      const Index vertex = pick(scene.rest.size());
      erase_vertex(fewer.rest, vertex, 0.5);
      erase_vertex(fewer.pose, vertex, 0.5);
      if (!self_crossing(vertices_of(fewer.rest))) scene = fewer;
    } else if (what == 2) {
      const Complex z(10 + 4.0 * i, 20 + i);
      scene.pins.push_back({z, z + Complex(3, 2), {}, {}});
    } else if (!scene.pins.empty()) {
      scene.pins.erase(scene.pins.begin() + pick(static_cast<Index>(scene.pins.size())));
      scene.method = i % 2 ? "pins" : "cage";
    }
    if (i % 3 == 0)
      map.finish(scene, {});
    else
      map.update(scene, {});
    if (map.has_map())
      CHECK(map.prepared()->mesh->vertices.size() == static_cast<size_t>(map.map().f.size()));
  }
  map.finish(scene, {true});
  const auto alone = prepared_map(scene, Precision::single, {400});
  SampledMap expected;
  alone->deformer->deform(pose_of(scene), expected, {true});
  CHECK(map.map().f == expected.f);
  CHECK(map.map().fz == expected.fz);
}

TEST_CASE("CSV points: separators, headings, and what is wrong with a line") {
  CHECK(points_of_csv("x,y\n1,2\n\n3 ; 4\r\n", "p").size() == 2);
  CHECK(points_of_csv("1\t2\n# comment\n", "p")[0] == Complex(1, 2));
  CHECK_THROWS_WITH(points_of_csv("1,2\n3\n", "p.csv"), Catch::Contains("p.csv: line 2"));
  CHECK_THROWS_AS(points_of_csv("1,2\nnan,4\n", "p"), Error);
  CHECK_THROWS_AS(points_of_csv("nan,4\n", "p"), Error);
  CHECK_THROWS_AS(points_of_csv("1,2,3\n", "p"), Error);
  CHECK_THROWS_AS(points_of_csv("1,2\n3,4,5\n", "p"), Error);
}

TEST_CASE("Pictures that are none are refused") {
  CHECK_THROWS_AS(decode_image("", "x"), Error);
  CHECK_THROWS_AS(decode_image("not a picture", "x"), Error);
  const std::string png = encode_png(Image(20, 20));
  CHECK_THROWS_AS(decode_image(png.substr(0, png.size() / 2), "x"), Error);
  CHECK(decode_image(png, "x") == Image(20, 20));
}
