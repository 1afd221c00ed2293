// Thumbnails are drawn by the rasterizer, like exported pictures.
#include "app/samples.h"

#include <algorithm>
#include <utility>

#include "core/clock.h"
#include "raster/picture.h"
#include "scene/document.h"
#include "scene/keyframes.h"
#include "scene/motion.h"
#include "system/program.h"

namespace holomorph {
namespace {

struct SampleRow {
  const char *name, *title, *line, *text;
};
constexpr SampleRow kRows[] = {
    {"giraffe", "Giraffe", "Puppet: a lowered head",
     "Pins hold the feet, and others lower the head. Nothing grows or shrinks much."},
    {"gecko", "Gecko", "Puppet: feet and tail",
     "Pins move the feet, head and tail, which keep their sizes."},
    {"fish", "Fish", "Curved cage", "A curved cage with few points. Drag its tangent handles."},
    {"octopus", "Octopus", "Puppet: ten pins",
     "Nothing folds, however far you pull the pins. Try to break it."},
    {"snake", "Snake", "Stroke along the body",
     "One stroke along its body. Move, bend or redraw the line."},
    {"heart", "Heart", "Onto a drawn outline",
     "A fish in the shape of a heart. Press U to draw another outline."},
    {"tiger", "Tiger", "Onto a mask in space",
     "A painted face on a mask in space. Drag the mask to turn it."},
    {"fern", "Fern", "Angles: it unrolls",
     "Turned corners curl the tip more than once around. Press Space to unroll it."},
    {"sunflower", "Sunflower", "Elastic: leaves and head",
     "A cage, and pins that turn the leaves and the head."}};
constexpr double kThumbnail = 320;  ///< length of the longer side in pixels

Image thumbnail_of(const Path& scene) {
  const LoadedScene loaded = load_scene(scene);
  PictureOptions options;
  const Box page = loaded.image()->page();
  options.scale = kThumbnail / std::max(page.width(), page.height());
  return picture_of(loaded.scene, loaded.image(), options, loaded.pictures).image;
}

}  // namespace

const std::vector<Sample>& Samples::shown() {
  if (!std::exchange(listed_, true)) {
    const Path folder = data_file("assets", HOLOMORPH_ASSETS);
    for (const SampleRow& row : kRows)
      if (const Path scene = folder / (std::string(row.name) + ".json"); path_exists(scene))
        samples_.push_back({scene, row.title, row.line, row.text});
    done_.resize(samples_.size());
    drawn_ = std::make_shared<DrawnThumbnails>();
  }
  std::vector<std::pair<size_t, Image>> ready;
  {
    const std::lock_guard lock(drawn_->mutex);
    ready.swap(drawn_->images);
  }
  for (const auto& [i, image] : ready) {
    done_[i] = true;
    if (image.width > 0)
      samples_[i].thumbnail = Texture(image.width, image.height, image.pixels.data());
  }
  if (drawing_ && drawing_->ended()) drawing_.reset();
  if (!drawing_ && std::ranges::find(done_, 0) != done_.end()) start();
  return samples_;
}

void Samples::start() {
  std::vector<std::pair<size_t, Path>> wanted;
  for (size_t i = 0; i < samples_.size(); ++i)
    if (!done_[i]) wanted.emplace_back(i, samples_[i].scene);
  drawing_ = std::make_unique<Job>("Drawing the samples",
                                   [wanted, drawn = drawn_, wake = wake_](Job::Progress& progress) {
                                     for (const auto& [i, scene] : wanted) {
                                       if (progress.cancelled()) return;
                                       Image image;
                                       try {
                                         image = thumbnail_of(scene);
                                       } catch (const std::exception&) {
                                         // The tile remains empty.
                                       }
                                       {
                                         const std::lock_guard lock(drawn->mutex);
                                         drawn->images.emplace_back(i, std::move(image));
                                       }
                                       wake();
                                     }
                                   });
}

namespace {

constexpr int kFrames = 12;
constexpr double kFrameMs = 70;

/// The scene with a motion: its own, or one from the rest shape to the pose. None if it has no
/// pose that differs from the rest shape.
std::optional<Scene> scene_in_motion(const Scene& scene) {
  if (has_keyframes(scene)) return scene;
  Deformation deformation = scene.deformation();
  const Pose rest = whole_pose_of(at_rest(deformation)), pose = whole_pose_of(deformation);
  if (rest == pose) return {};
  deformation.keyframes = {Keyframe{0, rest}, Keyframe{1, pose}};
  return with_deformation(scene, std::move(deformation));
}

void draw_frames(const Path& file, Job::Progress& progress,
                 const std::function<void(Image)>& take) {
  const LoadedScene loaded = load_scene(file);
  const std::optional<Scene> scene = scene_in_motion(loaded.scene);
  if (!scene) return;
  PictureMaker maker(*scene, loaded.image(), loaded.pictures);
  PictureOptions options;
  options.region = maker.motion_region([&] { return !progress.cancelled(); });
  if (!options.region) return;
  options.scale = kThumbnail / std::max({options.region->width(), options.region->height(), 1.0});
  const double length = length_of(*scene);
  for (int i = 0; i < kFrames && !progress.cancelled(); ++i) {
    options.time = length * i / (kFrames - 1);
    take(maker.picture(options).image);
  }
}

}  // namespace

void Samples::take_frames() {
  if (!drawn_frames_) return;
  std::vector<std::pair<size_t, Image>> ready;
  {
    const std::lock_guard lock(drawn_frames_->mutex);
    ready.swap(drawn_frames_->images);
  }
  for (const auto& [sample, image] : ready)
    motions_[sample].frames.emplace_back(image.width, image.height, image.pixels.data());
  if (drawing_motion_ && drawing_motion_->ended()) {
    if (drawing_motion_->cancelled())
      motions_.erase(drawn_sample_);
    else
      motions_[drawn_sample_].complete = true;
    drawing_motion_.reset();
  }
}

void Samples::start_motion(size_t sample) {
  drawn_sample_ = sample;
  motions_[sample] = {};
  drawn_frames_ = std::make_shared<DrawnThumbnails>();
  drawing_motion_ = std::make_unique<Job>(
      "Drawing a motion",
      [sample, file = samples_[sample].scene, drawn = drawn_frames_,
       wake = wake_](Job::Progress& progress) {
        draw_frames(file, progress, [&](Image image) {
          {
            const std::lock_guard lock(drawn->mutex);
            drawn->images.emplace_back(sample, std::move(image));
          }
          wake();
        });
      },
      wake_);
}

void Samples::play(std::optional<size_t> sample) {
  take_frames();
  if (sample != playing_) {
    if (drawing_motion_) drawing_motion_->cancel();
    playing_ = sample;
    since_ms_ = now_ms();
  }
  // One motion is drawn at a time. A canceled one ends soon, and then wakes the window.
  if (playing_ && !drawing_motion_ && !motions_[*playing_].complete) start_motion(*playing_);
  if (playing_ && motions_[*playing_].frames.size() > 1) wake_();
}

std::optional<size_t> Samples::frame(size_t sample) const {
  const auto motion = motions_.find(sample);
  if (playing_ != sample || motion == motions_.end() || motion->second.frames.size() < 2) return {};
  const size_t last = motion->second.frames.size() - 1;
  const auto step = static_cast<size_t>((now_ms() - since_ms_) / kFrameMs) % (2 * last);
  return step <= last ? step : 2 * last - step;
}

const Texture* Samples::picture(size_t sample) const {
  if (const auto number = frame(sample)) return &motions_.at(sample).frames[*number];
  return samples_[sample].thumbnail.id() ? &samples_[sample].thumbnail : nullptr;
}

float Samples::progress(size_t sample) const {
  const auto number = frame(sample);
  return number ? static_cast<float>(*number) / static_cast<float>(kFrames - 1) : -1;
}

}  // namespace holomorph
