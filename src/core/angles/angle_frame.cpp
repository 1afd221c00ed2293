// The scale is a ratio of lengths, because lengths do not depend on how far the boundary turns. A
// least-squares fit of the vertices would depend on it: its scale becomes negative when corners
// turn one end of a bar by half a turn.
#include "core/angles/angle_frame.h"

#include <algorithm>

#include "core/error.h"

namespace holomorph {
namespace {

/// Places the same number of samples on each segment, beginning at its start.
std::vector<BoundaryPoint> places_along(const Cage& cage) {
  const Index per_segment = std::clamp<Index>(160 / cage.size(), 2, 8);
  std::vector<BoundaryPoint> places;
  for (Index e = 0; e < cage.size(); ++e)
    for (Index k = 0; k < per_segment; ++k)
      places.push_back({e, static_cast<double>(k) / static_cast<double>(per_segment)});
  return places;
}

}  // namespace

AngleFrame::AngleFrame(const Cage& cage) : cage_(cage), places_(places_along(cage)) {}

Points AngleFrame::at(const Cage& cage) const {
  Points points;
  for (const BoundaryPoint& place : places_) points.push_back(position_of(cage, place));
  return points;
}

Complex AngleFrame::mean_of_vertices(const Points& along) const {
  Complex sum = 0;
  for (size_t i = 0; i < along.size(); ++i)
    if (places_[i].t == 0) sum += along[i];
  return sum / static_cast<double>(cage_.size());
}

Points AngleFrame::samples() const {
  return at(cage_);
}

PlacedAngles AngleFrame::place(const VectorXd& theta, const VectorXc& image,
                               const Cage& pose) const {
  constexpr double kLeastScale = 1e-6;  // used if the cage collapses to a point
  const Points from(image.begin(), image.end()), to = at(pose);
  PlacedAngles placed{theta};
  placed.scale = std::max(perimeter(to) / perimeter(from), kLeastScale);
  placed.move = mean_of_vertices(to) - placed.scale * mean_of_vertices(from);
  if (!std::isfinite(placed.scale) || !is_finite(placed.move))
    throw Error(ErrorKind::bad_input,
                "the angles bend the picture so far that coordinates are not finite; turn the "
                "corners less");
  return placed;
}

}  // namespace holomorph
