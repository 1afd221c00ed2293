// Samples eight pixels at once. Each lane computes what the sampler computes for its pixel, in the
// same order and without fused operations, so both give the same bits.
#include "raster/picture_rows.h"

#ifdef __x86_64__
#include <immintrin.h>

namespace holomorph {
namespace {

#define HOLOMORPH_AVX2 __attribute__((target("avx2")))

/// Eight colors, one vector for each channel; alpha is last.
struct Colors {
  __m256 channel[4];
};
/// Eight positions in doubles.
struct Positions {
  __m256d low, high;
};

HOLOMORPH_AVX2 inline Colors transparent() {
  const __m256 zero = _mm256_setzero_ps();
  return {{zero, zero, zero, zero}};
}

/// A channel of eight packed pixels.
template <int kChannel>
HOLOMORPH_AVX2 inline __m256 channel_of(__m256i pixels) {
  return _mm256_cvtepi32_ps(
      _mm256_and_si256(_mm256_srli_epi32(pixels, 8 * kChannel), _mm256_set1_epi32(255)));
}
HOLOMORPH_AVX2 inline Colors unpacked(__m256i pixels) {
  return {
      {channel_of<0>(pixels), channel_of<1>(pixels), channel_of<2>(pixels), channel_of<3>(pixels)}};
}
HOLOMORPH_AVX2 inline __m256i packed(const Colors& colors) {
  __m256i pixels = _mm256_setzero_si256();
  for (int k = 3; k >= 0; --k) {
    const __m256i value =
        _mm256_cvttps_epi32(_mm256_add_ps(colors.channel[k], _mm256_set1_ps(0.5f)));
    const __m256i byte =
        _mm256_min_epi32(_mm256_max_epi32(value, _mm256_setzero_si256()), _mm256_set1_epi32(255));
    pixels = _mm256_or_si256(_mm256_slli_epi32(pixels, 8), byte);
  }
  return pixels;
}
HOLOMORPH_AVX2 inline Colors selected(const Colors& a, const Colors& b, __m256 takes_b) {
  Colors result;
  for (int k = 0; k < 4; ++k)
    result.channel[k] = _mm256_blendv_ps(a.channel[k], b.channel[k], takes_b);
  return result;
}

/// Sampler::straight.
HOLOMORPH_AVX2 inline Colors straight(const Colors& sum) {
  const __m256 alpha = sum.channel[3],
               filled = _mm256_cmp_ps(alpha, _mm256_setzero_ps(), _CMP_GT_OQ),
               factor = _mm256_div_ps(_mm256_set1_ps(1), alpha);
  Colors result;
  for (int k = 0; k < 3; ++k)
    result.channel[k] = _mm256_and_ps(_mm256_mul_ps(sum.channel[k], factor), filled);
  result.channel[3] = _mm256_and_ps(alpha, filled);
  return result;
}

/// The operator "over" of sampler.h.
HOLOMORPH_AVX2 inline Colors composited(const Colors& top, const Colors& below) {
  const __m256 zero = _mm256_setzero_ps(), a = top.channel[3], b = below.channel[3];
  const __m256 rest =
      _mm256_mul_ps(b, _mm256_sub_ps(_mm256_set1_ps(1), _mm256_div_ps(a, _mm256_set1_ps(255))));
  const __m256 alpha = _mm256_add_ps(a, rest), factor = _mm256_div_ps(_mm256_set1_ps(1), alpha);
  Colors mixed;
  for (int k = 0; k < 3; ++k)
    mixed.channel[k] = _mm256_mul_ps(
        _mm256_add_ps(_mm256_mul_ps(top.channel[k], a), _mm256_mul_ps(below.channel[k], rest)),
        factor);
  mixed.channel[3] = alpha;
  const Colors visible = selected(mixed, below, _mm256_cmp_ps(a, zero, _CMP_LE_OQ));
  return selected(visible, top,
                  _mm256_or_ps(_mm256_cmp_ps(a, _mm256_set1_ps(254.99f), _CMP_GE_OQ),
                               _mm256_cmp_ps(b, zero, _CMP_LE_OQ)));
}

/// The texels to the left of or above eight positions, and how far they are behind them.
struct Cells {
  __m256i texel;
  __m256 fraction;
  __m256 on_texel;  ///< within the sampler's tolerance of a center
  __m256 nearer;    ///< to the next texel
};
HOLOMORPH_AVX2 inline __m256 mask_of(__m256d low, __m256d high) {
  const __m128 a = _mm256_castps256_ps128(_mm256_castpd_ps(low)),
               b = _mm256_extractf128_ps(_mm256_castpd_ps(low), 1),
               c = _mm256_castps256_ps128(_mm256_castpd_ps(high)),
               d = _mm256_extractf128_ps(_mm256_castpd_ps(high), 1);
  return _mm256_set_m128(_mm_shuffle_ps(c, d, 0x88), _mm_shuffle_ps(a, b, 0x88));
}
struct HalfCells {
  __m128i texel;
  __m128 fraction;
  __m256d on_texel, nearer;
};
HOLOMORPH_AVX2 inline HalfCells half_cells(__m256d position) {
  const __m256d far = _mm256_set1_pd(1e6), half = _mm256_set1_pd(0.5);
  const __m256d x =
      _mm256_sub_pd(_mm256_max_pd(_mm256_min_pd(position, far), _mm256_set1_pd(-1e6)), half);
  const __m256d whole = _mm256_floor_pd(x), t = _mm256_sub_pd(x, whole),
                near = _mm256_set1_pd(Sampler::kOnTexel),
                almost = _mm256_set1_pd(1 - Sampler::kOnTexel);
  return {_mm256_cvttpd_epi32(whole), _mm256_cvtpd_ps(t),
          _mm256_or_pd(_mm256_cmp_pd(t, near, _CMP_LT_OQ), _mm256_cmp_pd(t, almost, _CMP_GT_OQ)),
          _mm256_cmp_pd(t, half, _CMP_GT_OQ)};
}
HOLOMORPH_AVX2 inline Cells cells(const Positions& at) {
  const HalfCells low = half_cells(at.low), high = half_cells(at.high);
  return {_mm256_set_m128i(high.texel, low.texel), _mm256_set_m128(high.fraction, low.fraction),
          mask_of(low.on_texel, high.on_texel), mask_of(low.nearer, high.nearer)};
}

/// Texels with these indices, and those to the right of them. Eight loads of two texels are faster
/// than two gathers.
struct Neighbors {
  __m256i left, right;
};
HOLOMORPH_AVX2 inline Neighbors neighbors(const std::uint8_t* texels, __m256i index) {
  alignas(32) int at[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(at), index);
  const auto pair = [&](int lane) {
    double two;
    std::memcpy(&two, texels + 4 * static_cast<std::ptrdiff_t>(at[lane]), sizeof two);
    return two;
  };
  const __m256 a = _mm256_castpd_ps(_mm256_setr_pd(pair(0), pair(1), pair(4), pair(5))),
               b = _mm256_castpd_ps(_mm256_setr_pd(pair(2), pair(3), pair(6), pair(7)));
  return {_mm256_castps_si256(_mm256_shuffle_ps(a, b, 0x88)),
          _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0xdd))};
}

