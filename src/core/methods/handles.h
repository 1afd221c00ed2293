// What methods that know nothing of cages hold on to: points of the rest and their places.
#pragma once

#include "core/geometry/similarity.h"
#include "core/maps/deformer.h"

namespace holomorph {

/// Handle points of a rest: its pins, those that turn with two points beside them; without any pin
/// the cage's vertices.
class HandlePoints {
 public:
  explicit HandlePoints(const Rest& rest);

  /// At rest; only those inside the mesh.
  const Points& rest() const { return rest_points_; }
  /// The mesh's triangles that they are in.
  const std::vector<Location>& locations() const { return locations_; }
  /// Where a pose wants them. Throws Error as check_pose does.
  Points targets(const Pose& pose) const;
  /// The turn and move that takes all handles to their places at once, if there is one, to
  /// rounding; at rest the identity to the last bit.
  std::optional<Similarity> rigid(const Points& targets) const;
  /// "Pin 3 lies outside the cage and holds nothing", or nothing.
  const std::string& note() const { return note_; }

 private:
  void add(Complex z, Index source, Complex arm);

  const Rest& rest_;
  Points rest_points_;
  std::vector<Location> locations_;
  struct Source {
    Index handle;  ///< pin or cage vertex
    Complex arm;   ///< from the handle, at rest
  };
  std::vector<Source> sources_;
  bool pins_ = false;
  std::string note_;
};

}  // namespace holomorph
