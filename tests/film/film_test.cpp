// Films that are not finished leave nothing, and what was there stays.
#include "film/film.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "scene/job.h"
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
      const auto there = write_film(out, film_scene(), &image, {}, [&](int done, int all) {
        CHECK(all == 13);
        CHECK(done <= all);
        return left-- > 0;
      });
      INFO("cancelled after " << calls);
      CHECK_FALSE(there.has_value());
      CHECK(folder.names() == std::vector<std::string>{before.filename().string()});
      CHECK(read_file(before) == "what was there");
    }
    CHECK(write_film(out, film_scene(), &image, {}, [](int, int) { return true; }).has_value());
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
  const Image image = grey();
  const auto film_into = [&](const Path& path) {
    return [&image, path](Job::Progress& progress) {
      write_film(path, film_scene(), &image, {},
                 [&](int done, int all) { return progress.at(done, all); });
    };
  };
  {
    std::atomic<bool> woken = false;
    Job job("Film", film_into(out), [&] { woken = true; });
    while (!job.ended()) std::this_thread::yield();
    CHECK(std::filesystem::exists(out));
    CHECK(job.done() == 13);
    CHECK(job.all() == 13);
    CHECK_FALSE(job.error());
    while (!woken) std::this_thread::yield();
  }
  std::filesystem::remove(out);
  {
    Job job("Film", film_into(folder.path / "none" / "film.apng"));
    CHECK(job.ends_within(60000));
    REQUIRE(job.error());
  }
  { Job cancelled("Film", film_into(out)); }
  if (std::filesystem::exists(out)) {  // it was ready before: then whole
    const std::string bytes = read_file(out);
    CHECK(bytes.substr(bytes.size() - 8, 4) == "IEND");
  }
  Scene still = film_scene();
  still.keyframes.clear();
  CHECK_THROWS_AS(write_film(out, still, &image, {}, [](int, int) { return true; }), Error);
}

TEST_CASE("A part of the frames is that part of the film") {
  const Folder folder;
  const Image image = grey();
  const auto go_on = [](int, int) { return true; };
  FilmOptions options;
  write_film(folder.path / "all.png", film_scene(), &image, options, go_on);
  options.first = 4;
  options.last = 6;
  options.picture.shows = PictureMaker(film_scene(), &image).rectangle();
  write_film(folder.path / "part.png", film_scene(), &image, options, go_on);
  CHECK(folder.names().size() == 13 + 3);
  PictureOptions still;
  still.shows = options.picture.shows;
  still.time = 5 / film_scene().animation.frames_per_second;
  CHECK(read_file(numbered(folder.path / "part.png", 1)) ==
        encode_png(picture_of(film_scene(), &image, still).image));
  options.last = 13;
  CHECK_THROWS_WITH(write_film(folder.path / "no.png", film_scene(), &image, options, go_on),
                    Catch::Contains("0 to 12"));
}