/// Samples the source at the positions of the lanes in `active`; the others are undefined.
HOLOMORPH_AVX2 Colors sampled(const Image& source, const Positions& u, const Positions& v,
                              __m256i active) {
  const Cells x = cells(u), y = cells(v);
  const __m256i none = _mm256_set1_epi32(-1);
  // Lanes whose four texels all lie in the source.
  const __m256i inner = _mm256_and_si256(
      _mm256_and_si256(_mm256_cmpgt_epi32(x.texel, none), _mm256_cmpgt_epi32(y.texel, none)),
      _mm256_and_si256(_mm256_cmpgt_epi32(_mm256_set1_epi32(source.width - 1), x.texel),
                       _mm256_cmpgt_epi32(_mm256_set1_epi32(source.height - 1), y.texel)));
  if (!_mm256_testc_si256(inner, active)) {
    alignas(32) double us[8], vs[8];
    alignas(32) float values[4][8];
    alignas(32) int is_active[8];
    _mm256_store_pd(us, u.low), _mm256_store_pd(us + 4, u.high);
    _mm256_store_pd(vs, v.low), _mm256_store_pd(vs + 4, v.high);
    _mm256_store_si256(reinterpret_cast<__m256i*>(is_active), active);
    const Sampler sampler(source);
    for (int lane = 0; lane < 8; ++lane) {
      const Float4 color = is_active[lane] ? sampler.at(us[lane], vs[lane]) : Float4{};
      for (int k = 0; k < 4; ++k) values[k][lane] = color[k];
    }
    return {{_mm256_load_ps(values[0]), _mm256_load_ps(values[1]), _mm256_load_ps(values[2]),
             _mm256_load_ps(values[3])}};
  }
  const __m256i index = _mm256_and_si256(
      _mm256_add_epi32(_mm256_mullo_epi32(y.texel, _mm256_set1_epi32(source.width)), x.texel),
      active);
  const Neighbors above = neighbors(source.at(0, 0), index),
                  below = neighbors(source.at(0, 0) + 4 * static_cast<size_t>(source.width), index);
  const __m256i texel[4] = {above.left, above.right, below.left, below.right};
  const __m256i every = _mm256_and_si256(_mm256_and_si256(texel[0], texel[1]),
                                         _mm256_and_si256(texel[2], texel[3])),
                any = _mm256_or_si256(_mm256_or_si256(texel[0], texel[1]),
                                      _mm256_or_si256(texel[2], texel[3]));
  const __m256i opaque = _mm256_cmpeq_epi32(_mm256_srli_epi32(every, 24), _mm256_set1_epi32(255));
  // Where a texel's center is met, the texel is copied: the other weights are 0.
  const __m256 copied = _mm256_and_ps(x.on_texel, y.on_texel), one = _mm256_set1_ps(1);
  const __m256 wx = _mm256_blendv_ps(x.fraction, _mm256_and_ps(x.nearer, one), copied),
               wy = _mm256_blendv_ps(y.fraction, _mm256_and_ps(y.nearer, one), copied);
  const __m256 rx = _mm256_sub_ps(one, wx), ry = _mm256_sub_ps(one, wy);
  const __m256 w[4] = {_mm256_mul_ps(rx, ry), _mm256_mul_ps(wx, ry), _mm256_mul_ps(rx, wy),
                       _mm256_mul_ps(wx, wy)};
  const __m256i plain = _mm256_or_si256(opaque, _mm256_castps_si256(copied));
  const __m256i clear =
      _mm256_andnot_si256(_mm256_castps_si256(copied),
                          _mm256_cmpeq_epi32(_mm256_srli_epi32(any, 24), _mm256_setzero_si256()));
  if (_mm256_testc_si256(clear, active)) return transparent();
  Colors t[4];
  for (int k = 0; k < 4; ++k) t[k] = unpacked(texel[k]);
  Colors blended;
  for (int c = 0; c < 4; ++c)
    blended.channel[c] =
        _mm256_add_ps(_mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(w[0], t[0].channel[c]),
                                                  _mm256_mul_ps(w[1], t[1].channel[c])),
                                    _mm256_mul_ps(w[2], t[2].channel[c])),
                      _mm256_mul_ps(w[3], t[3].channel[c]));
  if (_mm256_testc_si256(plain, active)) return blended;
  Colors sum = transparent();
  for (int k = 0; k < 4; ++k) {
    const __m256 weight = _mm256_mul_ps(w[k], t[k].channel[3]);
    for (int c = 0; c < 3; ++c)
      sum.channel[c] = _mm256_add_ps(sum.channel[c], _mm256_mul_ps(weight, t[k].channel[c]));
    sum.channel[3] = _mm256_add_ps(sum.channel[3], weight);
  }
  return selected(straight(sum), blended, _mm256_castsi256_ps(plain));
}

