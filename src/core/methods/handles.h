// The handles of methods that use no cage coordinates: points of the rest and their targets.
#pragma once

#include "core/geometry/similarity.h"
#include "core/maps/rest.h"
#include "core/mesh/mesh.h"

namespace holomorph {

/// The rigid motion that takes points to others up to rounding, or nothing if none exists. If the
/// points are the same, it is exactly the identity.
std::optional<Similarity> rigid_motion(const Points& from, const Points& to);

/// The handle points of a rest are its pins, and the points of the disks of pins with a frame. If
/// none of them lies in the mesh, the handle points are the vertices of the cage. If cage vertices
/// were always held, a cage around a picture with pins would fix the picture's outline in place.
class HandlePoints {
 public:
  explicit HandlePoints(const Rest& rest);

  /// Positions at rest. Points outside the mesh are left out.
  const Points& rest() const { return rest_points_; }
  /// Locations of the handle points in the mesh.
  const std::vector<Location>& locations() const { return locations_; }
  /// Targets of the handle points in a pose. Throws Error if check_pose does.
  Points targets(const Pose& pose) const;
  /// The rigid motion of all handles (rigid_motion).
  std::optional<Similarity> rigid(const Points& targets) const {
    return rigid_motion(rest_points_, targets);
  }
  /// Names the first pin outside the cage. Empty if all pins are inside.
  const std::string& note() const { return note_; }

 private:
  void add(Complex z, Index source, Complex arm);

  const Rest& rest_;
  Points rest_points_;
  std::vector<Location> locations_;
  struct Source {
    Index handle;  ///< index of the pin or cage vertex
    Complex arm;   ///< offset from the handle at rest
  };
  std::vector<Source> sources_;
  bool pins_ = false;
  std::string note_;
};

}  // namespace holomorph
