// Of all maps with given boundary angles, which one a posed cage means: its size and its place.
#pragma once

#include "core/angles/angle_map.h"

namespace holomorph {

/// f = scale F(theta) + move, with AngleMap's F.
struct PlacedAngles {
  VectorXd theta;
  double scale = 1;
  Complex move = 0;
};

class AngleFrame {
 public:
  AngleFrame(const Mesh& mesh, std::shared_ptr<const HilbertCoordinates> coordinates,
             Precision precision);

  /// The boundary's image is as long as the posed cage, which is counter-clockwise, and the means
  /// of both's vertices agree. Throws Error for angles that bend beyond all numbers.
  PlacedAngles place(const VectorXd& theta, const Cage& pose);

 private:
  std::vector<BoundaryPoint> places_;  ///< along the boundary, the vertices among them
  AngleMap boundary_;
};

}  // namespace holomorph
