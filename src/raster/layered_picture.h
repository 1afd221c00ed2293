// Draws a scene layer by layer, for files with layers.
#pragma once

#include <functional>

#include "raster/picture.h"
#include "scene/formats/layered.h"

namespace holomorph {

/// The posed layers of a scene, hidden ones too, and the picture that they make together. The
/// original pictures lie behind them, if they are the background. Arguments and errors are
/// those of picture_of(). The view in `options` is ignored. If `keeps_drawings` is set, layers of
/// SVG files in `other_pictures` are bent drawings; see layer_drawing(). Calls `keep_going` on this
/// thread from time to time; an exception from it ends the work and is rethrown.
LayeredPicture layered_picture_of(
    const Scene& scene, const Image* source, const PictureOptions& options,
    const Pictures& other_pictures, bool keeps_drawings = false,
    const std::function<void()>& keep_going = [] {});

}  // namespace holomorph
