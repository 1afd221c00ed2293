// The disk that a pin with a frame acts on, in methods that prescribe points.
#pragma once

#include "core/geometry/polygon.h"
#include "core/maps/rest.h"

namespace holomorph {

/// The radius of a pin's disk: its own, or 3 % of the diagonal of the cage.
double held_radius(const Cage& cage, const RestPin& pin);

/// Whether a straight line from a to b, both inside, crosses no edge of the outline.
bool sees(PolygonView outline, Complex a, Complex b);

/// Points of a pin's disk, the pin first: rings of points that are about as far apart as the rings
/// are. Only points that a straight line inside the cage connects to the pin belong to the disk, so
/// a disk that reaches over a gap does not hold what is behind it. At most 91 points.
Points held_disk(const Cage& cage, const RestPin& pin);

}  // namespace holomorph
