// Motion between the maps of a method without folds.
#pragma once

#include <functional>

#include "core/bounded/log_inbetween.h"
#include "core/maps/deformer.h"

namespace holomorph {

/// What the methods without folds have to know for motion. All maps have the same basis.
struct MotionSetting {
  std::shared_ptr<const BoundaryBasis> basis;
  std::shared_ptr<const Mesh> mesh;
  std::vector<size_t> pins;  ///< the pins that act, and their positions at rest
  Points positions;
  /// The map that a solution stands for, or null for solutions of other deformers.
  std::function<const LogMap*(const Solution&)> map_of;
};

/// Cost: two matrices of mesh vertices x polygon vertices.
std::shared_ptr<const ProvedMotion> proved_motion(MotionSetting setting);

}  // namespace holomorph
