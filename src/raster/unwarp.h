// The inverse map as pictures: where each posed pixel comes from, and a posed picture straightened.
#pragma once

#include <functional>

#include "raster/raster.h"
#include "scene/scene.h"

namespace holomorph {

/// For every pixel of the picture's rectangle the place it shows, as compositors want it: s to the
/// right and t upwards, 0 to 1 over the picture; NaN where nothing is shown. Rows from the top.
struct StMap {
  int width = 0, height = 0;
  std::vector<float> st;  ///< width x height x 2
};

/// The ST-map of a scene, posed or at a time of its keyframes, of a picture of this size, `scale`
/// pixels per picture pixel. Each place is the map's own, rounded to single precision. `progress`
/// is told, on this thread, how many rows are done and how many there are; what it throws comes
/// out. Throws Error without a cage. Cost: 20 us a pixel and core with 10 straight edges, 45 with
/// 20 curved ones.
StMap st_map_of(
    const Scene& scene, int picture_width, int picture_height, double scale = 1,
    std::optional<double> time = {},
    const std::function<void(int done, int all)>& progress = [](int, int) {});

/// The picture taken for one of the posed scene, and drawn as it was at rest: the rest point z
/// shows the picture at f(z). Nothing is drawn outside the cage. Throws Error without a cage or
/// picture.
Image unwarped(const Scene& scene, const Image* picture, double scale = 1,
               std::optional<double> time = {});

}  // namespace holomorph
