// The mesh's boundary vertices lie on the cage up to rounding.
#include "core/maps/arc.h"

#include "core/geometry/contact.h"

namespace holomorph {

Complex point_on(const Cage& cage, const Arc& arc, double fraction) {
  if (fraction == 0) return arc.from;
  if (fraction == 1) return arc.to;
  if (arc.segment < 0) return (1 - fraction) * arc.from + fraction * arc.to;
  return position_of(cage, {arc.segment, (1 - fraction) * arc.start + fraction * arc.end});
}

std::array<Arc, 2> cut_arc(const Cage& cage, const Arc& arc, double fraction) {
  const Complex middle = point_on(cage, arc, fraction);
  const double parameter = (1 - fraction) * arc.start + fraction * arc.end;
  return {Arc{arc.from, middle, arc.segment, arc.start, parameter},
          Arc{middle, arc.to, arc.segment, parameter, arc.end}};
}

std::vector<Arc> boundary_arcs(const Cage& cage, const Mesh& mesh) {
  constexpr double kOnCurve = 8;  // the boundary's distance from its curve, in rounding errors
  std::vector<SegmentPolynomial> segments;
  for (Index e = 0; e < cage.size(); ++e) segments.emplace_back(cage.controls(e));
  const Loops loops = mesh.boundary_loops();
  std::vector<Arc> arcs;
  for (size_t i = 0; i < mesh.boundary.size(); ++i) {
    const int v = mesh.boundary[i],
              next = mesh.boundary[static_cast<size_t>(loops.next(static_cast<Index>(i)))];
    Arc arc{mesh.vertices[v], mesh.vertices[next]};
    const auto from = contact_of(segments, arc.from, kOnCurve),
               to = contact_of(segments, arc.to, kOnCurve);
    if (from && to && !segments[static_cast<size_t>(from->segment)].is_straight()) {
      const bool ends = to->is_vertex();
      arc = {arc.from, arc.to, from->segment, from->s, ends ? 1 : to->s};
    }
    arcs.push_back(arc);
  }
  return arcs;
}

}  // namespace holomorph
