// A scene's map in full precision, as it stands or at a time of its keyframes.
#pragma once

#include "scene/live_map.h"

namespace holomorph {

class TimedMap {
 public:
  /// For the scene's edited layer. Throws Error as preparing the map does.
  explicit TimedMap(const Scene& scene);

  struct Frame {
    SampledMap map;  ///< at the mesh's vertices, with derivatives
    Scene scene;     ///< with its handles there
    /// The pose of the scene or of the keyframe; none between keyframes. There the map is linear in
    /// each triangle, derivatives are those of the triangles, and nothing is proved.
    std::optional<Pose> pose;
  };
  /// Without a time, or for a layer without keyframes, the scene as it stands. Throws Error when
  /// its keyframes have no maps. Cost: all keyframes' maps for the first time, then a sparse solve.
  Frame frame(std::optional<double> time);

  const Mesh& mesh() const { return *prepared_->mesh; }
  const PreparedMap& prepared() const { return *prepared_; }
  /// The frame's map at any points: NaN where the method's own is, and nothing outside the cage.
  SampledMap at(const Frame& frame, const Points& points) const;
  /// The same at single points; null when the method knows its map at samples only.
  std::unique_ptr<PointMap> point_map(const Frame& frame) const;

 private:
  Scene scene_;
  std::shared_ptr<PreparedMap> prepared_;
  Motion motion_;
};

}  // namespace holomorph
