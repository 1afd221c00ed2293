// The inverse map as images: the rest position of each posed pixel (an ST-map), and a posed picture
// mapped back to rest.
#pragma once

#include <functional>

#include "raster/raster.h"
#include "scene/scene.h"

namespace holomorph {

/// For each pixel of the picture's rectangle, the position in the picture that it shows. As is
/// usual in compositing programs, s points right and t points up, and both run from 0 to 1 across
/// the picture. Pixels that show nothing are NaN. Rows are stored from the top.
struct StMap {
  int width = 0, height = 0;
  std::vector<float> st;  ///< height x width x 2, row by row
};

/// What both functions below promise: the map of a position that they use is within this distance,
/// in pixels of the result, of the pixel's center, up to the rounding of single precision. Not at
/// points where a map's derivative is infinite, such as sharp corners of angle maps.
inline constexpr double kUnwarpAccuracy = 0.01;

using RowProgress = std::function<void(int done, int all)>;

/// The ST-map of a scene in its own pose, or at a time on its timeline in seconds. Where the
/// picture overlaps itself, the part that is drawn on top counts. The picture's size is in pixels;
/// `scale` is in ST-map pixels per picture pixel. Calls `progress` on the calling thread with the
/// number of rows that have been started and the number of all rows. An exception from `progress`
/// ends the computation and is rethrown. Throws Error if the cage or the picture is missing. Cost:
/// the linear pieces of the map, and about 10 ns per pixel.
StMap st_map_of(
    const Scene& scene, int picture_width, int picture_height, double scale = 1,
    std::optional<double> time = {}, const RowProgress& progress = [](int, int) {});

/// Maps a picture of the posed scene back to rest: the result shows at z what `picture` shows at
/// f(z). Nothing is drawn outside the cage. Calls `progress` with 0 rows from time to time, so that
/// an exception can end the computation. Throws Error if the cage or the picture is missing.
Image unwarped(
    const Scene& scene, const Image* picture, double scale = 1, std::optional<double> time = {},
    const RowProgress& progress = [](int, int) {});

}  // namespace holomorph
