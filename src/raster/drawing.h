// Rasterizes the triangles and silhouettes of one job. Bands of rows are drawn independently.
#pragma once

#include "raster/raster.h"

namespace holomorph {

/// Draws a job into a picture of `width` x `height` pixels whose top left corner is the plane point
/// (left, top).
Image drawn(const RasterJob& job, double left, double top, int width, int height);

}  // namespace holomorph
