// Reads and writes cages as SVG files. A cage is one path, with a subpath for each loop.
#pragma once

#include <string>

#include "scene/scene.h"

namespace holomorph {

/// The purpose for which a path is read. The end tangents of a rest curve's segments must not
/// vanish. Lines of length zero are therefore left out, and a tangent handle that coincides with
/// its point is moved a thousandth of the way to the next control point. Rest and pose need at
/// least three segments.
enum class PathUse { rest, pose, outline };

/// Reads a path of an SVG file as a cage in plane coordinates: y = height - y_svg. `height` is the
/// height of the picture; if it is not positive, the drawing's height is used. Reads the path with
/// the id "rest", "pose" or "outline", or the first path if there is none. Arcs become cubics. Each
/// subpath must be closed, or it is closed with a line. Subpaths inside others become their holes,
/// and those next to others, or in their holes, become parts; an outline has a single subpath. In a
/// pose, the subpaths are the loops of `rest` in order, if it has the same number. Throws
/// Error{bad_input} with the reason and the position if the file has no path, or if the path has
/// transforms or damaged numbers.
Cage cage_of_svg(const std::string& text, const std::string& name, double height,
                 PathUse use = PathUse::rest, const Cage* rest = nullptr);

/// An SVG drawing of the cage, with the size of the picture. The posed cage is the path "pose". If
/// the rest cage is different, it is the dashed path "rest". Pins are circles. cage_of_svg can read
/// both cages back, up to rounding. Segments of a degree above three are approximated by several
/// cubics, to within 1e-4 of the segment's size. The corresponding segments of the other cage are
/// split into the same number of pieces.
std::string svg_of(const Deformation& deformation, const std::optional<ImageReference>& image);

}  // namespace holomorph
