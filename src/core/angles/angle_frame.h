// Boundary angles determine a conformal map up to scale and translation. AngleFrame chooses both to
// fit the map to a posed cage.
#pragma once

#include "core/angles/angle_map.h"

namespace holomorph {

/// An angle map with its scale and translation: f = scale F(theta) + move, where F is
/// AngleMap::map.
struct PlacedAngles {
  VectorXd theta;
  double scale = 1;
  Complex move = 0;
};

class AngleFrame {
 public:
  AngleFrame(const Mesh& mesh, std::shared_ptr<const HilbertCoordinates> coordinates,
             Precision precision);

  /// The scale makes the image of the boundary as long as the posed cage. The translation makes the
  /// images of the cage's vertices have the same mean as the posed vertices. theta is in radians;
  /// `pose` must be counter-clockwise. Throws Error if the angles bend the boundary too far for a
  /// finite result.
  PlacedAngles place(const VectorXd& theta, const Cage& pose);

 private:
  std::vector<BoundaryPoint> samples_;  ///< samples along the boundary, vertices included
  AngleMap boundary_;
};

}  // namespace holomorph
