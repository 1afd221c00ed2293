// A scene to a picture, as exported: prepare, pose, rasterize.
#pragma once

#include <functional>

#include "raster/raster.h"
#include "scene/live_map.h"

namespace holomorph {

struct PictureOptions {
  View view = View::image;
  double scale = 1;   ///< output pixels per image pixel
  bool crop = false;  ///< keep the picture's rectangle; else nothing is cut off
  bool automatic_range = false;
  std::optional<Box> shows = {};    ///< exactly this part of the plane
  std::optional<double> time = {};  ///< seconds of the keyframes; none: the scene's own pose
};

/// The posed scene as a picture. `source` is the scene's picture, or null when it has none. Throws
/// Error for a scene with neither picture nor cage and for what rasterized refuses.
RasterResult picture_of(const Scene& scene, const Image* source,
                        const PictureOptions& options = {});

/// Pictures of one scene at many times, which share what is prepared.
class PictureMaker {
 public:
  /// As picture_of; both must outlive this. Throws Error.
  PictureMaker(const Scene& scene, const Image* source);
  ~PictureMaker();

  RasterResult picture(const PictureOptions& options);
  /// The part of the plane that all of these times need, with the picture's own rectangle: the same
  /// for whoever draws some of them. `go_on` is asked before each; none when it says no.
  std::optional<Box> shown_at(
      std::span<const double> times, const std::function<bool()>& go_on = [] { return true; });

 private:
  SampledMap map_at(const std::optional<double>& time, bool derivatives);

  const Scene& scene_;
  const Image* source_;
  std::shared_ptr<PreparedMap> prepared_;
  Motion motion_;
};

}  // namespace holomorph
