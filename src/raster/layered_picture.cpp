// The merged picture determines the canvas, and thus where the layers lie.
#include "raster/layered_picture.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "raster/compose.h"
#include "raster/layer_drawing.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

/// A layer at its place on the canvas. Transparent edges are cut off.
DrawnLayer on_canvas(const RasterResult& drawn, const RasterResult& canvas, double scale,
                     std::string name) {
  const RasterResult cropped = cropped_to_filled(drawn, scale);
  const auto pixels = [&](double length) { return static_cast<int>(std::lround(length * scale)); };
  DrawnLayer layer;
  layer.name = std::move(name);
  layer.left = pixels(cropped.corner.real() - canvas.corner.real());
  layer.top = canvas.image.height - cropped.image.height -
              pixels(cropped.corner.imag() - canvas.corner.imag());
  layer.image = cropped.image;
  return layer;
}

/// Draws the layers of a scene on the canvas of their merged picture.
class LayerDrawer {
 public:
  LayerDrawer(const Scene& scene, const PictureOptions& options, PictureMaker& maker,
              const RasterResult& canvas, Pictures drawings, bool writes_drawings,
              const std::function<void()>& keep_going)
      : scene_(scene),
        options_(options),
        maker_(maker),
        canvas_(canvas),
        drawings_(std::move(drawings)),
        writes_drawings_(writes_drawings),
        keep_going_(keep_going) {}

  /// A layer as it is bent, with its ink. None if it has no picture.
  std::optional<DrawnLayer> layer(size_t i) {
    keep_going_();
    const Layer& it = *scene_.layers[i];
    std::optional<DrawnLayer> drawn;
    if (const auto text = drawings_.drawing(it)) {
      std::vector<std::string> losses;
      drawn = of_drawing(i, true, maker_.placement(i, options_.time), losses);
      for (const std::string& loss : losses) losses_.push_back(drawn->name + ": " + loss);
    } else if (const auto pixels = maker_.layer(i, options_)) {
      drawn = on_canvas(*pixels, canvas_, options_.scale, title_of_layer(scene_, i));
    }
    if (!drawn) return drawn;
    if (writes_drawings_ && it.blending == Blending::add)
      losses_.push_back(drawn->name + ": its blending mode, add, is only shown by web browsers");
    drawn->visible = it.visible;
    drawn->opacity = it.opacity;
    drawn->blending = it.blending;
    return drawn;
  }

  /// The background that shows the pictures before bending. Drawings stay drawings, unless only a
  /// part of them fills gaps.
  std::vector<DrawnLayer> originals() {
    std::vector<DrawnLayer> all;
    const bool any = std::ranges::any_of(scene_.layers, [&](const SharedLayer& layer) {
      return drawings_.drawing(*layer) != nullptr;
    });
    if (!any || !maker_.has_opaque_originals(options_.time)) {
      const auto original = maker_.behind(options_);
      if (!original) return all;
      all.push_back(on_canvas(*original, canvas_, options_.scale, "Original"));
      if (any) losses_.push_back("Background: the original is written as pixels");
      return all;
    }
    for (size_t i = 0; i < scene_.layers.size(); ++i) {
      if (!maker_.draws(i)) continue;
      const auto text = drawings_.drawing(*scene_.layers[i]);
      std::optional<DrawnLayer> drawn;
      std::vector<std::string> ignored_losses;  // those of the layer
      if (text)
        drawn = of_drawing(i, false, {}, ignored_losses);
      else if (const auto pixels = maker_.original(i, options_))
        drawn = on_canvas(*pixels, canvas_, options_.scale, "");
      if (!drawn) continue;
      drawn->name = "Original of " + title_of_layer(scene_, i);
      all.push_back(std::move(*drawn));
    }
    return all;
  }

  std::vector<std::string> losses() && { return std::move(losses_); }

  /// The size of a pixel of the canvas, so that the lowest drawing keeps its size.
  double pixel_size() const {
    for (const SharedLayer& layer : scene_.layers)
      if (const auto text = drawings_.drawing(*layer))
        return pixel_size_of({*text, layer->image->file, *drawings_.find(*layer->image)->image});
    return 1;
  }

 private:
  DrawnLayer of_drawing(size_t i, bool bent, const Similarity& placement,
                        std::vector<std::string>& losses) {
    const Layer& it = *scene_.layers[i];
    const Picture* picture = drawings_.find(*it.image);
    const SourceDrawing source{*drawings_.drawing(it), it.image->file, *picture->image};
    const Similarity to_canvas{options_.scale, canvas_.corner, 0};
    const DrawingPlace place{composed(to_canvas, placement),
                             static_cast<double>(canvas_.image.height),
                             (bent ? "layer-" : "original-") + std::to_string(i + 1) + "-"};
    DrawnLayer drawn;
    drawn.name = title_of_layer(scene_, i);
    drawn.drawing = bent ? layer_drawing(source, it.deformation, scene_.animation.linear_blend,
                                         options_.time, place, losses, keep_going_)
                         : placed_drawing(source, place, losses);
    return drawn;
  }

  const Scene& scene_;
  const PictureOptions& options_;
  PictureMaker& maker_;
  const RasterResult& canvas_;
  Pictures drawings_;  ///< only of drawings that stay drawings
  bool writes_drawings_;
  const std::function<void()>& keep_going_;
  std::vector<std::string> losses_;
};

}  // namespace

LayeredPicture layered_picture_of(const Scene& scene, const Image* source,
                                  const PictureOptions& asked, const Pictures& other_pictures,
                                  bool keeps_drawings, const std::function<void()>& keep_going) {
  PictureOptions options = asked;
  options.view = View::image;  // the other views show one layer
  PictureMaker maker(scene, source, other_pictures);
  const RasterResult canvas = maker.picture(options);
  LayeredPicture picture;
  picture.merged = canvas.image;
  if (scene.background.fill == Background::Fill::color) picture.background = scene.background.color;
  LayerDrawer drawer(scene, options, maker, canvas, keeps_drawings ? other_pictures : Pictures(),
                     keeps_drawings, keep_going);
  if (scene.background.fill == Background::Fill::original) picture.originals = drawer.originals();
  std::set<size_t> added_layers;
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const std::optional<size_t> base = clip_base(scene, i);
    if (base && !added_layers.contains(*base)) continue;
    std::optional<DrawnLayer> drawn = drawer.layer(i);
    if (!drawn) continue;
    added_layers.insert(i);
    drawn->clipped = base.has_value();
    picture.layers.push_back(std::move(*drawn));
  }
  picture.pixel_size = drawer.pixel_size();
  picture.losses = std::move(drawer).losses();
  return picture;
}

}  // namespace holomorph
