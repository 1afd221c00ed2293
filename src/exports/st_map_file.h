// ST-maps as files, in OpenEXR or NumPy.
#pragma once

#include "raster/st_map.h"
#include "system/file.h"

namespace holomorph {

/// Whether the name of an ST-map ends in .exr. Otherwise, it is NumPy: .npy, or no extension.
/// Throws Error for other extensions.
bool is_exr_name(const Path& out);

/// The bytes of an ST-map's file. OpenEXR has channels in the usual order, in half or single
/// precision, and finite values everywhere.
std::string st_map_bytes(StMap map, const Path& out, FloatBits bits);

/// The size of ST-maps that were written.
struct StMapSize {
  int width = 0, height = 0;
};
/// Writes the ST-maps of frames `first` to `last` to files named by numbered(). `progress` is
/// called between steps with the number of finished frames and of all frames. If it returns false,
/// the rest is left out and the result is none. Throws Error.
std::optional<StMapSize> write_st_maps(const Scene& scene, const Image& picture,
                                       StMapOptions options, int first, int last, const Path& out,
                                       FloatBits bits,
                                       const std::function<bool(int done, int all)>& progress);

}  // namespace holomorph
