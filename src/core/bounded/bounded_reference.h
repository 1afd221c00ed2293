// What a map without folds follows: another method's map, looked at along the boundary and inside.
#pragma once

#include "core/bounded/bounded_space.h"
#include "core/bounded/map_on_mesh.h"
#include "core/maps/deformer.h"

namespace holomorph {

/// The bounds that a rest's parameters of method `bounded` ask for.
Bounds bounds_of(const Parameters& values);

/// Samples of a method's map where a BoundedSpace measures the distance to it.
class ReferenceSampler {
 public:
  static constexpr int kSamplesPerVertex = 6;  ///< of the basis
  /// How far inside of the boundary's samples references are smooth, in the samples' distances.
  static constexpr double kInset = 1;

  /// Prepares the method over the rest's cage and pins. All but the rest must outlive this.
  ReferenceSampler(const Rest& rest, const Method& method, const BoundaryBasis& basis,
                   const MapOnMesh& mesh);

  const ReferencePoints& points() const { return points_; }
  /// Whether the method looks at pins.
  bool uses_pins() const { return method_.uses_pins; }

  /// Samples the map of a pose. Throws Error as the method does, and when it is not finite.
  void deform(const Pose& pose, bool draft);
  /// Whether that was the map that moves nothing, to the last bit.
  bool is_identity() const;
  /// ln f_z along the boundary (algorithm 4), nu and Psi' everywhere; and the places of the zeros
  /// that were found.
  BoundedReference reference(Points& zeros) const;
  /// Some of the mesh's vertices, one at least, and where the map takes them.
  const std::vector<int>& anchors() const { return anchors_; }
  std::span<const Complex> anchor_places() const;
  /// What the method had to say, such as a pin that it could not use.
  const std::string& note() const { return map_.note; }

 private:
  void set_up_points(const Mesh& mesh, const BoundaryBasis& basis);

  const Method& method_;
  const BoundaryBasis& basis_;
  const MapOnMesh& on_mesh_;
  std::shared_ptr<const Mesh> mesh_;
  ReferencePoints points_;
  std::vector<int> anchors_;  ///< the inner points; the boundary where there are none
  HolomorphicFit fit_;
  std::unique_ptr<Deformer> deformer_;
  SampledMap map_;
};

}  // namespace holomorph
