// A scene to a picture, as exported: prepare, pose, rasterize.
#pragma once

#include "raster/raster.h"
#include "scene/scene.h"

namespace holomorph {

struct PictureOptions {
  View view = View::image;
  double scale = 1;   ///< output pixels per image pixel
  bool crop = false;  ///< keep the picture's rectangle; else nothing is cut off
  bool automatic_range = false;
};

/// The posed scene as a picture. `source` is the scene's picture, or null when it has none. Throws
/// Error for a scene with neither picture nor cage and for what rasterized refuses.
RasterResult picture_of(const Scene& scene, const Image* source,
                        const PictureOptions& options = {});

}  // namespace holomorph
