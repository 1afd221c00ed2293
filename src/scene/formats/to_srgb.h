// Converts the colors of a picture to sRGB using the file's color profile or gamma.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/formats/image.h"

namespace holomorph {

/// Converts the pixels of a picture in place to sRGB from the RGB or gray space of an ICC profile.
/// Does nothing if the profile is damaged, describes another kind of color space, or differs from
/// sRGB by at most one step.
void to_srgb(Image& image, const std::string& profile);

/// A picture of 16-bit straight-alpha RGBA pixels, in the byte order of the machine.
struct DeepImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> pixels;  ///< 4 per pixel
};
/// The same picture in sRGB with 8 bits. Dark linear colors keep steps that 8 bits would lose.
Image in_srgb(const DeepImage& image, const std::string& profile);
/// Its fine pixels in sRGB. A profile that differs from sRGB by at most one 8-bit step is ignored.
/// Cost: several times that of in_srgb().
std::vector<float> fine_in_srgb(const DeepImage& image, const std::string& profile);

/// Converts 8-bit CMYK, in which 255 means no ink, to opaque RGBA. Uses the profile only if it is a
/// CMYK profile.
class CmykToSrgb {
 public:
  explicit CmykToSrgb(const std::string& profile);
  ~CmykToSrgb();
  void row(const std::uint8_t* cmyk, std::uint8_t* rgba, int count) const;

 private:
  struct Transform;
  std::unique_ptr<Transform> transform_;  ///< null without a usable CMYK profile
};

/// Converts a picture whose colors are CIELAB to sRGB: L* is 0 to 255, a* and b* are moved by 128.
void lab_to_srgb(Image& image);

/// The color space of a PNG file without a profile: the x and y chromaticities of white, red, green
/// and blue. `gamma` is the exponent of the samples.
struct Chromaticities {
  double white[2] = {0.3127, 0.3290}, red[2] = {0.64, 0.33}, green[2] = {0.30, 0.60},
         blue[2] = {0.15, 0.06};
};
void to_srgb(Image& image, const Chromaticities& primaries, double gamma);
Image in_srgb(const DeepImage& image, const Chromaticities& primaries, double gamma);
std::vector<float> fine_in_srgb(const DeepImage& image, const Chromaticities& primaries,
                                double gamma);

}  // namespace holomorph
