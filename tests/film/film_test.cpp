// Films that are not finished leave nothing, and what was there stays.
#include "film/film.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "scene/keyframes.h"
#include "support/folder.h"

using namespace holomorph;

namespace {

/// Two keys, half a second apart: 13 frames.
Scene film_scene() {
  Scene scene = with_cage(Scene{}, Points{{5, 5}, {35, 5}, {35, 25}, {5, 25}});
  scene = with_key(scene, 0);
  for (Points& segment : scene.pose.segments) segment[0] += 8.0;
  return with_key(scene, 0.5);
}

Image grey() {
  Image image(40, 30);
  for (std::uint8_t& value : image.pixels) value = 200;
  return image;
}

}  // namespace

TEST_CASE("A film that is cancelled leaves nothing, and what was there stays") {
  const Image image = grey();
  for (const char* kind : {".webp", ".gif", ".apng", ".png"}) {
    INFO(kind);
    const Folder folder;
    const Path out = folder.path / ("film" + std::string(kind));
    const Path before = files_of_film(out, 1)[0];
    write_file(before, "what was there");
    // While the rectangle is measured (0), at the first frame (13 are asked about before), and
    // behind the last one.
    for (const int calls : {0, 5, 13, 20, 26}) {
      int left = calls;
      const bool there = write_film(out, film_scene(), &image, {}, [&](int done, int all) {
        CHECK(all == 13);
        CHECK(done <= all);
        return left-- > 0;
      });
      INFO("cancelled after " << calls);
      CHECK_FALSE(there);
      CHECK(folder.names() == std::vector<std::string>{before.filename().string()});
      CHECK(read_file(before) == "what was there");
    }
    CHECK(write_film(out, film_scene(), &image, {}, [](int, int) { return true; }));
    CHECK(folder.names().size() == files_of_film(out, 13).size());
    CHECK(read_file(before) != "what was there");
  }
}

TEST_CASE("A folder in the place of a frame is said before any frame is replaced") {
  const Folder folder;
  const Image image = grey();
  const Path out = folder.path / "film.png";
  write_file(numbered(out, 0), "what was there");
  std::filesystem::create_directory(numbered(out, 7));
  CHECK_THROWS_AS(write_film(out, film_scene(), &image, {}, [](int, int) { return true; }), Error);
  CHECK(read_file(numbered(out, 0)) == "what was there");
  CHECK(folder.names().size() == 2);
  Scene fast = film_scene();
  fast.animation.frames_per_second = 60;
  CHECK_THROWS_WITH(
      write_film(folder.path / "fast.gif", fast, &image, {}, [](int, int) { return true; }),
      Catch::Contains("50 frames a second"));
}

TEST_CASE("A film on its own thread tells how far it is, and ends when it is cancelled") {
  const Folder folder;
  const Path out = folder.path / "film.apng";
  const auto image = std::make_shared<const Image>(grey());
  {
    FilmJob job(out, film_scene(), image, {});
    while (!job.ended()) std::this_thread::yield();
    CHECK(job.written());
    CHECK(job.done() == 13);
    CHECK_FALSE(job.error());
  }
  std::filesystem::remove(out);
  {
    FilmJob job(folder.path / "none" / "film.apng", film_scene(), image, {});
    while (!job.ended()) std::this_thread::yield();
    REQUIRE(job.error());
    CHECK_FALSE(job.written());
  }
  { FilmJob cancelled(out, film_scene(), image, {}); }
  if (std::filesystem::exists(out)) {  // it was ready before: then whole
    const std::string bytes = read_file(out);
    CHECK(bytes.substr(bytes.size() - 8, 4) == "IEND");
  }
  Scene still = film_scene();
  still.keyframes.clear();
  CHECK_THROWS_AS(write_film(out, still, image.get(), {}, [](int, int) { return true; }), Error);
}
