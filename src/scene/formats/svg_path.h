// Cages as SVG files: a closed loop of Bezier segments is one path.
#pragma once

#include <string>

#include "scene/scene.h"

namespace holomorph {

/// What a path is read as. A rest curve must not have vanishing end tangents: lines of length zero
/// are left out, and a tangent handle that coincides with its point is moved a thousandth of the
/// way to the next control point. Rest and pose need at least three segments.
enum class PathUse { rest, pose, outline };

/// Reads a path of an SVG file as a loop in plane coordinates: y = height - y_svg, with the height
/// of the picture, or of the file if `height` is not positive. It is the path whose id is "rest",
/// "pose" or "outline", or else the first path. The commands are M L H V C S Q T Z, absolute and
/// relative, with a single subpath that is closed or can be closed. Throws Error{bad_input} saying
/// what is wrong and where, for files without a path and for paths with transforms, arcs, several
/// subpaths or damaged numbers.
Cage cage_of_svg(const std::string& text, const std::string& name, double height,
                 PathUse use = PathUse::rest);

/// An SVG drawing of the cage, of the picture's size. The posed cage is the path "pose", the rest
/// cage, if it differs, is the dashed path "rest", and pins are circles. cage_of_svg reads both
/// cages back up to rounding. Segments of a degree above three, and their counterparts, are split
/// into segments that are at most cubic and follow them to 1e-4 of their size.
std::string svg_of(const Deformation& deformation, const std::optional<ImageReference>& image);

}  // namespace holomorph
