// Films: an unfinished film leaves no file behind, and existing files are kept until a film is
// finished.
#include "film/film.h"

#include "core/error.h"
#include "scene/keyframes.h"
#include "scene/layers.h"
#include "scene/motion.h"
#include "scene/prepared_map.h"
#include "support/catch.h"
#include "support/folder.h"
#include "support/scenes.h"
#include "support/seeds.h"
#include "system/job.h"
#include "system/new_file.h"

namespace holomorph::film_test {

namespace {

/// Two keyframes, half a second apart: 13 frames.
Scene film_scene() {
  Deformation deformation = with_cage({}, Points{{5, 5}, {35, 5}, {35, 25}, {5, 25}});
  deformation = with_key(deformation, 0);
  for (Points& segment : deformation.pose.segments) segment[0] += 8.0;
  return scene_of(with_key(deformation, 0.5));
}

Image gray() {
  Image image(40, 30);
  for (std::uint8_t& value : image.pixels) value = 200;
  return image;
}

void check_rectangles(const std::vector<unsigned>& seeds) {
  const Image image = gray();
  for (const unsigned seed : seeds) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
      return std::uniform_real_distribution(low, high)(random);
    };
    Deformation deformation = with_cage(Deformation{}, Points{{5, 5}, {35, 5}, {35, 25}, {5, 25}});
    const Cage rest = deformation.rest;
    for (int key = 0; key < 4; ++key) {
      const double scale = number(0.5, 3), angle = number(-3, 3);
      const Complex turn = std::polar(scale, angle), by = 200.0 * random_complex(random);
      for (size_t i = 0; i < rest.segments.size(); ++i)
        deformation.pose.segments[i][0] =
            turn * rest.segments[i][0] + by + 5.0 * random_complex(random);
      deformation =
          with_key(deformation,
                   key == 0 ? number(0, 1) : deformation.keyframes.back().time + number(0.1, 3));
      deformation.keyframes.back().ease = static_cast<Ease>(random() % 3);
      if (key > 0) deformation.keyframes.back().turns = static_cast<int>(random() % 5) - 2;
    }
    deformation.pose = rest;
    std::optional<Box> box;
    int asked = 0;
    for (const double rate : {1.0, 240.0}) {
      Scene scene = scene_of(deformation);
      scene.animation.frames_per_second = rate;
      const int before = asked;
      const auto found = PictureMaker(scene, &image).motion_region([&] { return ++asked > 0; });
      REQUIRE(found.has_value());
      CHECK(asked - before < 4000);
      if (box) {
        CHECK(found->left == box->left);
        CHECK(found->top == box->top);
      }
      box = found;
    }
    const std::shared_ptr<PreparedMap> prepared = prepared_map(deformation, Precision::single, {});
    Motion motion;
    motion.follow(deformation, false, prepared);
    Box exact;
    exact.include(0);
    exact.include({40, 30});
    // The same number between any two keys, because the picture may turn twice in a tenth of a
    // second.
    const int maps = few_or_many(300, 1000);
    const std::vector<Keyframe>& keys = deformation.keyframes;
    for (size_t k = 0; k + 1 < keys.size(); ++k)
      for (int i = 0; i <= maps; ++i)
        for (const Complex& z : motion.map_at(
                 std::lerp(keys[k].time, keys[k + 1].time, static_cast<double>(i) / maps)))
          exact.include(z);
    constexpr double kInvisible = 2e-3;  // px
    CHECK(box->left <= exact.left + kInvisible);
    CHECK(box->bottom <= exact.bottom + kInvisible);
    CHECK(box->right >= exact.right - kInvisible);
    CHECK(box->top >= exact.top - kInvisible);
    CHECK(exact.left - box->left < 0.6);
    CHECK(box->right - exact.right < 0.6);
    CHECK(exact.bottom - box->bottom < 0.6);
    CHECK(box->top - exact.top < 0.6);
  }
}

}  // namespace

TEST_CASE("A canceled film leaves no file and does not touch existing ones") {
  const Image image = gray();
  for (const char* kind : {".webp", ".gif", ".apng", ".png"}) {
    INFO(kind);
    const Folder folder;
    const Path out = folder.path / ("film" + std::string(kind));
    const Path before = files_of_film(out, 1)[0];
    write_file(before, "what was there");
    int calls_of_all = 0;
    write_film(folder.path / ("other" + std::string(kind)), film_scene(), &image, {},
               [&](int, int) {
                 ++calls_of_all;
                 return true;
               });
    for (const Path& file : files_of_film(folder.path / ("other" + std::string(kind)), 13))
      std::filesystem::remove(file);
    // While the rectangle is measured, at the first frames, in the middle, and after the last one.
    for (const int calls :
         {0, 2, calls_of_all - 14, calls_of_all - 12, calls_of_all - 7, calls_of_all - 1}) {
      int left = calls;
      const auto there = write_film(out, film_scene(), &image, {}, [&](int done, int all) {
        CHECK(all == 13);
        CHECK(done <= all);
        return left-- > 0;
      });
      INFO("canceled after " << calls);
      CHECK_FALSE(there.has_value());
      CHECK(folder.names() == std::vector<std::string>{before.filename().string()});
      CHECK(read_file(before) == "what was there");
    }
    CHECK(write_film(out, film_scene(), &image, {}, [](int, int) { return true; }).has_value());
    CHECK(folder.names().size() == files_of_film(out, 13).size());
    CHECK(read_file(before) != "what was there");
  }
}

