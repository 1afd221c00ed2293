// ST-maps: arrays of positions in another picture, with which compositing programs repeat a warp.
#pragma once

#include <functional>
#include <optional>

#include "scene/formats/exr.h"
#include "scene/formats/image.h"
#include "scene/timed_map.h"

namespace holomorph {

struct StMapOptions {
  /// If not set, each pixel of the posed picture gets its position in the picture at rest. If set,
  /// each pixel at rest gets its position in the posed picture.
  bool unwarps = false;
  double scale = 1;                 ///< pixels of the ST-map per pixel of the picture
  int overscan = 0;                 ///< pixels of the ST-map beyond each side of the picture
  std::optional<double> time = {};  ///< seconds on the timeline; if not set, the scene's pose
};

/// For each pixel, the position (s, t) of the point that it shows. As is usual in compositing
/// programs, s points right and t points up, and both run from 0 to 1 across the picture's
/// rectangle; points outside of it have other values. Rows are stored from the top.
struct StMap {
  int width = 0, height = 0;  ///< including the overscan
  int overscan = 0;
  std::vector<float> st;        ///< height x width x 2; NaN where the picture has moved away
  std::vector<float> coverage;  ///< height x width; see st_map_of
};

/// What ST-maps and unwarped pictures promise, in pixels of the result and up to the rounding of
/// single precision: the map takes each position to within this distance of the pixel's center or,
/// if the ST-map unwarps, each position is this close to the image of the pixel's center. Not at
/// points where a map's derivative is infinite, such as sharp corners of angle maps.
inline constexpr double kStAccuracy = 0.01;

using RowProgress = std::function<void(int done, int all)>;

/// An ST-map of a scene's edited layer and its picture. Where the posed picture overlaps itself,
/// the part that is drawn on top counts, unless it is less than half opaque and the part beneath is
/// more opaque. Otherwise, the transparent margin of a raised arm would cut a hole in the head
/// behind it. Outside the cage nothing moves. `coverage` is the share of each pixel that shows
/// points of the picture's rectangle, in 16ths. Calls `progress` on the calling thread with the
/// number of rows that have been started and the number of all rows. An exception from `progress`
/// ends the computation and is rethrown. Throws the errors of check_map_size. Cost: the linear
/// pieces of the map, and about 20 ns per pixel.
StMap st_map_of(
    TimedMap& map, const Image& picture, const StMapOptions& options = {},
    const RowProgress& progress = [](int, int) {});

/// Gives pixels without a position that of the nearest pixel with one, so that all positions are
/// finite and filters near edges find no gaps. Cost: about 100 ns per pixel.
void extend(StMap& map);

/// The usual order of channels in compositing programs: s is red, t is green, coverage is alpha.
/// Blue is the coverage, too, because Blender's node Map UV takes it from there.
FloatImage float_image_of(StMap map);

/// Throws Error if the page of the picture is empty, the scale is not above 0, the overscan is
/// negative, or the result has more than 16384 pixels on a side.
void check_map_size(double scale, const Box& page, int overscan = 0);

}  // namespace holomorph
