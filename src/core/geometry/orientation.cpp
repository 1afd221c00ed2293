#include "core/geometry/orientation.h"

#include <algorithm>

namespace holomorph {

Orientation::Orientation(const Cage& rest) : starts_(rest.starts), size_(rest.size()) {
  const Polygon outline = outline_of(rest);
  const PolygonView view = outline;
  for (Index l = 0; l < view.loops().count(); ++l)
    if ((signed_area(view.loop(l)) > 0) == rest.is_hole(l)) backward_.push_back(l);
}

Cage Orientation::turned(const Cage& cage) const {
  Cage result = cage;
  for (const Index l : backward_) result = reversed(result, l);
  return result;
}

BoundaryPoint Orientation::turned(BoundaryPoint point) const {
  const Loops loops(size_, starts_);
  const Index l = loops.loop_of(point.segment);
  if (std::ranges::find(backward_, l) == backward_.end()) return point;
  const Index mirrored = loops.first(l) + loops.end(l) - 1 - point.segment;
  return point.t == 0 ? BoundaryPoint{loops.next(mirrored), 0}
                      : BoundaryPoint{mirrored, 1 - point.t};
}

std::vector<Index> Orientation::columns(const Cage& cage) const {
  Cage tagged = cage;
  Index c = 0;
  for (Points& segment : tagged.segments)
    for (Complex& z : segment) z = static_cast<double>(c++);
  const VectorXc order = controls_of(turned(tagged));
  std::vector<Index> column(static_cast<size_t>(c));
  for (Index i = 0; i < c; ++i) column[static_cast<size_t>(order[i].real())] = i;
  return column;
}

VectorXc Orientation::turned(const Cage& cage, const VectorXc& values) const {
  if (is_oriented()) return values;
  const std::vector<Index> column = columns(cage);
  VectorXc result(values.size());
  for (Index c = 0; c < values.size(); ++c) result[column[static_cast<size_t>(c)]] = values[c];
  return result;
}

Cage oriented(const Cage& cage) {
  return Orientation(cage).turned(cage);
}

}  // namespace holomorph
