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
  explicit AngleFrame(const Cage& cage);

  /// Points along the boundary, the vertices among them.
  Points samples() const;
  /// The scale makes the image of the boundary as long as the posed cage. The translation makes the
  /// images of the cage's vertices have the same mean as the posed vertices. theta is in radians,
  /// and `image` is where AngleMap::map takes the samples for theta; `pose` must be
  /// counter-clockwise. Throws Error if the angles bend the boundary too far for a finite result.
  PlacedAngles place(const VectorXd& theta, const VectorXc& image, const Cage& pose) const;

 private:
  Points at(const Cage& cage) const;
  Complex mean_of_vertices(const Points& along) const;

  Cage cage_;
  std::vector<BoundaryPoint> places_;
};

}  // namespace holomorph
