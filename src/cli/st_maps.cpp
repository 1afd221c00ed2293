// Checks first, then prepares the map, so that mistakes are reported at once.
#include "cli/st_maps.h"

#include <cstdio>

#include "cli/progress.h"
#include "cli/streams.h"
#include "core/error.h"
#include "exports/st_map_file.h"
#include "film/film_writer.h"

namespace holomorph {
namespace {

FloatBits bits_of(const ExportCommand& command) {
  return command.half ? FloatBits::half : FloatBits::single;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

void export_one(const LoadedScene& loaded, const ExportCommand& command, const Image& picture,
                const StMapOptions& options) {
  check_out(command.out, command.force, command.scene, loaded);
  std::string size, bytes;
  {
    Progress progress("export", "row");
    TimedMap map(loaded.scene);
    StMap made = st_map_of(map, picture, options, [&](int done, int all) {
      progress.step(static_cast<size_t>(done), static_cast<size_t>(all));
    });
    size = size_text(made.width, made.height);
    bytes = st_map_bytes(std::move(made), command.out, bits_of(command));
  }
  write_result(command.out, bytes);
  std::fprintf(stderr, "%s: %s\n", shown_output(command.out).c_str(), size.c_str());
}

void export_frames(const LoadedScene& loaded, const ExportCommand& command, const Image& picture,
                   const StMapOptions& options) {
  if (is_standard(command.out))
    throw Error(ErrorKind::bad_input,
                "each frame is a file of its own; give a file name with --out");
  const FrameRange range = frames_named(*command.moments.frames, loaded.scene);
  for (int i = range.first; i <= range.last; ++i)
    check_out(numbered(command.out, i), command.force, command.scene, loaded);
  const DeferredStop tidy;
  std::string size;
  {
    Progress progress("export", "frame");
    const auto step = [&](int done, int all) {
      progress.step(static_cast<size_t>(done), static_cast<size_t>(all));
      return true;
    };
    const auto written = write_st_maps(loaded.scene, picture, options, range.first, range.last,
                                       command.out, bits_of(command), step);
    size = size_text(written->width, written->height);
  }
  std::fprintf(stderr, "%d ST-maps of %s: %s to %s\n", range.last - range.first + 1, size.c_str(),
               numbered(command.out, range.first).c_str(),
               numbered(command.out, range.last).c_str());
}

}  // namespace

void export_st_maps(const LoadedScene& loaded, const ExportCommand& command) {
  require_cage(loaded.scene, command.scene);
  if (command.half && !is_exr_name(command.out))
    throw Error(ErrorKind::bad_input, "--half needs an OpenEXR file; end the name with .exr");
  const Image none, &picture = loaded.image() ? *loaded.image() : none;
  const StMapOptions options{command.format == "unwarp-map", command.scale.value_or(1),
                             command.overscan.value_or(0), command.moments.time};
  check_map_size(options.scale, picture.page(), options.overscan);
  if (command.moments.frames)
    export_frames(loaded, command, picture, options);
  else
    export_one(loaded, command, picture, options);
}

}  // namespace holomorph
