// Maps a posed picture back to rest.
#pragma once

#include "raster/raster.h"
#include "raster/st_map.h"
#include "scene/scene.h"

namespace holomorph {

/// Maps a picture of the posed scene back to rest: the result shows at z what `picture` shows at
/// f(z), to within kStAccuracy. Nothing is drawn outside the cage. Calls `progress` with 0 rows
/// from time to time, so that an exception can end the computation. Throws Error if the cage or the
/// picture is missing.
Image unwarped(
    const Scene& scene, const Image* picture, double scale = 1, std::optional<double> time = {},
    const RowProgress& progress = [](int, int) {});

}  // namespace holomorph
