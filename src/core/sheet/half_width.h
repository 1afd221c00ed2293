// How wide the picture is around a point: the local half width.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// The largest radius of a disk inside the outline that contains a point, which is half of the
/// width of the limb or the body around it (local thickness). Unlike the distance from the outline,
/// it does not fall toward the edge of a limb, only into corners, where it is 0.
class HalfWidth {
 public:
  /// Disks have their centers at the vertices and in the triangles of the mesh, so that radii may
  /// be too small by up to the length of an edge. Cost: triangles times edges of the outline.
  explicit HalfWidth(const Mesh& mesh);

  /// At a point inside the outline, or on it. Cost: linear in the number of disks that are kept.
  double at(Complex z, double reach = 1.05) const;

 private:
  struct Disk {
    Complex center;
    double radius = 0;
  };
  std::vector<Disk> disks_;  ///< the largest first, without those inside larger ones
};

}  // namespace holomorph
