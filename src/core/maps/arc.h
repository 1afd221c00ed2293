// Pieces of a cage's boundary, as they lie between neighboring boundary vertices of a mesh.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// A straight line segment in a map's domain, or a part of one of the boundary's segments.
struct Arc {
  Complex from, to;
  Index segment = -1;         ///< if negative, the arc is straight
  double start = 0, end = 1;  ///< parameters on the segment
};

/// The point at `fraction` of an arc, 0 to 1, and the two arcs into which this point divides it.
Complex point_on(const Cage& cage, const Arc& arc, double fraction);
std::array<Arc, 2> cut_arc(const Cage& cage, const Arc& arc, double fraction);

/// For each entry of the mesh's boundary, the arc from that vertex to the next one. `cage` must be
/// oriented.
std::vector<Arc> boundary_arcs(const Cage& cage, const Mesh& mesh);

}  // namespace holomorph
