// A scene to a picture, as exported: prepare, pose, rasterize, layer by layer.
#pragma once

#include <functional>

#include "raster/raster.h"
#include "scene/motion.h"
#include "scene/pictures.h"

namespace holomorph {

struct PictureOptions {
  View view = View::image;  ///< others show the edited layer alone, without a background
  double scale = 1;         ///< output pixels per image pixel
  bool crop = false;        ///< keep the lowest picture's rectangle; else nothing is cut off
  bool automatic_range = false;
  std::optional<Box> shows = {};    ///< exactly this part of the plane
  std::optional<double> time = {};  ///< seconds of the keyframes; none: the scene's own pose
};

/// The posed scene as a picture: its visible layers over its background. `source` is the edited
/// layer's picture, or null when it has none; `others` has those of the other layers. Throws Error
/// for a scene with neither picture nor cage, or nothing visible, and for what rasterized refuses.
RasterResult picture_of(const Scene& scene, const Image* source, const PictureOptions& options = {},
                        const Pictures& others = {});

/// Pictures of one scene at many times, which share what is prepared.
class PictureMaker {
 public:
  /// As picture_of; all must outlive this. Throws Error.
  PictureMaker(const Scene& scene, const Image* source, const Pictures& others = {});
  ~PictureMaker();

  RasterResult picture(const PictureOptions& options);
  /// The part of the plane that the whole motion needs, with the pictures' own rectangles: the same
  /// whichever of its frames are drawn. `go_on` is asked now and then; none when it says no. Cost:
  /// maps at the keyframes and at some ten times between two of them.
  std::optional<Box> shown(const std::function<bool()>& go_on = [] { return true; });
  /// The lowest visible picture's rectangle, which crop keeps; empty without one.
  Box rectangle() const;

 private:
  class LayerMaker;

  const Scene& scene_;
  std::vector<std::unique_ptr<LayerMaker>> layers_;  ///< from the bottom to the top
};

}  // namespace holomorph
