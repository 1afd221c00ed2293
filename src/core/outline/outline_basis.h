// Cuts a cage into more segments for the maps onto outlines, and computes Cauchy coordinates at
// points of its boundary.
#pragma once

#include "core/geometry/cage.h"
#include "core/geometry/polyline.h"

namespace holomorph {

/// Increasing parameters for each segment of a cage.
using Cuts = std::vector<std::vector<double>>;

/// The cage's parameters at arc lengths along the flattened cage. `line` has the points of `flat`.
Cuts cuts_at(const Cage& cage, const FlatCage& flat, const Polyline& line,
             std::vector<double> lengths);

/// The cage cut at these parameters. The cage's vertices are kept. A cut is skipped if it would
/// leave a piece whose parameter range is at most `least`.
Cage cut(const Cage& cage, const Cuts& cuts, double least);

/// Cauchy coordinates at points of the boundary, computed by the faster method where it is equally
/// accurate.
MatrixXc coordinates_at(const Cage& cage, std::span<const BoundaryPoint> points, int order);

}  // namespace holomorph