TEST_CASE("A folder with the name of a frame is reported before any frame is replaced") {
  const Folder folder;
  const Image image = gray();
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
      Catch::Contains("50 frames per second"));
}

TEST_CASE("A film rendered on its own thread reports its progress and stops when canceled") {
  const Folder folder;
  const Path out = folder.path / "film.apng";
  const Image image = gray();
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
    CHECK(job.ended_within(60000));
    REQUIRE(job.error());
  }
  { Job cancelled("Film", film_into(out)); }
  if (std::filesystem::exists(out)) {  // finished before it was canceled, so it is complete
    const std::string bytes = read_file(out);
    CHECK(bytes.substr(bytes.size() - 8, 4) == "IEND");
  }
  Scene still = film_scene();
  change(still, [](Deformation& d) { d.keyframes.clear(); });
  CHECK_THROWS_AS(write_film(out, still, &image, {}, [](int, int) { return true; }), Error);
}

TEST_CASE("A range of frames equals the same part of the whole film") {
  const Folder folder;
  const Image image = gray();
  const auto keep_going = [](int, int) { return true; };
  FilmOptions options;
  write_film(folder.path / "all.png", film_scene(), &image, options, keep_going);
  options.first = 4;
  options.last = 6;
  options.picture.region = PictureMaker(film_scene(), &image).rectangle();
  write_film(folder.path / "part.png", film_scene(), &image, options, keep_going);
  CHECK(folder.names().size() == 13 + 3);
  PictureOptions still;
  still.region = options.picture.region;
  still.time = 5 / film_scene().animation.frames_per_second;
  CHECK(read_file(numbered(folder.path / "part.png", 1)) ==
        encode_png(picture_of(film_scene(), &image, still).image));
  options.last = 13;
  CHECK_THROWS_WITH(write_film(folder.path / "no.png", film_scene(), &image, options, keep_going),
                    Catch::Contains("0 to 12"));
}

TEST_CASE("The rectangle of a film fits the whole motion tightly at any frame rate") {
  check_rectangles(seeds_of("rectangles of films", {1, 2}));
}

TEST_CASE("The rectangle of a film fits the whole motion tightly: another motion") {
  check_rectangles(seeds_of("rectangles of films, another motion", {3}));
}

TEST_CASE("A film that loops leaves out a last frame that equals the first") {
  Scene scene = film_scene();
  Deformation deformation = scene.deformation();
  const Pose first = deformation.keyframes[0].pose;
  deformation = with_key(posed_as(std::move(deformation), first), 1);
  const Scene closed = with_deformation(scene, deformation);
  CHECK(last_frame_of(closed) == 24);
  CHECK(frames_of_film(closed, 0, 24, true) == 24);
  CHECK(frames_of_film(closed, 0, 24, false) == 25);
  CHECK(frames_of_film(closed, 0, 23, true) == 24);  // ends before the last key
  CHECK(frames_of_film(closed, 12, 12, true) == 1);
  CHECK(frames_of_film(scene, 0, 12, true) == 13);  // ends at another pose
  // A hidden layer counts if it moves a visible one.
  Layer hidden = scene.layer(), rider;
  hidden.id = 1, hidden.visible = false;
  rider.id = 2;
  Scene carried = scene;
  carried.layers = shared({hidden, rider});
  CHECK(frames_of_film(carried, 0, 12, true) == 12);
  rider.attachment = Attachment{1, Attachment::To::place, 0, {20, 15}, {}};
  carried.layers = shared({hidden, rider});
  CHECK(frames_of_film(carried, 0, 12, true) == 13);
  const Folder folder;
  const Image image = gray();
  const auto written =
      write_film(folder.path / "loop.png", closed, &image, {}, [](int, int) { return true; });
  REQUIRE(written);
  CHECK(written->frames == 24);
  CHECK(folder.names().size() == 24);
}

TEST_CASE("A cropped film covers what some frame fills") {
  Image dot(60, 40);  // transparent, except for a square
  for (int row = 15; row < 25; ++row)
    for (int column = 10; column < 20; ++column) std::fill_n(dot.at(column, row), 4, 255);
  const Folder folder;
  FilmOptions options;
  options.picture.crops_to_filled = true;
  Scene scene = film_scene();
  const auto film =
      write_film(folder.path / "dot.png", scene, &dot, options, [](int, int) { return true; });
  REQUIRE(film);
  // The square moves by 8 px to the right.
  CHECK(film->width >= 17);
  CHECK(film->width <= 20);
  CHECK(film->height >= 10);
  CHECK(film->height <= 12);
  CHECK(film->corner.real() == Approx(10).margin(1));
  CHECK(film->corner.imag() == Approx(15).margin(1));
}

}  // namespace holomorph::film_test
