// A cage cut into more segments, as the maps onto outlines need them, and what is known of it at
// points of its boundary.
#pragma once

#include "core/geometry/cage.h"
#include "core/geometry/polyline.h"

namespace holomorph {

/// Increasing parameters for each segment of a cage.
using Cuts = std::vector<std::vector<double>>;

/// The parameters at arc lengths of the flattened cage, whose points `line` has.
Cuts cuts_at(const Cage& cage, const FlatCage& flat, const Polyline& line,
             std::vector<double> lengths);

/// The cage cut there. All its own vertices are kept; pieces are longer than `least` of their
/// segment.
Cage cut(const Cage& cage, const Cuts& cuts, double least);

/// Cauchy coordinates at points of the boundary, by the faster path where it is as exact.
MatrixXc coordinates_at(const Cage& cage, std::span<const BoundaryPoint> points, int order);

}  // namespace holomorph
