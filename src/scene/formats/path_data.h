// The path data of SVG files: SVG 2, chapter 9.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"

namespace holomorph {

/// A connected part of a path.
struct Subpath {
  Complex start;
  /// The control points of each segment, with both ends: 2, 3 or 4 points. Elliptic arcs are
  /// cubics.
  std::vector<Points> segments = {};
  bool closed = false;  ///< with a line back to the start, which is not among the segments

  Complex end() const { return segments.empty() ? start : segments.back().back(); }
};

struct PathData {
  std::vector<Subpath> subpaths = {};
  std::string problem = {};  ///< what is wrong, and where; empty if everything was read
};

/// Reads path data up to the first mistake. Coordinates are as in the file, with y down.
PathData path_data_of(const std::string& text);

/// Cubics for the elliptic arc between two points, from its endpoint parameterization (SVG 2,
/// appendix B.2.4), each of at most 45 degrees. They are within 5e-6 of the larger radius.
/// `rotation` is in degrees. Without a radius, the arc is a line.
std::vector<Points> arc_cubics(Complex from, Complex to, double rx, double ry, double rotation,
                               bool large, bool sweep);

}  // namespace holomorph
