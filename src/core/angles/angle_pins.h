// Pins on a map by boundary angles: the nearest angles, size and place that take them to their
// targets, without a fold on the way (what Weber, Gotsman 2010, sec. 7 leave open).
#pragma once

#include "core/angles/angle_frame.h"

namespace holomorph {

class AnglePins {
 public:
  /// Of a counter-clockwise cage with these corners. Pins must be different points inside.
  AnglePins(const Mesh& mesh, std::shared_ptr<const HilbertCoordinates> coordinates,
            std::vector<Index> corners, std::vector<RestPin> pins);

  struct Answer {
    int iterations = 0;
    bool settled = true;
    double missed = 0;           ///< the farthest that a pin is from its target
    std::vector<Index> limited;  ///< corners, by vertex, that came to the least angle
  };
  /// Changes `placed` by Gauss and Newton's method, jumps and bends held back; a pin that turns
  /// prescribes f' there. `draft` starts from the last answer and takes a few steps. Cost of a
  /// step: as many integrals along the ways to the pins as there are angles.
  Answer pull(const std::vector<PosePin>& targets, bool draft, PlacedAngles& placed);

 private:
  /// What is off at unknowns x, and by what it changes with each of them.
  struct Linear {
    VectorXd off;
    MatrixXd by;
    double missed = 0;
  };
  Linear linear_at(const VectorXd& x, const std::vector<PosePin>& targets);
  /// How far the angles' jump at a corner may go.
  double room(size_t corner) const;

  std::shared_ptr<const HilbertCoordinates> coordinates_;
  std::vector<Index> corners_;
  std::vector<RestPin> pins_;
  double size_;
  AngleMap map_;
  MatrixXc rows_;           ///< of H at pins that turn
  MatrixXd softness_;       ///< inverse of how angles, size and place are held back
  VectorXd last_;           ///< unknowns of the last answer
  std::vector<char> held_;  ///< corners at the least angle
};

}  // namespace holomorph
