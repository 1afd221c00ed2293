// Maps f = sum h_c b_c with real functions h_c of a cage's control points.
#pragma once

#include "core/methods/linear.h"

namespace holomorph {

/// Real coordinates of a counter-clockwise cage: they add up to 1 and reproduce z.
class RealCoordinates {
 public:
  virtual ~RealCoordinates() = default;
  /// A row for each point: h as real parts, or h_x - i h_y with order 1.
  virtual MatrixXc at(std::span<const Complex> points, int order) const = 0;
};

/// The linear deformer of a rest with such coordinates of its cage, run through counter-clockwise.
std::unique_ptr<Deformer> real_deformer(const Rest& rest,
                                        std::shared_ptr<const RealCoordinates> coordinates);

/// Each control point's weight at places of a cage: Bernstein polynomials.
MatrixXd weights_at(const Cage& cage, std::span<const BoundaryPoint> places);

}  // namespace holomorph
