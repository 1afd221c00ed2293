// A deformation's map in full precision, as it stands or at a time of its keyframes.
#pragma once

#include "core/maps/distortion.h"
#include "core/maps/inverse.h"
#include "scene/motion.h"
#include "scene/scene.h"

namespace holomorph {

/// The map at a moment. Where a pose is shown, the deformation's or a keyframe's, it is the
/// method's. On the way between keyframes it is linear in each triangle, and nothing is proved.
struct TimedFrame {
  Deformation deformation;   ///< with its handles there
  std::optional<Pose> pose;  ///< none on the way between keyframes
  VectorXc between;          ///< then the mesh's vertices
};

/// The map of a deformation at many moments, which share what is prepared.
class TimedMap {
 public:
  /// Throws Error as preparing the map does.
  explicit TimedMap(const Deformation& deformation, bool linear_blend = false);
  /// Of the edited layer.
  explicit TimedMap(const Scene& scene)
      : TimedMap(scene.deformation(), scene.animation.linear_blend) {}

  /// Without a time, or without keyframes, the deformation as it stands. Throws Error when
  /// none of the keyframes plays or one of them has no map. Cost: all keyframes' maps for the first
  /// time, then a sparse solve.
  TimedFrame frame(std::optional<double> time);

  const Mesh& mesh() const { return *prepared_->mesh; }
  const PreparedMap& prepared() const { return *prepared_; }

  /// At the mesh's vertices, with derivatives.
  SampledMap on_mesh(const TimedFrame& frame) const;
  /// At any points, with derivatives: NaN where the method's own is, and nothing outside the cage.
  /// What is precomputed for points is kept for the next frame with the same ones.
  SampledMap at(const TimedFrame& frame, const Points& points);

  /// The inverse of a frame's map, with the map.
  struct Inverse {
    std::unique_ptr<PointMap> map;
    InverseMap inverse;

    Inverse(std::unique_ptr<PointMap> of, const Cage& rest, const Mesh& mesh, const VectorXc& f)
        : map(std::move(of)), inverse(rest, mesh, as_span(f), *map) {}
  };
  /// Null when the method knows its map at samples only. The TimedMap must outlive it.
  std::unique_ptr<Inverse> inverse(const TimedFrame& frame) const;

 private:
  Deformation deformation_;
  bool linear_blend_;
  std::shared_ptr<PreparedMap> prepared_;
  Motion motion_;
  Points points_;
  std::unique_ptr<Deformer> at_points_;
};

}  // namespace holomorph
