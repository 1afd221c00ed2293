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

}  // namespace holomorph
