// NumPy files keep what the map has, NaN included; compositing programs get no NaN.
#include "exports/st_map_file.h"

#include "core/error.h"
#include "scene/formats/export.h"
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

}  // namespace holomorph
