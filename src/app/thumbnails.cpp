// One thread draws one thumbnail after the other, the latest request first.
#include "app/thumbnails.h"

#include <algorithm>
#include <cmath>

#include "raster/picture.h"
#include "scene/document.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/film_frames.h"

namespace holomorph {
namespace {

constexpr int kLongestSide = 256;
constexpr size_t kMostThumbnails = 300, kMostWaiting = 200;

Image thumbnail_of_file(const Path& file) {
  if (is_named_as(file, FileContent::film)) return reduced(first_frame_of_film(file), kLongestSide);
  if (!is_named_as(file, FileContent::scene))
    return reduced(decode_image(read_file(file), file.filename().string()), kLongestSide);
  const LoadedScene loaded = load_scene(file);
  PictureOptions options;
  double longest = 1;
  if (const Image* image = loaded.image())
    longest = std::max(image->page().width(), image->page().height());
  options.scale = std::min(1.0, kLongestSide / longest);
  return reduced(picture_of(loaded.scene, loaded.image(), options, loaded.pictures).image,
                 kLongestSide);
}

}  // namespace

Image reduced(const Image& picture, int longest) {
  const int side = std::max(picture.width, picture.height);
  if (side <= longest) return picture;
  const double scale = static_cast<double>(side) / longest;
  Image small(std::max(1, static_cast<int>(std::lround(picture.width / scale))),
              std::max(1, static_cast<int>(std::lround(picture.height / scale))));
  for (int y = 0; y < small.height; ++y) {
    const int top = y * picture.height / small.height,
              bottom = std::max(top + 1, (y + 1) * picture.height / small.height);
    for (int x = 0; x < small.width; ++x) {
      const int left = x * picture.width / small.width,
                right = std::max(left + 1, (x + 1) * picture.width / small.width);
      // Averages colors with their alpha as weights.
      double color[3] = {0, 0, 0}, alpha = 0;
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u) {
          const std::uint8_t* pixel = picture.at(u, v);
          for (int k = 0; k < 3; ++k) color[k] += static_cast<double>(pixel[k]) * pixel[3];
          alpha += pixel[3];
        }
      std::uint8_t* pixel = small.at(x, y);
      for (int k = 0; k < 3; ++k)
        pixel[k] = static_cast<std::uint8_t>(alpha > 0 ? std::lround(color[k] / alpha) : 0);
      pixel[3] = static_cast<std::uint8_t>(std::lround(alpha / ((bottom - top) * (right - left))));
    }
  }
  return small;
}

bool Thumbnails::can_show(const Path& file) {
  return is_named_as(file, FileContent::scene) || is_named_as(file, FileContent::picture) ||
         is_named_as(file, FileContent::film);
}

const Texture* Thumbnails::of_file(const Path& file) {
  take_done();
  std::error_code error;
  const auto time = std::filesystem::last_write_time(file, error);
  if (error || !can_show(file)) return nullptr;
  Entry& entry = entries_[{file, nullptr}];
  entry.used = ++clock_;
  if (entry.time != time) {
    entry.time = time;
    waiting_.emplace_back(Key{file, nullptr}, [file] { return thumbnail_of_file(file); });
    start_next();
  }
  return entry.ready ? &entry.texture : nullptr;
}

const Texture* Thumbnails::of_picture(const std::shared_ptr<const Image>& picture) {
  take_done();
  if (!picture) return nullptr;
  Entry& entry = entries_[{{}, picture.get()}];
  entry.used = ++clock_;
  if (entry.picture.lock() != picture) {
    entry.picture = picture;
    entry.ready = false;
    waiting_.emplace_back(Key{{}, picture.get()},
                          [picture] { return reduced(*picture, kLongestSide / 2); });
    start_next();
  }
  return entry.ready ? &entry.texture : nullptr;
}

void Thumbnails::take_done() {
  std::vector<std::pair<Key, Image>> images;
  {
    const std::lock_guard lock(done_->mutex);
    images.swap(done_->images);
  }
  for (const auto& [key, image] : images)
    if (const auto found = entries_.find(key); found != entries_.end() && image.width > 0) {
      found->second.texture = Texture(image.width, image.height, image.pixels.data());
      found->second.ready = true;
    }
  if (job_ && job_->ended()) job_.reset();
  start_next();
  forget_oldest();
}

void Thumbnails::start_next() {
  if (job_ || waiting_.empty()) return;
  auto [key, draw] = std::move(waiting_.back());
  waiting_.pop_back();
  for (; waiting_.size() > kMostWaiting; waiting_.pop_front())
    entries_.erase(waiting_.front().first);  // the next request draws it
  job_ = std::make_unique<Job>(
      "Drawing a thumbnail",
      [key = key, draw = draw, done = done_, wake = wake_](Job::Progress& progress) {
        Image image;
        try {
          image = draw();
        } catch (const std::exception&) {
          // The list then shows no picture.
        }
        if (progress.cancelled()) return;
        const std::lock_guard lock(done->mutex);
        done->images.emplace_back(key, std::move(image));
      },
      wake_);
}

void Thumbnails::forget_oldest() {
  std::erase_if(entries_, [](const auto& entry) {
    return entry.first.picture && entry.second.picture.expired();
  });
  while (entries_.size() > kMostThumbnails)
    entries_.erase(std::ranges::min_element(entries_, {},
                                            [](const auto& entry) { return entry.second.used; }));
}

}  // namespace holomorph