/// base + slope times the centers of eight pixels, in the order of the scalar code.
HOLOMORPH_AVX2 inline Positions along(double base, double slope, double last, __m256d low,
                                      __m256d high) {
  const __m256d from = _mm256_set1_pd(base), by = _mm256_set1_pd(slope), add = _mm256_set1_pd(last);
  return {_mm256_add_pd(_mm256_add_pd(from, _mm256_mul_pd(by, low)), add),
          _mm256_add_pd(_mm256_add_pd(from, _mm256_mul_pd(by, high)), add)};
}
HOLOMORPH_AVX2 inline Positions moved(const Positions& at, double first, double second) {
  const __m256d a = _mm256_set1_pd(first), b = _mm256_set1_pd(second);
  return {_mm256_add_pd(_mm256_add_pd(at.low, a), b), _mm256_add_pd(_mm256_add_pd(at.high, a), b)};
}

HOLOMORPH_AVX2 Colors averaged(const Image& source, const SourceMap& map, const Positions& u,
                               const Positions& v, __m256i active) {
  Colors sum = transparent();
  for (int ty = 0; ty < map.taps_y; ++ty)
    for (int tx = 0; tx < map.taps_x; ++tx) {
      const double dx = (tx + 0.5) / map.taps_x - 0.5, dy = (ty + 0.5) / map.taps_y - 0.5;
      const Colors color = sampled(source, moved(u, map.ux * dx, map.uy * dy),
                                   moved(v, map.vx * dx, map.vy * dy), active);
      for (int c = 0; c < 3; ++c)
        sum.channel[c] =
            _mm256_add_ps(sum.channel[c], _mm256_mul_ps(color.channel[3], color.channel[c]));
      sum.channel[3] = _mm256_add_ps(sum.channel[3], color.channel[3]);
    }
  const __m256 count = _mm256_set1_ps(static_cast<float>(map.taps_x * map.taps_y));
  for (__m256& channel : sum.channel) channel = _mm256_div_ps(channel, count);
  return straight(sum);
}

