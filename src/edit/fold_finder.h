// The folds that can be seen in a picture: where it is opaque enough. Folds in transparent parts,
// or smaller than a pixel, are no reason for an alarm.
#pragma once

#include <memory>

#include "core/maps/visible_folds.h"
#include "scene/formats/image.h"
#include "scene/live_map.h"

namespace holomorph {

/// For each triangle, 1 if some of the picture in it is visible: if its alpha is above 5 % at one
/// of several points. Without a picture, everything is visible. Cost: linear.
std::vector<char> visible_triangles(const Mesh& mesh, const Image* picture);

/// Finds the visible folds of a map, and remembers them until the map changes.
class FoldFinder {
 public:
  const std::vector<Fold>& folds(const LiveMap& map, const std::shared_ptr<const Image>& picture);

 private:
  std::vector<Fold> folds_;
  std::shared_ptr<const Mesh> mesh_;
  std::shared_ptr<const Image> picture_;
  std::vector<char> visible_;
  VectorXc f_;  ///< the map whose folds are known
};

}  // namespace holomorph
