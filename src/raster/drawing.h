// One drawing: triangles and silhouettes in output pixels, bands of rows drawn independently.
#pragma once

#include "raster/raster.h"

namespace holomorph {

/// Draws a job into a picture of `width` x `height` pixels whose top left corner is the plane point
/// (left, top).
Image drawn(const RasterJob& job, double left, double top, int width, int height);

}  // namespace holomorph
