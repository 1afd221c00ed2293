// A deformation's map at full precision, in the deformation's own pose or at a time in its
// animation.
#pragma once

#include <functional>

#include "core/maps/deformer.h"
#include "core/maps/fine_map.h"
#include "core/maps/inverse.h"
#include "scene/motion.h"
#include "scene/scene.h"

namespace holomorph {

/// The map at a moment. In the deformation's own pose and at keyframes, the method computes the map
/// with its guarantees. Between keyframes that are certified, methods without folds have smooth
/// maps, which may be certified, too; other maps are linear in the mesh's triangles.
struct TimedFrame {
  Deformation deformation;   ///< with the handles' positions at that moment
  std::optional<Pose> pose;  ///< none between keyframes
  SampledMap between;        ///< at the mesh's vertices, between keyframes only
};

/// The map of a deformation, prepared once and evaluated at many moments.
class TimedMap {
 public:
  /// Throws the same errors as prepared_map().
  explicit TimedMap(const Deformation& deformation, bool linear_blend = false);
  /// The map of the edited layer.
  explicit TimedMap(const Scene& scene)
      : TimedMap(scene.deformation(), scene.animation.linear_blend) {}

  /// The frame at a time. Without a time or without keyframes, returns the frame in the
  /// deformation's own pose. Throws Error if none of the keyframes plays, or if a keyframe on
  /// which the frame depends has no map. Cost: the maps of up to four keyframes unless they are
  /// known, and a sparse solve.
  TimedFrame frame(std::optional<double> time);

  const Mesh& mesh() const { return *prepared_->mesh; }
  const PreparedMap& prepared() const { return *prepared_; }

  /// The map at the mesh's vertices, with derivatives.
  SampledMap on_mesh(const TimedFrame& frame) const;
  /// The map at arbitrary points, with derivatives. Values are NaN where the method's map is NaN,
  /// and meaningless outside the cage. The next call with the same points reuses their
  /// precomputation.
  SampledMap at(const TimedFrame& frame, const Points& points);
  /// The number of points that at() should take at once, because of the budget for coordinates.
  size_t block_size() const;
  /// The map at any number of points, with derivatives. Values are NaN outside the cage and at
  /// points that are not finite. Calls `keep_going` before each block of points, as fine() does.
  SampledMap values_in_cage(
      const TimedFrame& frame, const Points& points,
      const std::function<void()>& keep_going = [] {});

  /// The map at single points. Null if the method evaluates its map only at samples. The TimedMap
  /// must outlive the result.
  std::unique_ptr<PointMap> point_map(const TimedFrame& frame) const;

  /// The map in linear pieces that are within `tolerance` of it, in units of the plane. They are in
  /// the order in which they are drawn. Maps that are known only at samples, and frames that are
  /// blended triangle by triangle, are linear in each triangle of the mesh. Uses all cores. Calls
  /// `keep_going` on this thread from time to time; an exception from it ends the work and is
  /// rethrown.
  FineMap fine(
      const TimedFrame& frame, double tolerance,
      const std::function<void()>& keep_going = [] {}) const;

  /// A frame's map and its inverse, which knows the order in which triangles are drawn.
  struct Inverse {
    std::unique_ptr<PointMap> map;
    std::shared_ptr<const Mesh> drawn;
    InverseMap inverse;

    Inverse(std::unique_ptr<PointMap> of, const Cage& rest, std::shared_ptr<const Mesh> mesh,
            const VectorXc& f)
        : map(std::move(of)), drawn(std::move(mesh)), inverse(rest, *drawn, as_span(f), *map) {}

    /// The preimages of each point. Uses all cores. `progress` is called on this thread with the
    /// number of points that have been searched for; an exception in it ends the work.
    std::vector<std::vector<Preimage>> at(std::span<const Complex> points,
                                          const std::function<void(size_t)>& progress = {}) const;
  };
  /// Null if the method evaluates its map only at samples. The TimedMap must outlive the result.
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
