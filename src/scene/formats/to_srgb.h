// Converts the colors of a file to sRGB by its profile or by its gamma.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/formats/image.h"

namespace holomorph {

/// Converts the pixels of a picture in place to sRGB from the RGB or gray space of an ICC profile.
/// Profiles that are damaged, describe another kind of color, or agree with sRGB to within one step
/// change nothing.
void to_srgb(Image& image, const std::string& profile);

/// Converts 8-bit CMYK, with 255 for no ink, to opaque RGBA. Uses the profile if it is a CMYK
/// profile.
class CmykToSrgb {
 public:
  explicit CmykToSrgb(const std::string& profile);
  ~CmykToSrgb();
  void row(const std::uint8_t* cmyk, std::uint8_t* rgba, int count) const;

 private:
  struct Transform;
  std::unique_ptr<Transform> transform_;  ///< null: plain products
};

/// The colors that a PNG file without a profile states: x and y of white, red, green and blue.
/// `gamma` is the exponent of its samples.
struct Chromaticities {
  double white[2] = {0.3127, 0.3290}, red[2] = {0.64, 0.33}, green[2] = {0.30, 0.60},
         blue[2] = {0.15, 0.06};
};
void to_srgb(Image& image, const Chromaticities& primaries, double gamma);

}  // namespace holomorph
