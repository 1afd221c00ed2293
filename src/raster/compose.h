// Composites pictures over one another.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "raster/raster.h"
#include "scene/scene.h"

namespace holomorph {

/// How a layer combines with what is below it. The opacity is that of 8-bit pixels.
struct LayerInk {
  unsigned opacity = 255;
  Blending blending = Blending::normal;
  bool clipped = false;  ///< changes the colors of the nearest unclipped layer below, not its alpha
};
/// The ink of a layer of a scene.
LayerInk ink_of(const Scene& scene, size_t layer);

/// Composites pictures over one another, from the lowest to the uppermost, in floating point. The
/// result is the smallest picture that contains all that are not clipped.
class Composition {
 public:
  explicit Composition(double pixels_per_unit) : pixels_per_unit_(pixels_per_unit) {}

  /// Adds a picture, whose corner must be a whole number of pixels away from the others'. Opaque
  /// pixels with the usual ink, and pixels of only one picture, are copied bit for bit. Throws
  /// Error{bad_input} if the result would have more than 16384 pixels on a side. The first picture
  /// must not be clipped.
  void add(RasterResult picture, const LayerInk& ink = {});
  bool empty() const { return !base_; }
  /// The result in straight alpha, with fine pixels if a picture has some. There must be a picture.
  RasterResult result() &&;
  /// The same over another result, with which it does not blend. It must not be empty either.
  RasterResult over(Composition background) &&;

 private:
  using Pixel = std::array<float, 4>;  ///< premultiplied, 0 to 1
  struct Layer {
    int width = 0, height = 0;
    Complex corner;
    std::vector<Pixel> pixels;
  };
  static Layer layer_of(const RasterResult& picture);
  void blend(const Layer& over, Layer& under, const LayerInk& ink) const;
  void enlarge(Layer& under, const Layer& over) const;
  /// Takes the base, with what is clipped to it, on what is below it.
  Layer take_all();
  RasterResult straight(const Layer& layer) const;

  double pixels_per_unit_;
  bool is_fine_ = false;  ///< some picture has fine pixels
  std::optional<Layer> below_;
  std::optional<RasterResult> base_;  ///< the last picture that is not clipped
  LayerInk base_ink_;
  std::optional<Layer> group_;  ///< the base with what is clipped to it; none if nothing is
};

/// How much of an undeformed picture, its original, lies behind the layers: all of it, or only what
/// fills the gaps of its own layer. Then, the two together have the larger alpha of the two.
enum class Originals { whole, in_gaps };

/// Layers from the bottom to the top, over their originals, with which they do not blend.
class LayerStack {
 public:
  LayerStack(double pixels_per_unit, Originals originals)
      : pixels_per_unit_(pixels_per_unit),
        shown_(originals),
        layers_(pixels_per_unit),
        originals_(pixels_per_unit),
        group_(pixels_per_unit),
        originals_of_group_(pixels_per_unit) {}

  /// Adds a layer, as Composition::add() does, and its original if it can be seen. What is clipped
  /// to a layer has the gaps of that layer.
  void add(RasterResult picture, const LayerInk& ink, std::optional<RasterResult> original = {});
  bool empty() const { return layers_.empty(); }
  /// What lies behind the layers; none if there is nothing.
  std::optional<RasterResult> behind() &&;
  /// The layers over what lies behind them. There must be a layer.
  RasterResult result() &&;

 private:
  void end_group();

  double pixels_per_unit_;
  Originals shown_;
  Composition layers_, originals_;
  Composition group_, originals_of_group_;  ///< the last layer, with what is clipped to it
  Blending blending_ = Blending::normal;    ///< of that layer
};

/// The part of the plane that pixels with some alpha cover; empty if there are none.
Box filled_box(const RasterResult& result, double pixels_per_unit);
/// The smallest part of a picture that contains all pixels with some alpha. A picture without any
/// is returned unchanged.
RasterResult cropped_to_filled(RasterResult result, double pixels_per_unit);

/// Composites the image onto an opaque background color, in place.
void composite_onto_color(Image& image, const std::array<std::uint8_t, 3>& color);

}  // namespace holomorph
