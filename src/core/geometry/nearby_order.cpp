// A counting sort by cell. The number of a cell interleaves the bits of its column and its row.
#include "core/geometry/nearby_order.h"

#include <cstdint>

namespace holomorph {
namespace {

/// Puts a zero in front of each bit of a number below 1024.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 8) & 0x00ff00ff;
  x = (x | x << 4) & 0x0f0f0f0f;
  x = (x | x << 2) & 0x33333333;
  return (x | x << 1) & 0x55555555;
}

}  // namespace

std::vector<Index> nearby_order(std::span<const Complex> points) {
  constexpr int kMostBits = 10;  // of a column or row
  int bits = 0;
  while (bits < kMostBits && (size_t{1} << (2 * bits + 1)) < points.size()) ++bits;
  const Box box = box_of(points);
  const double side = static_cast<double>(1 << bits),
               scale = side / std::max({box.width(), box.height(), 1e-300});
  const auto cell = [&](double offset) {
    return static_cast<std::uint32_t>(std::clamp(offset * scale, 0.0, side - 1));
  };
  std::vector<std::uint32_t> cells;
  cells.reserve(points.size());
  std::vector<Index> starts((size_t{1} << (2 * bits)) + 1, 0);
  for (const Complex& z : points) {
    cells.push_back(spread_bits(cell(z.real() - box.left)) |
                    spread_bits(cell(z.imag() - box.bottom)) << 1);
    ++starts[cells.back() + 1];
  }
  for (size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
  std::vector<Index> order(points.size());
  for (size_t i = 0; i < points.size(); ++i)
    order[static_cast<size_t>(starts[cells[i]]++)] = static_cast<Index>(i);
  return order;
}

bool are_scattered(std::span<const Complex> points) {
  constexpr size_t kFew = 128;
  constexpr double kFar = 6;
  if (points.size() < kFew) return false;
  double sum = 0;
  for (size_t i = 1; i < points.size(); ++i) sum += std::abs(points[i] - points[i - 1]);
  const double count = static_cast<double>(points.size());
  return sum / count > kFar * box_of(points).diagonal() / std::sqrt(2 * count);
}

}  // namespace holomorph
