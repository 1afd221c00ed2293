// The images of Bezier curves under a map, as cubics.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/maps/deformer.h"

namespace holomorph {

/// For each Bezier curve of degree 1 to 3, the control points of cubics that follow one another.
/// Their ends lie on the curve's image and have its tangents, so that smooth curves stay smooth.
/// Between them each is within `tolerance` of the image, as far as samples and the tangents there
/// tell, which includes one kink between two samples. A piece has at least seven samples, and one
/// every 100 tolerances of its length at rest, but no more than 255. If the map is affine, a curve
/// has a single cubic, which is exact. Pieces are halved up to 20 times; where the map jumps, the
/// shortest pieces bridge the gap. `map` is called for many curves at once, about as often as the
/// pieces are halved. Cost: the samples of each piece that is tried, at most 2^20 and 40 for each
/// curve. When these are used up, the remaining pieces of all curves are kept as they are.
std::vector<std::vector<Points>> curve_images(const std::vector<Points>& curves,
                                              const PointValues& map, double tolerance);

}  // namespace holomorph
