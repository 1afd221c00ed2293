// Samples colors between pixels: bilinearly in premultiplied color, and exactly at pixel centers.
//
// The four channels of a color are one vector, in straight (not premultiplied) alpha unless a name
// says otherwise.
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "scene/formats/image.h"

namespace holomorph {

using Float4 = float __attribute__((vector_size(16)));
using Byte4 = std::uint8_t __attribute__((vector_size(4)));

#ifdef __SSE2__
inline Float4 load(const std::uint8_t* p) {
  int packed;
  std::memcpy(&packed, p, 4);
  const __m128i zero = _mm_setzero_si128();
  const __m128i wide = _mm_unpacklo_epi16(_mm_unpacklo_epi8(_mm_cvtsi32_si128(packed), zero), zero);
  return _mm_cvtepi32_ps(wide);
}

inline void store(Float4 color, std::uint8_t* out) {
  const __m128i rounded = _mm_cvttps_epi32(color + 0.5f);
  const __m128i words = _mm_packs_epi32(rounded, rounded);
  const int packed = _mm_cvtsi128_si32(_mm_packus_epi16(words, words));
  std::memcpy(out, &packed, 4);
}
#else
inline Float4 load(const std::uint8_t* p) {
  Byte4 bytes;
  std::memcpy(&bytes, p, 4);
  return __builtin_convertvector(bytes, Float4);
}

inline void store(Float4 color, std::uint8_t* out) {
  for (int k = 0; k < 4; ++k)
    out[k] = static_cast<std::uint8_t>(std::clamp(color[k] + 0.5f, 0.0f, 255.0f));
}
#endif

inline Float4 load(const float* p) {
  Float4 color;
  std::memcpy(&color, p, sizeof color);
  return color;
}
/// Only 8-bit pixels are rounded.
inline void store(Float4 color, float* out) {
  std::memcpy(out, &color, sizeof color);
}

inline bool same(Float4 a, Float4 b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2] && a[3] == b[3];
}

/// The floor of a number that fits into an int. Without SSE 4.1, std::floor is a function call.
inline int floor_of(double x) {
  const int i = static_cast<int>(x);
  return i - (x < i);
}

/// Samples the pixels or the fine pixels of an image, which is transparent outside its rectangle. u
/// points right and v down; pixel centers are at half-integers.
template <class Channel>
class SamplerOf {
 public:
  explicit SamplerOf(const Image& image) : image_(image) {}

  Float4 at(double u, double v) const {
    // Extrapolation at a silhouette may lead far outside the picture.
    const double x = std::clamp(u, -1e6, 1e6) - 0.5, y = std::clamp(v, -1e6, 1e6) - 0.5;
    const int c = floor_of(x), r = floor_of(y);
    const double tx = x - c, ty = y - r;
    const bool on_x = tx < kOnTexel || tx > 1 - kOnTexel, on_y = ty < kOnTexel || ty > 1 - kOnTexel;
    if (on_x && on_y) return texel(c + (tx > 0.5), r + (ty > 0.5));
    const float wx = static_cast<float>(tx), wy = static_cast<float>(ty);
    const float w[4] = {(1 - wx) * (1 - wy), wx * (1 - wy), (1 - wx) * wy, wx * wy};
    Float4 t[4];
    if (c >= 0 && r >= 0 && c + 1 < image_.width && r + 1 < image_.height) {
      const Channel* p = at(c, r);
      const Channel* q = at(c, r + 1);
      const auto [least, most] = std::minmax({p[3], p[7], q[3], q[7]});
      if (most == 0) return Float4{};
      t[0] = load(p), t[1] = load(p + 4), t[2] = load(q), t[3] = load(q + 4);
      if (least == 255) return w[0] * t[0] + w[1] * t[1] + w[2] * t[2] + w[3] * t[3];  // all opaque
    } else {
      t[0] = texel(c, r), t[1] = texel(c + 1, r), t[2] = texel(c, r + 1),
      t[3] = texel(c + 1, r + 1);
    }
    Float4 sum{};
    for (int k = 0; k < 4; ++k) {
      const float weight = w[k] * t[k][3];
      t[k][3] = 1;
      sum += weight * t[k];
    }
    return straight(sum);
  }

  /// Converts a color whose channels are weighted by alpha, with alpha last, to straight color.
  static Float4 straight(Float4 sum) {
    const float alpha = sum[3];
    if (alpha <= 0) return Float4{};
    sum *= 1 / alpha;
    sum[3] = alpha;
    return sum;
  }

  static constexpr double kOnTexel = 1e-3;  ///< a texel whose center is this close is copied

 private:
  Float4 texel(int c, int r) const {
    if (c < 0 || r < 0 || c >= image_.width || r >= image_.height) return Float4{};
    return load(at(c, r));
  }
  const Channel* at(int c, int r) const {
    if constexpr (std::is_same_v<Channel, float>)
      return &image_.fine[image_.index(c, r)];
    else
      return image_.at(c, r);
  }
  const Image& image_;
};
using Sampler = SamplerOf<std::uint8_t>;

/// The operator "over" in straight color: `top` composited over `below`.
inline Float4 over(Float4 top, Float4 below) {
  if (top[3] >= 254.99f || below[3] <= 0) return top;
  if (top[3] <= 0) return below;
  const float rest = below[3] * (1 - top[3] / 255), alpha = top[3] + rest;
  Float4 sum = (top * top[3] + below * rest) * (1 / alpha);
  sum[3] = alpha;
  return sum;
}

/// Composites a color onto a pixel.
template <class Channel>
void draw_pixel(Float4 color, Channel* out) {
  store(out[3] == 0 ? color : over(color, load(out)), out);
}

}  // namespace holomorph
