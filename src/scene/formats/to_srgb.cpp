// Converts colors with Little CMS.
#include "scene/formats/to_srgb.h"

#include <lcms2.h>

#include <algorithm>
#include <cmath>

namespace holomorph {

/// Not in an unnamed namespace, because a class of the header has it as a part.
struct DeleteTransform {
  void operator()(void* transform) const { cmsDeleteTransform(transform); }
};

namespace {

struct CloseProfile {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, CloseProfile>;
using Conversion = std::unique_ptr<void, DeleteTransform>;

constexpr size_t kLargestProfile = 8 << 20;

Profile opened(const std::string& bytes) {
  if (bytes.size() > kLargestProfile) return {};
  return Profile(cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
}

Conversion conversion(const Profile& from, cmsUInt32Number format, cmsUInt32Number to = TYPE_RGBA_8,
                      cmsUInt32Number alpha = cmsFLAGS_COPY_ALPHA) {
  const Profile srgb(cmsCreate_sRGBProfile());
  return Conversion(cmsCreateTransform(from.get(), format, srgb.get(), to,
                                       INTENT_RELATIVE_COLORIMETRIC,
                                       alpha | cmsFLAGS_BLACKPOINTCOMPENSATION));
}

/// Whether a conversion leaves colors unchanged, up to rounding.
bool is_identity(const Conversion& conversion) {
  std::vector<std::uint8_t> grid;
  for (int r = 0; r < 256; r += 15)
    for (int g = 0; g < 256; g += 15)
      for (int b = 0; b < 256; b += 15)
        for (const int value : {r, g, b, 255}) grid.push_back(static_cast<std::uint8_t>(value));
  std::vector<std::uint8_t> converted(grid.size());
  cmsDoTransform(conversion.get(), grid.data(), converted.data(),
                 static_cast<cmsUInt32Number>(grid.size() / 4));
  for (size_t i = 0; i < grid.size(); ++i)
    if (std::abs(grid[i] - converted[i]) > 1) return false;
  return true;
}

void convert(Image& image, const Conversion& conversion) {
  if (!conversion || is_identity(conversion)) return;
  for (int r = 0; r < image.height; ++r)
    cmsDoTransform(conversion.get(), image.at(0, r), image.at(0, r),
                   static_cast<cmsUInt32Number>(image.width));
}

/// Like convert(), for a gray profile. All three channels of the image contain the gray value.
void convert_gray(Image& image, const Conversion& conversion) {
  std::uint8_t grays[256];
  std::uint8_t colors[256 * 4];
  for (int i = 0; i < 256; ++i) grays[i] = static_cast<std::uint8_t>(i);
  cmsDoTransform(conversion.get(), grays, colors, 256);
  for (size_t i = 0; i < image.pixels.size(); i += 4)
    std::copy_n(colors + 4 * static_cast<size_t>(image.pixels[i]), 3, &image.pixels[i]);
}

/// The nearest picture with 8 bits.
Image rounded(const DeepImage& deep) {
  Image image(deep.width, deep.height);
  constexpr unsigned kStep = 257;  // 16-bit steps per 8-bit step
  for (size_t i = 0; i < deep.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>((deep.pixels[i] + kStep / 2) / kStep);
  return image;
}

Image converted(const DeepImage& deep, const Profile& profile) {
  Image image = rounded(deep);
  const Conversion narrow = conversion(profile, TYPE_RGBA_8),
                   wide = conversion(profile, TYPE_RGBA_16);
  if (!narrow || !wide || is_identity(narrow)) return image;
  for (int r = 0; r < image.height; ++r)
    cmsDoTransform(wide.get(),
                   &deep.pixels[4 * static_cast<size_t>(r) * static_cast<size_t>(deep.width)],
                   image.at(0, r), static_cast<cmsUInt32Number>(image.width));
  return image;
}

constexpr float kWhole = 65535;  // white or opaque

/// The samples as they are, for a picture in sRGB.
std::vector<float> fine_samples(const DeepImage& deep) {
  std::vector<float> fine;
  fine.reserve(deep.pixels.size());
  for (const std::uint16_t sample : deep.pixels)
    fine.push_back(255 * (static_cast<float>(sample) / kWhole));
  return fine;
}

/// A channel of a fine pixel, from 1 for white. Damaged profiles lead to any number.
float fine_channel(float color) {
  constexpr float kBrightest = 64;
  return color > 0 ? 255 * std::min(color, kBrightest) : 0;  // also for NaN
}

/// Floating-point conversions use no precomputed tables, so they are exact but slow.
std::vector<float> fine_converted(const DeepImage& deep, const Profile& profile) {
  std::vector<float> fine = fine_samples(deep);
  const Conversion narrow = conversion(profile, TYPE_RGBA_8),
                   exact = conversion(profile, TYPE_RGBA_FLT, TYPE_RGBA_FLT, 0);
  if (!narrow || !exact || is_identity(narrow)) return fine;
  const size_t row = 4 * static_cast<size_t>(deep.width);
  std::vector<float> colors(row), converted(row);
  for (size_t start = 0; start < fine.size(); start += row) {
    for (size_t i = 0; i < row; ++i) colors[i] = fine[start + i] / 255;
    cmsDoTransform(exact.get(), colors.data(), converted.data(),
                   static_cast<cmsUInt32Number>(deep.width));
    for (size_t i = 0; i < row; ++i)
      if (i % 4 != 3) fine[start + i] = fine_channel(converted[i]);
  }
  return fine;
}

Conversion gray_conversion(const Profile& profile, cmsUInt32Number format) {
  return conversion(profile, format, TYPE_RGBA_8, 0);
}

/// Like fine_converted(), for a gray profile.
std::vector<float> fine_converted_gray(const DeepImage& deep, const Profile& profile) {
  std::vector<float> fine = fine_samples(deep);
  const Conversion gray = conversion(profile, TYPE_GRAY_FLT, TYPE_RGB_FLT, 0);
  if (!gray) return fine;
  std::vector<float> grays(1 << 16), colors(3 * grays.size());
  for (size_t i = 0; i < grays.size(); ++i) grays[i] = static_cast<float>(i) / kWhole;
  cmsDoTransform(gray.get(), grays.data(), colors.data(),
                 static_cast<cmsUInt32Number>(grays.size()));
  for (size_t i = 0; i < fine.size(); i += 4)
    for (size_t k = 0; k < 3; ++k)
      fine[i + k] = fine_channel(colors[3 * static_cast<size_t>(deep.pixels[i]) + k]);
  return fine;
}

/// Like converted(), for a gray profile.
Image converted_gray(const DeepImage& deep, const Profile& profile) {
  Image image = rounded(deep);
  const Conversion gray = gray_conversion(profile, TYPE_GRAY_16);
  if (!gray) return image;
  std::vector<std::uint16_t> grays(1 << 16);
  for (size_t i = 0; i < grays.size(); ++i) grays[i] = static_cast<std::uint16_t>(i);
  std::vector<std::uint8_t> colors(4 * grays.size());
  cmsDoTransform(gray.get(), grays.data(), colors.data(),
                 static_cast<cmsUInt32Number>(grays.size()));
  for (size_t i = 0; i < image.pixels.size(); i += 4)
    std::copy_n(&colors[4 * static_cast<size_t>(deep.pixels[i])], 3, &image.pixels[i]);
  return image;
}

/// The profile of a PNG file without one; null if the gamma is invalid.
Profile profile_of(const Chromaticities& p, double gamma) {
  if (!(gamma > 0.01 && gamma < 100)) return {};
  cmsCIExyY white{p.white[0], p.white[1], 1};
  cmsCIExyYTRIPLE primaries{
      {p.red[0], p.red[1], 1}, {p.green[0], p.green[1], 1}, {p.blue[0], p.blue[1], 1}};
  // sRGB files specify a gamma of 1 / 2.2.
  constexpr double kLikeSrgb = 0.005;
  const double srgb[5] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  cmsToneCurve* curve = std::abs(gamma - 1 / 2.2) < kLikeSrgb
                            ? cmsBuildParametricToneCurve(nullptr, 4, srgb)
                            : cmsBuildGamma(nullptr, 1 / gamma);
  cmsToneCurve* curves[3] = {curve, curve, curve};
  Profile profile(curve ? cmsCreateRGBProfile(&white, &primaries, curves) : nullptr);
  if (curve) cmsFreeToneCurve(curve);
  return profile;
}

/// The color space in a profile's header, such as "RGB " or "GRAY". lcms returns an enumerator,
/// even if a hostile profile has another value.
std::string color_space_of(const std::string& profile) {
  constexpr size_t kPlace = 16, kLength = 4;
  return profile.size() < kPlace + kLength ? "" : profile.substr(kPlace, kLength);
}

}  // namespace

void to_srgb(Image& image, const std::string& bytes) {
  const Profile profile = opened(bytes);
  if (!profile) return;
  const std::string colors = color_space_of(bytes);
  if (colors == "RGB ") {
    convert(image, conversion(profile, TYPE_RGBA_8));
  } else if (colors == "GRAY") {
    const Conversion gray = gray_conversion(profile, TYPE_GRAY_8);
    if (gray) convert_gray(image, gray);
  }
}

Image in_srgb(const DeepImage& image, const std::string& bytes) {
  const Profile profile = opened(bytes);
  const std::string colors = color_space_of(bytes);
  if (profile && colors == "RGB ") return converted(image, profile);
  if (profile && colors == "GRAY") return converted_gray(image, profile);
  return rounded(image);
}

std::vector<float> fine_in_srgb(const DeepImage& image, const std::string& bytes) {
  const Profile profile = opened(bytes);
  const std::string colors = color_space_of(bytes);
  if (profile && colors == "RGB ") return fine_converted(image, profile);
  if (profile && colors == "GRAY") return fine_converted_gray(image, profile);
  return fine_samples(image);
}

void to_srgb(Image& image, const Chromaticities& primaries, double gamma) {
  if (const Profile profile = profile_of(primaries, gamma))
    convert(image, conversion(profile, TYPE_RGBA_8));
}

Image in_srgb(const DeepImage& image, const Chromaticities& primaries, double gamma) {
  const Profile profile = profile_of(primaries, gamma);
  return profile ? converted(image, profile) : rounded(image);
}

std::vector<float> fine_in_srgb(const DeepImage& image, const Chromaticities& primaries,
                                double gamma) {
  const Profile profile = profile_of(primaries, gamma);
  return profile ? fine_converted(image, profile) : fine_samples(image);
}

void lab_to_srgb(Image& image) {
  const Profile lab(cmsCreateLab4Profile(nullptr));
  constexpr cmsUInt32Number kLabWithAlpha = TYPE_Lab_8 | EXTRA_SH(1);
  const Conversion found = conversion(lab, kLabWithAlpha);
  for (int r = 0; found && r < image.height; ++r)
    cmsDoTransform(found.get(), image.at(0, r), image.at(0, r),
                   static_cast<cmsUInt32Number>(image.width));
}

struct CmykToSrgb::Transform {
  Conversion conversion;
};

CmykToSrgb::CmykToSrgb(const std::string& bytes) {
  const Profile profile = opened(bytes);
  if (!profile || color_space_of(bytes) != "CMYK") return;
  const Profile srgb(cmsCreate_sRGBProfile());
  // The output has four bytes per pixel. lcms does not write the fourth byte; row() sets it.
  Conversion found(cmsCreateTransform(profile.get(), TYPE_CMYK_8_REV, srgb.get(), TYPE_RGBA_8,
                                      INTENT_RELATIVE_COLORIMETRIC,
                                      cmsFLAGS_BLACKPOINTCOMPENSATION));
  if (found) transform_ = std::make_unique<Transform>(Transform{std::move(found)});
}

CmykToSrgb::~CmykToSrgb() = default;

void CmykToSrgb::row(const std::uint8_t* cmyk, std::uint8_t* rgba, int count) const {
  if (transform_)
    cmsDoTransform(transform_->conversion.get(), cmyk, rgba, static_cast<cmsUInt32Number>(count));
  for (int i = 0; i < count; ++i, cmyk += 4, rgba += 4) {
    for (int k = 0; k < 3 && !transform_; ++k)
      rgba[k] = static_cast<std::uint8_t>((cmyk[k] * cmyk[3] + 127) / 255);
    rgba[3] = 255;
  }
}

}  // namespace holomorph