/// Whether eight pixels from a column on are in the row. They are then read and written as a whole,
/// which is faster than with a mask.
inline bool has_room(const PixelSpan& span, int column) {
  return column + 8 <= span.width;
}
HOLOMORPH_AVX2 inline __m256i eight_from(const int* values, __m256i lanes, bool has_room) {
  return has_room ? _mm256_loadu_si256(reinterpret_cast<const __m256i*>(values))
                  : _mm256_maskload_epi32(values, lanes);
}
HOLOMORPH_AVX2 inline void write_eight(int* out, __m256i before, __m256i pixels, __m256i lanes,
                                       bool has_room) {
  if (has_room)
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm256_blendv_epi8(before, pixels, lanes));
  else
    _mm256_maskstore_epi32(out, lanes, pixels);
}

/// The lanes of eight pixels from a column on that a span draws.
HOLOMORPH_AVX2 inline __m256i drawn_lanes(const PixelSpan& span, int column) {
  const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i within = _mm256_cmpgt_epi32(_mm256_set1_epi32(span.end - column), lanes);
  const __m256i slots = eight_from(span.slots + column, within, has_room(span, column));
  __m256i drawn = _mm256_cmpeq_epi32(slots, _mm256_set1_epi32(kFree));
  if (!span.outside)
    drawn = _mm256_or_si256(drawn, _mm256_cmpeq_epi32(slots, _mm256_set1_epi32(kInCage)));
  return _mm256_and_si256(drawn, within);
}

HOLOMORPH_AVX2 inline bool is_transparent(__m256i pixels) {
  return _mm256_testz_si256(pixels, _mm256_set1_epi32(static_cast<int>(0xff000000u)));
}

HOLOMORPH_AVX2 void draw_eights(const Image& source, const SourceMap& map, const PixelSpan& span) {
  const double y = span.row + 0.5, uy = map.uy * y, vy = map.vy * y;
  const __m256d low = _mm256_setr_pd(0.5, 1.5, 2.5, 3.5), high = _mm256_setr_pd(4.5, 5.5, 6.5, 7.5);
  for (int column = span.begin; column < span.end; column += 8) {
    const __m256i active = drawn_lanes(span, column);
    if (_mm256_testz_si256(active, active)) continue;
    const __m256d first = _mm256_set1_pd(column), x = _mm256_add_pd(first, low),
                  next = _mm256_add_pd(first, high);
    const Positions u = along(map.u0, map.ux, uy, x, next), v = along(map.v0, map.vx, vy, x, next);
    Colors colors = map.taps_x * map.taps_y == 1 ? sampled(source, u, v, active)
                                                 : averaged(source, map, u, v, active);
    int* out = reinterpret_cast<int*>(span.pixels) + column;
    const bool whole = has_room(span, column);
    const __m256i below = eight_from(out, active, whole);
    if (!is_transparent(_mm256_and_si256(below, active)))
      colors = composited(colors, unpacked(below));
    write_eight(out, below, packed(colors), active, whole);
  }
}

HOLOMORPH_AVX2 void copy_eights(const std::uint8_t* texels, const PixelSpan& span) {
  for (int column = span.begin; column < span.end; column += 8) {
    const __m256i active = drawn_lanes(span, column);
    if (_mm256_testz_si256(active, active)) continue;
    const __m256i texel =
        _mm256_maskload_epi32(reinterpret_cast<const int*>(texels) + (column - span.begin), active);
    int* out = reinterpret_cast<int*>(span.pixels) + column;
    const bool whole = has_room(span, column);
    const __m256i below = eight_from(out, active, whole);
    const bool is_first = is_transparent(_mm256_and_si256(below, active));
    write_eight(out, below, is_first ? texel : packed(composited(unpacked(texel), unpacked(below))),
                active, whole);
  }
}

#undef HOLOMORPH_AVX2

}  // namespace

SpanDrawer span_drawer_avx2() {
  return __builtin_cpu_supports("avx2") ? SpanDrawer{draw_eights, copy_eights} : kPortableSpans;
}

}  // namespace holomorph

#else

namespace holomorph {

SpanDrawer span_drawer_avx2() {
  return kPortableSpans;
}

}  // namespace holomorph

#endif
