// The scale is a ratio of lengths, because lengths do not depend on how far the boundary turns. A
// least-squares fit of the vertices would depend on it (DECISIONS).
#include "core/angles/angle_frame.h"

#include <algorithm>

#include "core/error.h"

namespace holomorph {
namespace {

/// Places the same number of samples on each segment, beginning at its start.
std::vector<BoundaryPoint> samples_along(const Cage& cage) {
  const Index per_segment = std::clamp<Index>(160 / cage.size(), 2, 8);
  std::vector<BoundaryPoint> places;
  for (Index e = 0; e < cage.size(); ++e)
    for (Index k = 0; k < per_segment; ++k)
      places.push_back({e, static_cast<double>(k) / static_cast<double>(per_segment)});
  return places;
}

Points at(const Cage& cage, const std::vector<BoundaryPoint>& places) {
  Points points;
  for (const BoundaryPoint& place : places) points.push_back(position_of(cage, place));
  return points;
}

Complex mean_of_vertices(const Points& along, const std::vector<BoundaryPoint>& places) {
  Complex sum = 0;
  for (size_t i = 0; i < along.size(); ++i)
    if (places[i].t == 0) sum += along[i];
  return sum / static_cast<double>(places.back().segment + 1);
}

}  // namespace

AngleFrame::AngleFrame(const Mesh& mesh, std::shared_ptr<const HilbertCoordinates> coordinates,
                       Precision precision)
    : samples_(samples_along(coordinates->cage())),
      boundary_(mesh, coordinates, at(coordinates->cage(), samples_), precision) {}

PlacedAngles AngleFrame::place(const VectorXd& theta, const Cage& pose) {
  constexpr double kLeastScale = 1e-6;  // used if the cage collapses to a point
  VectorXc f;
  boundary_.map(theta, f);
  const Points image(f.begin(), f.end()), target = at(pose, samples_);
  PlacedAngles placed{theta};
  placed.scale = std::max(perimeter(target) / perimeter(image), kLeastScale);
  placed.move =
      mean_of_vertices(target, samples_) - placed.scale * mean_of_vertices(image, samples_);
  if (!std::isfinite(placed.scale) || !is_finite(placed.move))
    throw Error(ErrorKind::bad_input,
                "the angles bend the picture so far that coordinates are not finite; turn the "
                "corners less");
  return placed;
}

}  // namespace holomorph
