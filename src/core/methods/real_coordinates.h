// Maps f = sum h_c b_c with one real function h_c for each control point b_c of a cage.
#pragma once

#include "core/maps/deformer.h"
#include "core/methods/linear.h"

namespace holomorph {

/// Real coordinates of an oriented cage: they sum to 1 and reproduce z.
class RealCoordinates {
 public:
  virtual ~RealCoordinates() = default;
  /// h at points: points x control points.
  virtual MatrixXd values(std::span<const Complex> points) const = 0;
  /// h_x - i h_y at points: points x control points.
  virtual MatrixXc slopes(std::span<const Complex> points) const = 0;
};

/// The coordinates of an oriented cage that are harmonic functions, and mean value coordinates.
std::unique_ptr<RealCoordinates> harmonic_coordinates(const Cage& cage);
std::unique_ptr<RealCoordinates> mean_value_coordinates(const Cage& cage);

/// Creates a linear deformer for a rest. `coordinates` must belong to the rest's cage, oriented.
std::unique_ptr<Deformer> real_deformer(const Rest& rest,
                                        std::shared_ptr<const RealCoordinates> coordinates);

/// The Bernstein weights of the control points at boundary points of a cage: points x controls.
MatrixXd weights_at(const Cage& cage, std::span<const BoundaryPoint> places);

}  // namespace holomorph
