// The folds of a picture that can be seen: where the picture is opaque enough, and large enough.
#pragma once

#include <memory>

#include "core/mesh/mesh.h"
#include "scene/formats/image.h"
#include "scene/live_map.h"

namespace holomorph {

/// A visible fold: a region of flipped triangles, or the surroundings of a branch point.
struct Fold {
  Complex at;                       ///< posed
  double radius = 0;                ///< of the region, posed, in plane units
  std::vector<int> triangles = {};  ///< those that are flipped and visible
};

/// For each triangle, 1 if some of the picture in it is visible: if its alpha is above 5 % at one
/// of several points. Everything is visible without a picture. Cost: linear.
std::vector<char> visible_triangles(const Mesh& mesh, const Image* picture);

/// The visible folds of the map that takes the mesh's vertices to f, the largest first. A region
/// counts if its visible triangles cover more than a pixel of the export at scale 1. `visible` is
/// the result of visible_triangles. Cost: linear.
std::vector<Fold> visible_folds(const Mesh& mesh, const VectorXc& f,
                                const std::vector<char>& visible);

/// Finds the visible folds of a map, and remembers them until the map changes.
class FoldFinder {
 public:
  const std::vector<Fold>& folds(const LiveMap& map, const std::shared_ptr<const Image>& picture);

 private:
  void find(const LiveMap& map);

  std::vector<Fold> folds_;
  std::shared_ptr<const Mesh> mesh_;
  std::shared_ptr<const Image> picture_;
  std::vector<char> visible_;
  VectorXc f_;  ///< the map whose folds are known
};

}  // namespace holomorph
