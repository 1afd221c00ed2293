// The time of films, and the frames that are kept of them.
#include "scene/footage.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

#include "core/error.h"
#include "scene/clips.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/numbered_frames.h"
#include "scene/formats/scene_json.h"
#include "scene/keyframes.h"
#include "scene/pictures.h"
#include "support/catch.h"
#include "support/folder.h"
#include "support/seeds.h"
#include "system/new_file.h"

namespace holomorph::footage_test {

namespace {

/// Frames whose first byte is their number.
class CountingReader final : public FrameReader {
 public:
  CountingReader(int frames, int side) : frames_(frames), side_(side) {}

  FilmInfo info() const override { return {frames_, 25}; }
  Image read(int frame) override {
    ++reads;
    if (fails_from <= frame && frame <= fails_to)
      throw Error(ErrorKind::bad_input, "frame cannot be decoded");
    Image image(side_, side_);
    image.pixels[0] = static_cast<std::uint8_t>(frame);
    return image;
  }

  std::atomic<int> reads = 0;
  int fails_from = 0, fails_to = -1;

 private:
  int frames_, side_;
};

int number_of(const std::shared_ptr<const Image>& image) {
  return image ? image->pixels[0] : -1;
}

/// Asks for a frame until it is there, for at most ten seconds.
bool appears(Footage& footage, int number) {
  for (int i = 0; i < 1000; ++i) {
    if (number_of(footage.frame_now(1, number, [] {})) == number) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace

TEST_CASE("The frame at a time is the last one that has begun") {
  for (const unsigned seed : seeds_of("clips", {1, 2, 3})) {
    std::mt19937 random(seed);
    const auto uniform = [&](double from, double to) {
      return std::uniform_real_distribution(from, to)(random);
    };
    for (int k = 0; k < 200; ++k) {
      Clip clip;
      clip.frames = 1 + static_cast<int>(random() % 300);
      clip.first = static_cast<int>(random()) % clip.frames;
      clip.first = std::abs(clip.first);
      if (random() % 2 == 0)
        clip.last = clip.first +
                    static_cast<int>(random() % static_cast<unsigned>(clip.frames - clip.first));
      clip.frames_per_second = uniform(1, 240);
      clip.start = uniform(-20, 20);
      clip.loops = random() % 2 == 0;
      const int last = clip.last.value_or(clip.frames - 1), count = last - clip.first + 1;
      const double time = uniform(-30, 30);
      // By its definition, from the times at which frames begin.
      const auto begins = [&](double i) { return clip.start + i / clip.frames_per_second; };
      double i = std::round((time - clip.start) * clip.frames_per_second) + 2;
      while (begins(i) > time) --i;
      if (std::abs(begins(i + 1) - time) < 1e-6 || std::abs(begins(i) - time) < 1e-6) continue;
      int expected = static_cast<int>(std::clamp(i, 0.0, count - 1.0));
      if (clip.loops) expected = ((static_cast<int>(i) % count) + count) % count;
      INFO("seed " << seed << ", clip " << k);
      CHECK(clip_frame_at(clip, time) == clip.first + expected);
    }
  }
}

TEST_CASE("Frame i of a film with the scene's rate is shown in frame i of the scene") {
  for (const double rate : {12.0, 24.0, 25.0, 29.97, 30000.0 / 1001, 60.0}) {
    Clip clip{rate, 5000};
    for (int i = 0; i < 5000; ++i) REQUIRE(clip_frame_at(clip, i / rate) == i);
  }
}

TEST_CASE("Films lengthen a scene until their last frame has been shown as long as the others") {
  Layer layer;
  layer.image.emplace().file = "film.mp4";
  layer.image->clip = Clip{25, 101, 20, {}, 1.5};
  const Scene scene = scene_of(layer);
  CHECK(has_time(scene));
  CHECK(plays(scene));
  CHECK(length_of(scene) == Approx(113 / 24.0));  // frame 100 is shown from 4.70 to 4.74 s
  layer.image->clip = Clip{25, 1};
  CHECK_FALSE(plays(scene_of(layer)));
}

TEST_CASE("The last frame of a scene is the last one that shows the end of its film") {
  for (const unsigned seed : seeds_of("ends of films", {1, 2, 3})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const std::vector<double> rates{2, 5, 9, 10, 12, 24, 25, 29.97, 30000.0 / 1001, 60};
    for (int k = 0; k < 100; ++k) {
      const int frames = 2 + static_cast<int>(random() % 40),
                first = static_cast<int>(random()) & 1;
      const double start = random() % 2 ? 0 : static_cast<double>(random() % 400) / 100;
      Layer layer;
      layer.image.emplace().file = "film.mp4";
      layer.image->clip =
          Clip{rates[random() % rates.size()], frames, first, {}, start, random() % 2 == 0};
      const Clip& clip = *layer.image->clip;
      Scene scene = scene_of(layer);
      const double rate = scene.animation.frames_per_second = rates[random() % rates.size()];
      INFO(clip.frames_per_second << " in " << rate << " per second, " << frames << " frames");
      const double ends = start + duration_of(clip);
      const int last = last_frame_of(scene);
      if (end_of(clip) + 1e-5 < ends - 1 / rate)
        CHECK(clip_frame_at(clip, last / rate) == frames - 1);
      CHECK((last + 1) / rate > ends - 1e-5);
      if (rate > clip.frames_per_second) CHECK(period_of(scene) < ends + 1 / rate - 1e-6);
    }
  }
}

TEST_CASE("A film that has become shorter shows the frames that it still has") {
  const Clip clip{25, 60, 50, 80};
  CHECK(first_played_frame(clip) == 50);
  CHECK(last_played_frame(clip) == 59);
  const Clip shorter{25, 10, 50, 80};
  CHECK(clip_frame_at(shorter, 0) == 9);
  CHECK(clip_frame_at(shorter, 100) == 9);
}

TEST_CASE("Playback that ends with a film shows its last frame as long as the others") {
  Layer layer;
  layer.image.emplace();
  layer.image->clip = Clip{12, 12};
  Scene scene = scene_of(layer);
  scene.animation.frames_per_second = 12;
  CHECK(last_frame_of(scene) == 11);
  CHECK(period_of(scene) == Approx(1));
  layer.image->clip = Clip{12, 12, 0, {}, -3.5, true};  // ends long before time 0, again and again
  CHECK(plays(scene_of(layer)));
  CHECK(end_of(*layer.image->clip) > 0);
  CHECK_FALSE(moves(scene_of(layer)));
}

TEST_CASE("Scene files keep clips, and what they do not know of them") {
  Layer layer;
  layer.image.emplace().file = "film.mp4";
  layer.image->clip = Clip{23.976, 240, 3, 200, -1.25, true, R"({"later":[1]})"};
  const Scene scene = scene_of(layer);
  CHECK(scene_from_json(json_of(scene), "scene") == scene);
  layer.image->clip = Clip{};
  CHECK(scene_from_json(json_of(scene_of(layer)), "scene") == scene_of(layer));
}

TEST_CASE("A frame that is wanted now follows soon, and wakes the caller") {
  Footage footage(std::make_unique<CountingReader>(100, 4));
  std::atomic<int> woken = 0;
  CHECK(footage.frame_now(1, 7, [&] { ++woken; }) == nullptr);
  for (int i = 0; i < 1000 && woken == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK(woken > 0);
  CHECK(number_of(footage.frame_now(1, 7, [] {})) == 7);
  CHECK(appears(footage, 99));
  CHECK(number_of(footage.frame(1000)) == 99);
}

TEST_CASE("A missing frame is replaced by one at most a second before it") {
  auto reader = std::make_unique<CountingReader>(100, 4);
  reader->fails_from = 49;
  reader->fails_to = 99;
  Footage footage(std::move(reader));
  CHECK(number_of(footage.frame(48)) == 48);
  CHECK(number_of(footage.frame_now(1, 49, [] {})) == 48);
  CHECK(number_of(footage.frame_now(1, 48 + 25, [] {})) == 48);
  CHECK(footage.frame_now(1, 48 + 26, [] {}) == nullptr);
}

TEST_CASE("Layers that show different times of a film all get their frames") {
  Footage footage(std::make_unique<CountingReader>(200, 4));
  for (int time = 0; time < 20; ++time) {
    bool all = false;
    for (int i = 0; i < 1000 && !all; ++i) {
      all = true;
      for (int layer = 0; layer < 3; ++layer) {
        const int number = time + 60 * layer;
        all = number_of(footage.frame_now(layer, number, [] {})) == number && all;
      }
      if (!all) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    REQUIRE(all);
  }
}

TEST_CASE("A frame that was forgotten is decoded again when it is shown again") {
  Footage footage(std::make_unique<CountingReader>(60, 4096));  // 64 MiB for each frame
  CHECK(appears(footage, 3));
  for (int i = 20; i < 26; ++i) footage.frame(i);
  CHECK(appears(footage, 3));
}

TEST_CASE("Frames are decoded once as long as they are kept") {
  auto reader = std::make_unique<CountingReader>(100, 4);
  const CountingReader& counter = *reader;
  Footage footage(std::move(reader));
  for (int round = 0; round < 3; ++round)
    for (int i = 0; i < 20; ++i) CHECK(number_of(footage.frame(i)) == i);
  CHECK(counter.reads == 20);
}

TEST_CASE("Only about 256 MB of frames are kept") {
  constexpr int kSide = 2048;  // 16 MiB for each frame
  auto reader = std::make_unique<CountingReader>(40, kSide);
  const CountingReader& counter = *reader;
  Footage footage(std::move(reader));
  std::vector<std::weak_ptr<const Image>> all;
  for (int i = 0; i < 40; ++i) all.push_back(footage.frame(i));
  CHECK(std::ranges::count_if(all, [](const auto& frame) { return !frame.expired(); }) == 16);
  CHECK(number_of(footage.frame(0)) == 0);
  CHECK(counter.reads == 41);
}

TEST_CASE("A frame that cannot be decoded is reported once and not tried again") {
  auto reader = std::make_unique<CountingReader>(100, 4);
  reader->fails_from = 30;
  reader->fails_to = 33;
  const CountingReader& counter = *reader;
  Footage footage(std::move(reader));
  CHECK_THROWS_AS(footage.frame(30), Error);
  std::optional<Error> error;
  for (int i = 0; i < 1000 && !error; ++i) {
    footage.frame_now(1, 30, [] {});
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    error = footage.take_error();
  }
  REQUIRE(error);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // frames ahead
  footage.take_error();
  const int reads = counter.reads;
  for (int i = 0; i < 40; ++i) {
    footage.frame_now(1, 30 + i % 2, [] {});
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  CHECK(counter.reads <= reads + 7);
  CHECK_FALSE(footage.take_error());
  CHECK(appears(footage, 34));
}

TEST_CASE("Numbered pictures are found from any of them") {
  const Folder folder;
  const std::vector<std::vector<std::string>> sequences{
      {"a001.png", "a002.png", "a003.png"},
      {"b8.png", "b9.png", "b10.png", "b11.png"},
      {"c098.png", "c099.png", "c100.png", "c101.png"},
      {"d 0.png", "d 1.png"}};
  for (const auto& names : sequences) {
    for (const std::string& name : names) write_file(folder.path / name, "x");
    for (const std::string& name : names) {
      INFO(name);
      CHECK(first_numbered_picture(folder.path / name) == folder.path / names[0]);
      CHECK(has_numbered_neighbor(folder.path / name));
    }
    std::vector<Path> files;
    for (const std::string& name : names) files.push_back(folder.path / name);
    CHECK(numbered_pictures(files[0]) == files);
  }
  write_file(folder.path / "alone7.png", "x");
  CHECK_FALSE(has_numbered_neighbor(folder.path / "alone7.png"));
  CHECK(numbered_pictures(folder.path / "missing1.png").empty());
}

TEST_CASE("With fine pixels, a film shows the same frame") {
  const Folder folder;
  for (int i = 0; i < 4; ++i) {
    Image frame(3, 2);
    frame.fine.assign(frame.pixels.size(), 10.25f * static_cast<float>(i + 1));
    round_fine(frame);
    write_file(folder.path / ("f" + std::to_string(i) + ".png"), encode_png_16(frame));
  }
  Layer layer;
  layer.image = reference_in(folder.path / "f0.png");
  layer.image->clip.emplace();
  Pictures pictures;
  pictures.put(*layer.image, read_picture(*layer.image));
  pictures.show_frame(layer, 2, pictures.footage(layer)->frame(2));
  std::vector<std::string> losses;
  const Pictures fine = pictures.fine(losses);
  CHECK(losses.empty());
  REQUIRE(!fine.of(layer)->fine.empty());
  CHECK(std::abs(fine.of(layer)->fine[0] - 30.75f) < 1 / 257.0);
  CHECK(std::abs(fine.still(layer)->fine[0] - 10.25f) < 1 / 257.0);
  CHECK(fine.of(layer)->pixels[0] == 31);
  CHECK(pictures.of(layer)->fine.empty());
  // A file that has changed keeps the pixels that were read.
  write_file(folder.path / "f0.png", encode_png_16(Image(3, 2)));
  CHECK(pictures.fine(losses).of(layer)->fine.empty());
  CHECK(losses.size() == 1);
}

TEST_CASE("Several threads may ask for frames") {
  Footage footage(std::make_unique<CountingReader>(200, 16));
  std::vector<std::thread> threads;
  std::atomic<int> wrong = 0;
  for (unsigned t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      std::mt19937 random(t);
      for (int i = 0; i < 300; ++i) {
        const int number = static_cast<int>(random() % 200);
        if (t % 2 == 0 && number_of(footage.frame(number)) != number) ++wrong;
        if (t % 2 == 1) footage.frame_now(1, number, [] {});
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
}

}  // namespace holomorph::footage_test
