#include "cli/st_maps.h"

#include "cli/progress.h"
#include "cli/streams.h"
#include "core/error.h"
#include "film/film_writer.h"
#include "raster/st_map.h"
#include "scene/formats/export.h"
#include "system/text.h"

namespace holomorph {
namespace {

/// Throws Error for other files than OpenEXR and NumPy.
bool is_exr(const Path& out) {
  if (is_standard(out)) return false;
  const std::string extension = lower_case(out.extension().string());
  if (extension != ".exr" && extension != ".npy")
    throw Error(ErrorKind::bad_input,
                out.string() +
                    ": an ST-map is an OpenEXR or NumPy file; end the name with .exr or "
                    ".npy");
  return extension == ".exr";
}

std::string encoded(StMap map, bool exr, bool half) {
  if (!exr)
    return npy_of(map.st, static_cast<size_t>(map.height), static_cast<size_t>(map.width), 2);
  extend(map);
  return exr_of(float_image_of(map), half ? FloatBits::half : FloatBits::single);
}

std::string size_text(const StMap& map) {
  return std::to_string(map.width) + " x " + std::to_string(map.height) + " pixels";
}

}  // namespace

void export_st_maps(const LoadedScene& loaded, const ExportCommand& command) {
  require_cage(loaded.scene, command.scene);
  const bool exr = is_exr(command.out);
  if (command.half && !exr)
    throw Error(ErrorKind::bad_input, "--half needs an OpenEXR file; end the name with .exr");
  const Image none, &picture = loaded.image() ? *loaded.image() : none;
  StMapOptions options{command.format == "unwarp-map", command.scale.value_or(1),
                       command.overscan.value_or(0), command.moments.time};
  check_map_size(options.scale, picture.width, picture.height, options.overscan);
  const auto made = [&](TimedMap& map, const RowProgress& progress) {
    return st_map_of(map, picture, options, progress);
  };
  TimedMap map(loaded.scene);
  if (!command.moments.frames) {
    check_out(command.out, command.force, command.scene, loaded);
    Progress progress("export", "row");
    StMap whole = made(map, [&](int done, int all) {
      progress.step(static_cast<size_t>(done), static_cast<size_t>(all));
    });
    const std::string size = size_text(whole);
    write_result(command.out, encoded(std::move(whole), exr, command.half));
    std::fprintf(stderr, "%s: %s\n", shown_output(command.out).c_str(), size.c_str());
    return;
  }
  if (is_standard(command.out))
    throw Error(ErrorKind::bad_input,
                "each frame is a file of its own; give a file name with --out");
  const FrameRange range = frames_named(*command.moments.frames, loaded.scene);
  for (int i = range.first; i <= range.last; ++i)
    check_out(numbered(command.out, i), command.force, command.scene, loaded);
  const DeferredStop tidy;
  Progress progress("export", "frame");
  const size_t count = static_cast<size_t>(range.last - range.first + 1);
  std::string size;
  for (size_t k = 0; k < count; ++k) {
    progress.step(k, count);
    const int frame = range.first + static_cast<int>(k);
    options.time = frame / loaded.scene.animation.frames_per_second;
    StMap one = made(map, [](int, int) { stop_if_interrupted(); });
    size = size_text(one);
    write_file(numbered(command.out, frame), encoded(std::move(one), exr, command.half));
  }
  std::fprintf(stderr, "%zu ST-maps of %s: %s to %s\n", count, size.c_str(),
               numbered(command.out, range.first).c_str(),
               numbered(command.out, range.last).c_str());
}

}  // namespace holomorph
