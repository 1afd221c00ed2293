// NumPy files keep what the map has, NaN included; compositing programs get no NaN.
#include "exports/st_map_file.h"

#include "core/error.h"
#include "film/film_writer.h"
#include "scene/formats/export.h"
#include "system/new_file.h"
#include "system/text.h"

namespace holomorph {

bool is_exr_name(const Path& out) {
  const std::string extension = lower_case(out.extension().string());
  if (!extension.empty() && extension != ".exr" && extension != ".npy")
    throw Error(ErrorKind::bad_input,
                out.string() +
                    ": an ST-map is an OpenEXR or NumPy file; end the name with .exr or "
                    ".npy");
  return extension == ".exr";
}

std::string st_map_bytes(StMap map, const Path& out, FloatBits bits) {
  if (!is_exr_name(out))
    return npy_of(map.st, static_cast<size_t>(map.height), static_cast<size_t>(map.width), 2);
  extend(map);
  return exr_of(float_image_of(std::move(map)), bits);
}

std::optional<StMapSize> write_st_maps(const Scene& scene, const Image& picture,
                                       StMapOptions options, int first, int last, const Path& out,
                                       FloatBits bits,
                                       const std::function<bool(int done, int all)>& progress) {
  struct Stopped {};
  const int all = last - first + 1;
  TimedMap map(scene);
  StMapSize size;
  try {
    for (int done = 0; done < all; ++done) {
      const auto go_on = [&](int, int) {
        if (!progress(done, all)) throw Stopped{};
      };
      options.time = (first + done) / scene.animation.frames_per_second;
      StMap made = st_map_of(map, picture, options, go_on);
      size = {made.width, made.height};
      write_file(numbered(out, first + done), st_map_bytes(std::move(made), out, bits));
    }
  } catch (Stopped) {
    return {};
  }
  return size;
}

}  // namespace holomorph
