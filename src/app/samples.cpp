// Thumbnails are drawn by the rasterizer, like exported pictures.
#include "app/samples.h"

#include <algorithm>
#include <utility>

#include "raster/picture.h"
#include "scene/document.h"

namespace holomorph {
namespace {

struct SampleRow {
  const char *name, *title, *text;
};
constexpr SampleRow kRows[] = {
    {"giraffe", "Giraffe",
     "Pins hold the feet, and others lower the head. Nothing grows or shrinks much."},
    {"gecko", "Gecko", "Pins move the feet, head and tail, which keep their sizes."},
    {"fish", "Fish", "A curved cage with few points. Drag its tangent handles."},
    {"octopus", "Octopus", "Nothing folds, however far you pull the pins. Try to break it."},
    {"snake", "Snake", "One stroke along its body. Move, bend or redraw the line."},
    {"heart", "Heart", "A fish in the shape of a heart. Press U to draw another outline."},
    {"tiger", "Tiger", "A painted face on a mask in space. Drag the mask to turn it."},
    {"fern", "Fern",
     "Turned corners curl the tip more than once around. Press Space to unroll it."},
    {"sunflower", "Sunflower", "A cage, and pins that turn the leaves and the head."}};
constexpr double kThumbnail = 320;  ///< length of the longer side in pixels

/// The folder with the samples. If the program is not installed, this is the folder in the source
/// tree from which it was built.
Path assets() {
  std::error_code error;
  const Path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const Path installed = program.parent_path().parent_path() / "share/holomorph/assets";
  return !error && path_exists(installed) ? installed : Path(HOLOMORPH_ASSETS);
}

}  // namespace

namespace {

Image thumbnail_of(const Path& scene) {
  const LoadedScene loaded = load_scene(scene);
  PictureOptions options;
  options.scale = kThumbnail / std::max({loaded.image()->width, loaded.image()->height, 1});
  return picture_of(loaded.scene, loaded.image(), options, loaded.pictures).image;
}

}  // namespace

const std::vector<Sample>& Samples::shown() {
  if (!std::exchange(listed_, true)) {
    const Path folder = assets();
    for (const SampleRow& row : kRows)
      if (const Path scene = folder / (std::string(row.name) + ".json"); path_exists(scene))
        samples_.push_back({scene, row.title, row.text});
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

}  // namespace holomorph
