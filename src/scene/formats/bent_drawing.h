// SVG drawings whose curves follow a map.
#pragma once

#include <string>
#include <vector>

#include "core/maps/curve_images.h"
#include "core/maps/deformer.h"

namespace holomorph {

/// What an SVG drawing becomes.
struct BentDrawing {
  std::string group;                     ///< the element <g> with everything that is drawn
  double width = 0, height = 0;          ///< of the drawing at rest: its own size
  int columns = 0, rows = 0;             ///< of the picture that stands for it
  std::vector<std::string> losses = {};  ///< such as "its animation is left out"
};

struct BendingOptions {
  Complex upper_left = 0;   ///< the point of the map's plane that gets the coordinates 0, 0
  double tolerance = 0.05;  ///< how far curves may be from their exact images, in the map's units
  std::string prefix = {};  ///< put before all ids, so that drawings can be put together
};

/// Bends a drawing. `map` takes the plane of the picture that stands for it (y up, in pixels) to
/// another plane; its values must be finite. Shapes and clipping paths become paths of cubics; see
/// curve_images(). What is relative to a shape's own coordinates follows the map's average
/// derivative over the shape: strokes, gradients, patterns and filters. So do texts and embedded
/// pictures as a whole. Copies (`use`) become groups, or shapes in clipping paths. What extends
/// beyond the drawing's page is cut off, as in the picture. The coordinates have y down. Scripts,
/// animation and references to other files are left out. Throws Error{bad_input} if this is not a
/// drawing, or if it has more than 200,000 elements or 500,000 curves with all copies.
BentDrawing bent_drawing(const std::string& svg, const std::string& name, const PointValues& map,
                         const BendingOptions& options);

}  // namespace holomorph
