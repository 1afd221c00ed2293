// How a displayed picture gets from the last draft of a drag to the final map.
#pragma once

#include "scene/live_map.h"

namespace holomorph {

/// Where a final map is not where the last draft was, the picture fades over to it instead of
/// jumping, unless a triangle of the mesh would be flipped on the way.
class Settling {
 public:
  /// The positions of the mesh's vertices to show at a time in milliseconds.
  const VectorXc& positions(const LiveMap& map, double now);
  /// Whether a fade is in progress.
  bool moves() const { return from_.size() > 0; }

 private:
  bool fades_to(const LiveMap& map) const;

  unsigned preparation_ = 0, revision_ = 0;  ///< of the map whose positions are shown
  bool was_draft_ = false;
  VectorXc shown_, from_;  ///< from_: where the fade began; empty: there is none
  double start_ = 0;
};

}  // namespace holomorph
