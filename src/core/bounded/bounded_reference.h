// The reference for a map without folds: another method's map, sampled along the boundary and
// inside.
#pragma once

#include "core/bounded/bounded_space.h"
#include "core/bounded/map_on_mesh.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"

namespace holomorph {

/// The bounds specified by the parameters of the `bounded` method.
Bounds bounds_of(const Parameters& values);

/// Samples a method's map at the points where a BoundedSpace measures the distance to it.
class ReferenceSampler {
 public:
  static constexpr int kSamplesPerVertex = 6;  ///< per vertex of the basis
  /// The distance from the boundary at which references are sampled, in sample spacings. References
  /// are smooth there. On the boundary itself, the derivative of a Cauchy map has a logarithmic
  /// singularity at each vertex.
  static constexpr double kInset = 1;

  /// Prepares the method for the rest's cage and pins. All arguments except `rest` must outlive
  /// this object.
  ReferenceSampler(const Rest& rest, const Method& method, const BoundaryBasis& basis,
                   const MapOnMesh& mesh);

  const ReferencePoints& points() const { return points_; }
  /// Whether the method uses pins.
  bool uses_pins() const { return method_.uses_pins; }

  /// Samples the map of a pose and its derivatives. A draft may continue from an earlier solution
  /// of the method. Throws Error if the method does, or if the map is not finite.
  void deform(const Pose& pose, EvalOptions options, const Solution* from);
  /// The method's solution for the sampled map.
  const std::shared_ptr<const Solution>& solution() const { return map_.solution; }
  /// Whether the sampled map is the identity, up to rounding errors.
  bool is_identity() const;
  /// ln f_z along the boundary (Levi, Weber 2016, alg. 4), and nu and Psi' at all points. `zeros`
  /// receives the positions of the zeros of f_z that were found.
  BoundedReference reference(Points& zeros) const;
  /// The indices of some of the mesh's vertices (at least one), and the images of these vertices.
  const std::vector<int>& anchors() const { return anchors_; }
  std::span<const Complex> anchor_images() const;
  /// Where the method's map takes a pin; none if it lies outside the mesh.
  std::optional<Complex> pin_image(size_t pin) const;
  /// The method's note, for example about a pin that it could not use.
  const std::string& note() const { return map_.note; }

 private:
  void set_up_points(const Mesh& mesh, const BoundaryBasis& basis);

  const Method& method_;
  const BoundaryBasis& basis_;
  const MapOnMesh& on_mesh_;
  std::shared_ptr<const Mesh> mesh_;
  ReferencePoints points_;
  std::vector<int> anchors_;  ///< inner vertices, or boundary vertices if there are none
  std::vector<std::optional<Index>> pins_;  ///< their samples
  HolomorphicFit fit_;
  std::unique_ptr<Deformer> deformer_;
  SampledMap map_;
};

}  // namespace holomorph
