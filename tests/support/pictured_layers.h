// Small pictures of layers, and how to compare what is drawn of them.
#pragma once

#include <algorithm>
#include <array>
#include <functional>

#include "raster/compose.h"
#include "raster/picture.h"
#include "scene/layers.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/shapes.h"

namespace holomorph {

using Pixel = std::array<std::uint8_t, 4>;

inline Image filled(int width, int height, Pixel pixel) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = pixel[i % 4];
  return image;
}

inline Pixel pixel_at(const Image& image, int column, int row) {
  const std::uint8_t* p = image.at(column, row);
  return {p[0], p[1], p[2], p[3]};
}

inline ImageReference reference(const char* file) {
  ImageReference named;
  named.file = file;
  return named;
}

/// One picture over another.
inline RasterResult composed(const RasterResult& under, const RasterResult& over,
                             double pixels_per_unit, const LayerInk& ink = {}) {
  Composition all(pixels_per_unit);
  all.add(under);
  all.add(over, ink);
  return std::move(all).result();
}

inline constexpr Pixel kRed{255, 0, 0, 255}, kBlue{0, 0, 255, 255}, kNothing{0, 0, 0, 0};

/// A red picture of 60 x 40 below a blue one of 30 x 20, which is the edited layer. Both have a
/// cage.
struct TwoLayers {
  Image blue = filled(30, 20, kBlue);
  Pictures pictures;
  Scene scene;

  TwoLayers() {
    const auto named = [](const char* file, double width, double height) {
      Layer layer;
      layer.image = reference(file);
      layer.deformation = with_cage({}, shapes::rectangle(width, height));
      return scene_of(std::move(layer));
    };
    pictures.put(reference("red"), {std::make_shared<const Image>(filled(60, 40, kRed)), ""});
    scene = with_layers_added(named("red", 60, 40), named("blue", 30, 20));
  }
  RasterResult drawn(const PictureOptions& options = {}) const {
    return picture_of(scene, &blue, options, pictures);
  }
};

/// The largest difference of what can be seen of two pictures, but for a few pixels.
inline int farthest_apart(const Image& a, const Image& b, size_t but_for = 0) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  std::vector<int> differences(a.pixels.size() / 4);
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const int difference = std::abs(a.pixels[i] * (i % 4 == 3 ? 255 : a.pixels[i | 3]) -
                                    b.pixels[i] * (i % 4 == 3 ? 255 : b.pixels[i | 3])) /
                           255;
    differences[i / 4] = std::max(differences[i / 4], difference);
  }
  std::ranges::sort(differences, std::greater());
  return differences[but_for];
}

}  // namespace holomorph
