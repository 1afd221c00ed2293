#include "raster/picture_rows.h"

#include <array>
#include <cmath>
#include <optional>

namespace holomorph {
namespace {

/// Columns and rows to add to those of the output to get the texels that a span shows, if it shows
/// texels of one row in their order, none of them blended with others.
struct TexelOffset {
  int column = 0, row = 0;
};
std::optional<TexelOffset> texel_offset(const SourceMap& map, const PixelSpan& span) {
  constexpr double kOff = 0.5e-3;  // half of what the sampler allows
  if (map.taps_x * map.taps_y != 1) return {};
  const double length = span.end - 1 - span.begin;
  if (length * std::max(std::abs(map.ux - 1), std::abs(map.vx)) > 2 * kOff) return {};
  const auto offset_at = [&](int column) {
    const double x = column + 0.5, y = span.row + 0.5;
    return std::array{map.u0 + map.ux * x + map.uy * y - x, map.v0 + map.vx * x + map.vy * y - y};
  };
  const auto first = offset_at(span.begin), last = offset_at(span.end - 1);
  const double column = std::round(first[0]), row = std::round(first[1]);
  for (const auto& [du, dv] : {first, last})
    if (!(std::abs(du - column) < kOff && std::abs(dv - row) < kOff)) return {};
  constexpr double kFar = 1e6;
  if (!(std::abs(column) < kFar && std::abs(row) < kFar)) return {};
  return TexelOffset{static_cast<int>(column), static_cast<int>(row)};
}

template <class Channel>
Float4 sampled(const Image& source, const SourceMap& map, int column, int row) {
  const double x = column + 0.5, y = row + 0.5;
  const double u = map.u0 + map.ux * x + map.uy * y, v = map.v0 + map.vx * x + map.vy * y;
  const SamplerOf<Channel> sampler(source);
  if (map.taps_x * map.taps_y == 1) return sampler.at(u, v);
  Float4 sum{};
  for (int ty = 0; ty < map.taps_y; ++ty)
    for (int tx = 0; tx < map.taps_x; ++tx) {
      const double dx = (tx + 0.5) / map.taps_x - 0.5, dy = (ty + 0.5) / map.taps_y - 0.5;
      Float4 color = sampler.at(u + map.ux * dx + map.uy * dy, v + map.vx * dx + map.vy * dy);
      const float alpha = color[3];
      color[3] = 1;
      sum += alpha * color;
    }
  return Sampler::straight(sum / static_cast<float>(map.taps_x * map.taps_y));
}

}  // namespace

Float4 source_color(const Image& source, const SourceMap& map, int column, int row) {
  return sampled<std::uint8_t>(source, map, column, row);
}

Float4 fine_source_color(const Image& source, const SourceMap& map, int column, int row) {
  return source.fine.empty() ? sampled<std::uint8_t>(source, map, column, row)
                             : sampled<float>(source, map, column, row);
}

void draw_span(const Image& source, const SourceMap& map, const PixelSpan& span) {
  for (int column = span.begin; column < span.end; ++column)
    if (span.draws(column))
      draw_pixel(source_color(source, map, column, span.row),
                 span.pixels + 4 * static_cast<std::ptrdiff_t>(column));
}

void copy_span(const std::uint8_t* texels, const PixelSpan& span) {
  for (int column = span.begin; column < span.end; ++column, texels += 4)
    if (span.draws(column))
      draw_pixel(load(texels), span.pixels + 4 * static_cast<std::ptrdiff_t>(column));
}

void draw_span_fast(const Image& source, const SourceMap& map, const PixelSpan& span) {
  if (span.begin >= span.end) return;
  static const SpanDrawer drawer = span_drawer_avx2();
  const auto by = texel_offset(map, span);
  const int row = by ? span.row + by->row : -1;
  if (row < 0 || row >= source.height) return drawer.draw(source, map, span);
  PixelSpan before = span, copied = span, after = span;
  copied.begin = before.end = std::clamp(-by->column, span.begin, span.end);
  copied.end = after.begin = std::clamp(source.width - by->column, copied.begin, span.end);
  drawer.draw(source, map, before);
  if (copied.begin < copied.end) drawer.copy(source.at(copied.begin + by->column, row), copied);
  drawer.draw(source, map, after);
}

}  // namespace holomorph
