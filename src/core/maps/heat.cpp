// Piecewise linear color maps over nine anchors.
#include "core/maps/heat.h"

#include "core/error.h"

namespace holomorph {
namespace {

constexpr std::array<unsigned, 9> kSequential{0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                              0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};
constexpr std::array<unsigned, 9> kDiverging{0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7,
                                             0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b};

}  // namespace

View view_named(const std::string& name) {
  std::string known;
  for (size_t i = 0; i < kViewNames.size(); ++i) {
    if (name == kViewNames[i]) return static_cast<View>(i);
    known += (i ? ", " : "") + std::string(kViewNames[i]);
  }
  throw Error(ErrorKind::bad_input, "there is no view '" + name + "'; choose one of: " + known);
}

Eigen::VectorXd heat_values(View view, const Distortion& distortion) {
  if (view == View::angle) return distortion.k;
  if (view == View::area) return distortion.area;
  return distortion.stretch.array().log() / std::log(2.0);
}

HeatScale heat_scale(View view, const Eigen::VectorXd& values, bool automatic) {
  HeatScale scale;
  if (view == View::angle) scale = {0, 1, false, "angle distortion k"};
  if (view == View::area) scale = {-2, 2, true, "area (log2)"};
  if (view == View::stretch) scale = {0, 2, false, "largest stretch (log2)"};
  if (!automatic) return scale;
  double low = 1e300, high = -1e300;
  for (const double value : values)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  if (low > high) return scale;
  if (scale.diverging) {  // keep 0, which means no change, in the middle
    high = std::max({std::abs(low), std::abs(high), 1e-3});
    low = -high;
  } else {
    low = 0;
    high = std::max(high, 1e-3);
  }
  return {low, high, scale.diverging, scale.label};
}

Color heat_color(double t, bool diverging) {
  const auto& anchors = diverging ? kDiverging : kSequential;
  const double x = std::clamp(t, 0.0, 1.0) * (anchors.size() - 1);
  const size_t i = std::min<size_t>(static_cast<size_t>(x), anchors.size() - 2);
  Color color;
  for (int c = 0; c < 3; ++c) {
    const int shift = 16 - 8 * c;
    const double a = (anchors[i] >> shift) & 255, b = (anchors[i + 1] >> shift) & 255;
    color[c] = static_cast<float>((a + (x - static_cast<double>(i)) * (b - a)) / 255);
  }
  return color;
}

double heat_position(const HeatScale& scale, double value) {
  const double t = (value - scale.low) / (scale.high - scale.low);
  return std::isnan(t) ? 1.0 : std::clamp(t, 0.0, 1.0);
}

}  // namespace holomorph
