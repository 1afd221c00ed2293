// Cages from SVG files: the first path of a file as a closed loop of Bezier segments.
#pragma once

#include <string>

#include "core/cage.h"

namespace holomorph {

/// The path data of an SVG file as a loop in plane coordinates: y = height - y_svg, with the
/// picture's height, or the file's own when `height` is not positive. M L H V C S Q T Z, absolute
/// and relative, one closed or closable subpath. With `for_rest` a tangent handle that lies on its
/// point is pulled a thousandth of the way to the next control point: rest curves must not stop.
/// Throws Error{bad_input}, naming what and where, for files without a path, with transforms, with
/// arcs, with several subpaths, and with damaged numbers.
Cage cage_of_svg(const std::string& text, const std::string& name, double height,
                 bool for_rest = true);

}  // namespace holomorph
