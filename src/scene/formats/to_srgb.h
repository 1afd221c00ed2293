// Colors of a file, by its profile or by what it says of gamma, to sRGB.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/formats/image.h"

namespace holomorph {

/// A picture's pixels from the RGB or gray of an ICC profile to sRGB, in place. Profiles that are
/// damaged or of another kind of color change nothing, nor do those that are sRGB within a step.
void to_srgb(Image& image, const std::string& profile);

/// CMYK of 8 bits, 255 for no ink, to opaque RGBA: by the profile where it is one of CMYK.
class CmykToSrgb {
 public:
  explicit CmykToSrgb(const std::string& profile);
  ~CmykToSrgb();
  void row(const std::uint8_t* cmyk, std::uint8_t* rgba, int count) const;

 private:
  struct Transform;
  std::unique_ptr<Transform> transform_;  ///< none: plain products
};

/// What a PNG says of its colors without a profile: x and y of white, red, green and blue, and the
/// exponent of its samples.
struct Chromaticities {
  double white[2] = {0.3127, 0.3290}, red[2] = {0.64, 0.33}, green[2] = {0.30, 0.60},
         blue[2] = {0.15, 0.06};
};
void to_srgb(Image& image, const Chromaticities& primaries, double gamma);

}  // namespace holomorph
