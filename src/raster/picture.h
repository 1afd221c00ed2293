// Draws a scene as it is exported: each layer is prepared, posed and rasterized in turn.
#pragma once

#include <functional>

#include "raster/compose.h"
#include "raster/motion_box.h"
#include "raster/raster.h"
#include "scene/pictures.h"

namespace holomorph {

struct PictureOptions {
  View view = View::image;  ///< all other views show only the edited layer, without a background
  double scale = 1;         ///< output pixels per image pixel
  bool crop = false;        ///< crop to the lowest picture's rectangle; otherwise crop nothing
  bool crops_to_filled = false;  ///< crop to the pixels that are not transparent, before the
                                 ///< background is added
  bool automatic_range = false;
  bool fine = false;               ///< the result has fine pixels
  std::optional<Box> region = {};  ///< draw exactly this part of the plane
  /// Seconds on the timeline; if not set, the scene's pose, and the frames of films that the
  /// pictures show.
  std::optional<double> time = {};
};

/// Draws the posed scene: its visible layers over its background. `source` is the edited layer's
/// picture, or null if it has none; `other_pictures` holds the pictures of the other layers. Throws
/// Error if the scene has neither a picture nor a cage, if no layer is visible, or if rasterized
/// throws.
RasterResult picture_of(const Scene& scene, const Image* source, const PictureOptions& options = {},
                        const Pictures& other_pictures = {});

/// Draws pictures of one scene at many times but prepares its layers only once.
class PictureMaker {
 public:
  /// Arguments as in picture_of; all of them must outlive this object. Films are those of
  /// `other_pictures`, also for the edited layer. Throws Error.
  PictureMaker(const Scene& scene, const Image* source, const Pictures& other_pictures = {});
  ~PictureMaker();

  RasterResult picture(const PictureOptions& options);
  /// One layer alone, as it is before its opacity and blending are applied, even if it is hidden.
  /// None if it has no picture.
  std::optional<RasterResult> layer(size_t number, const PictureOptions& options);
  /// Shows another picture, of any size, in the rectangle of the edited layer's picture, and stops
  /// its film. It must stay alive until the next call.
  void show(const Image& picture);
  /// A layer as it is before bending. None if it has no picture, or is mirrored.
  std::optional<RasterResult> original(size_t number, const PictureOptions& options);
  /// What lies behind the layers if the background is the original; none if there is nothing.
  std::optional<RasterResult> behind(const PictureOptions& options);
  /// Whether originals can lie whole behind the layers: at this time, all pictures are opaque, and
  /// their originals lie at the same place. Solves the maps of layers in boxes.
  bool has_opaque_originals(const std::optional<double>& time);
  /// The part of the plane that the whole motion covers, including the pictures' own rectangles and
  /// their originals, if these are the background.
  /// The result does not depend on which frames are drawn. Calls `keep_going` from time to time and
  /// returns none as soon as it returns false. Cost: one map per keyframe and about ten between
  /// each pair of consecutive keyframes.
  std::optional<Box> motion_region(const std::function<bool()>& keep_going = [] { return true; });
  /// The rectangle of the lowest visible picture, to which `crop` crops; empty if there is none.
  Box rectangle() const;
  /// Whether a picture of the scene shows a layer: it is visible, and so is the one to which it is
  /// clipped.
  bool draws(size_t layer) const;
  /// Where the plane of a layer lies in the scene's plane.
  Similarity placement(size_t layer, const std::optional<double>& time);
  /// The same for its undeformed picture, if it has one; see scene/original.h.
  std::optional<Similarity> original_placement(size_t layer, const std::optional<double>& time);

 private:
  class LayerMaker;

  struct Frame {
    PictureOptions options;  ///< with the region to which they crop
    double top = 0;          ///< the upper edge of the pictures, at which rows of pixels start
    std::optional<Box> stage = {};  ///< as in RasterJob
  };
  Frame frame_of(const PictureOptions& options) const;
  /// The visible layers, with the originals of those that may have gaps.
  LayerStack stack(const PictureOptions& options, bool with_originals);
  bool may_have_gaps(size_t layer, const std::optional<double>& time);
  std::vector<MotionPart> motion_parts(size_t layer);

  const Scene& scene_;
  std::vector<std::unique_ptr<LayerMaker>> layers_;  ///< from the bottom to the top
};

}  // namespace holomorph
