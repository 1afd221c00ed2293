// Cages to and from SVG files: a closed loop of Bezier segments is one path.
#pragma once

#include <string>

#include "scene/scene.h"

namespace holomorph {

/// What a path is read for. As a rest curve it must not stop: lines without length are left out,
/// and a tangent handle that lies on its point is pulled a thousandth of the way to the next
/// control point. Rest and pose have three segments at least.
enum class PathUse { rest, pose, outline };

/// A path of an SVG file as a loop in plane coordinates: y = height - y_svg, with the picture's
/// height, or the file's own when `height` is not positive. It is the path whose id is "rest",
/// "pose" or "outline", else the first. M L H V C S Q T Z, absolute and relative, one closed or
/// closable subpath. Throws Error{bad_input}, naming what and where, for files without a path, with
/// transforms, with arcs, with several subpaths, and with damaged numbers.
Cage cage_of_svg(const std::string& text, const std::string& name, double height,
                 PathUse use = PathUse::rest);

/// The cage over a drawing of the picture's size: the posed one as the path "pose", the one at
/// rest, where it differs, dashed as "rest", pins as circles. cage_of_svg reads both back to
/// rounding; segments of a degree above three, and their counterparts, become several that are at
/// most cubic and follow them to 1e-4 of their size.
std::string svg_of(const Deformation& deformation, const std::optional<ImageReference>& image);

}  // namespace holomorph
