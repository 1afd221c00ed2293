// Thumbnails are drawn by the raster, like every exported picture.
#include "app/samples.h"

#include <algorithm>

#include "core/error.h"
#include "raster/picture.h"
#include "scene/document.h"

namespace holomorph {
namespace {

struct Row {
  const char *name, *title, *text;
};
constexpr Row kRows[] = {
    {"giraffe", "Giraffe",
     "A cage around the whole animal; its neck is bent by a few cage points."},
    {"gecko", "Gecko", "Pins hold and move feet, head and tail."},
    {"fish", "Fish", "A curved cage with few points: bend its tangents."},
    {"octopus", "Octopus", "Nothing folds, however you pull its pins: try to break it."},
    {"snake", "Snake", "One stroke along its body: move, bend or redraw the line."},
    {"heart", "Heart", "The fish's shape goes onto a drawn line: draw your own with U."},
    {"tiger", "Tiger", "A painted face goes onto a mask in space: drag the mask to turn it."},
    {"fern", "Fern", "Corners turn its tip more than once around, and it unrolls: Space plays."},
    {"sunflower", "Sunflower", "A cage, and pins that turn leaves and head."}};
constexpr double kThumbnail = 320;  ///< pixels of the longer side

/// Beside the installed program, wherever that is, or in the source it was built from.
Path assets() {
  std::error_code error;
  const Path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const Path installed = program.parent_path().parent_path() / "share/holomorph/assets";
  return !error && is_there(installed) ? installed : Path(HOLOMORPH_ASSETS);
}

}  // namespace

std::vector<Sample> load_samples() {
  const Path folder = assets();
  std::vector<Sample> samples;
  for (const Row& row : kRows) {
    Sample sample{folder / (std::string(row.name) + ".json"), row.title, row.text, {}};
    if (!is_there(sample.scene)) continue;
    try {
      const LoadedScene loaded = load_scene(sample.scene);
      PictureOptions options;
      options.scale = kThumbnail / std::max({loaded.image()->width, loaded.image()->height, 1});
      const Image image = picture_of(loaded.scene, loaded.image(), options, loaded.pictures).image;
      sample.thumbnail = Texture(image.width, image.height, image.pixels.data());
    } catch (const Error&) {
      // The tile stays without a picture.
    }
    samples.push_back(std::move(sample));
  }
  return samples;
}

}  // namespace holomorph
