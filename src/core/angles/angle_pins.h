// Pins on an angle map. AnglePins changes the boundary angles, scale and translation as little as
// possible to take the pins to their targets. The map does not fold at any step. Weber, Gotsman
// 2010 leave this problem open (sec. 7).
#pragma once

#include "core/angles/angle_frame.h"

namespace holomorph {

class AnglePins {
 public:
  /// The cage of the coordinates must be counter-clockwise and have these corners. The pins must be
  /// distinct points inside it.
  AnglePins(const Mesh& mesh, std::shared_ptr<const HilbertCoordinates> coordinates,
            std::vector<Index> corners, std::vector<RestPin> pins);

  struct Answer {
    int iterations = 0;
    bool settled = true;
    double largest_miss = 0;     ///< the largest distance of a pin from its target
    std::vector<Index> limited;  ///< vertex indices of corners held at the smallest angle
    VectorXd unknowns;           ///< angles, logarithm of the scale, and translation
  };
  /// Changes `placed` by Gauss-Newton steps that penalize jumps and bends of the angles. A pin with
  /// a frame also prescribes f' at its position. With `draft`, the iteration takes only a
  /// few steps, and starts from the unknowns of an earlier answer unless `from` is null. Cost of a
  /// step: one integration per angle along the paths to the pins.
  Answer pull(const std::vector<PosePin>& targets, bool draft, const VectorXd* from,
              PlacedAngles& placed);

 private:
  /// The residuals (target minus value) at unknowns x, and the Jacobian of the values.
  struct Linear {
    VectorXd off;
    MatrixXd by;
    double largest_miss = 0;
  };
  Linear linear_at(const VectorXd& x, const std::vector<PosePin>& targets);
  /// The largest allowed jump of the angles at a corner.
  double largest_jump(size_t corner) const;

  std::shared_ptr<const HilbertCoordinates> coordinates_;
  std::vector<Index> corners_;
  std::vector<RestPin> pins_;
  double size_;
  AngleMap map_;
  MatrixXc rows_;             ///< H at the pins with a frame
  MatrixXd inverse_penalty_;  ///< inverse of the penalty on angles, scale and translation
  std::vector<char> held_;    ///< which corners are held at the smallest angle
};

}  // namespace holomorph
