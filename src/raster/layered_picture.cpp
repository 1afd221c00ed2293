// The merged picture determines the canvas, and thus where the layers lie.
#include "raster/layered_picture.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "raster/compose.h"
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

}  // namespace

LayeredPicture layered_picture_of(const Scene& scene, const Image* source,
                                  const PictureOptions& asked, const Pictures& other_pictures) {
  PictureOptions options = asked;
  options.view = View::image;  // the other views show one layer
  PictureMaker maker(scene, source, other_pictures);
  const RasterResult canvas = maker.picture(options);
  LayeredPicture picture;
  picture.merged = canvas.image;
  if (scene.background.fill == Background::Fill::color) picture.background = scene.background.color;
  if (scene.background.fill == Background::Fill::original)
    if (const auto original = maker.originals(options))
      picture.layers.push_back(on_canvas(*original, canvas, options.scale, "Original"));
  std::set<size_t> added_layers;
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    const std::optional<size_t> base = clip_base(scene, i);
    const std::optional<RasterResult> drawn = maker.layer(i, options);
    if (!drawn || (base && !added_layers.contains(*base))) continue;
    added_layers.insert(i);
    DrawnLayer& added = picture.layers.emplace_back(
        on_canvas(*drawn, canvas, options.scale, title_of_layer(scene, i)));
    added.visible = layer.visible;
    added.opacity = layer.opacity;
    added.blending = layer.blending;
    added.clipped = base.has_value();
  }
  return picture;
}

}  // namespace holomorph
