// Curves are cut by de Casteljau's algorithm, which does not change their shape.
#include "core/outline/outline_basis.h"

#include <algorithm>

#include "core/cauchy/cauchy.h"
#include "core/cauchy/cauchy_array.h"

namespace holomorph {

Cuts cuts_at(const Cage& cage, const FlatCage& flat, const Polyline& line,
             std::vector<double> lengths) {
  Cuts cuts(static_cast<size_t>(cage.size()));
  std::ranges::sort(lengths);
  for (const double length : lengths) {
    const Polyline::Location at = line.location_at(length);
    const size_t i = static_cast<size_t>(at.segment), next = (i + 1) % flat.locations.size();
    const Index segment = flat.locations[i].segment;
    const double from = flat.locations[i].t,
                 to = flat.locations[next].segment == segment && flat.locations[next].t > from
                          ? flat.locations[next].t
                          : 1;
    cuts[static_cast<size_t>(segment)].push_back(from + at.parameter * (to - from));
  }
  for (std::vector<double>& locations : cuts) std::ranges::sort(locations);
  return cuts;
}

Cage cut(const Cage& cage, const Cuts& cuts, double least) {
  Cage fine;
  for (Index e = 0; e < cage.size(); ++e) {
    Points rest = cage.controls(e);
    double before = 0;
    for (const double t : cuts[static_cast<size_t>(e)]) {
      if (t - before <= least || 1 - t <= least) continue;
      SplitCurve halves = split(rest, (t - before) / (1 - before));
      halves.before.pop_back();
      fine.segments.push_back(std::move(halves.before));
      rest = std::move(halves.after);
      before = t;
    }
    rest.pop_back();
    fine.segments.push_back(std::move(rest));
  }
  return fine;
}

MatrixXc coordinates_at(const Cage& cage, std::span<const BoundaryPoint> points, int order) {
  if (order > 1 || !is_straight(cage)) return cauchy_coordinates(cage, points, order);
  Points plain;
  for (const BoundaryPoint& point : points) plain.push_back(position_of(cage, point));
  return as_complex(planar_coordinates<double>(cage, plain, order));
}

}  // namespace holomorph
