// Heat maps: the quantity that a view shows, its range, and its colors.
//
// The sequential color map is viridis (matplotlib, CC0). The diverging color map is ColorBrewer's
// RdBu. Both are readable with every common color-vision deficiency.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/maps/distortion.h"

namespace holomorph {

/// What the canvas or a rendered picture shows.
enum class View { image, angle, area, stretch, checker };

inline constexpr std::array<const char*, 5> kViewNames{"image", "angle", "area", "stretch",
                                                       "checker"};
/// The view with this name. Throws an Error that lists the valid names.
View view_named(const std::string& name);

/// Whether a view shows the distortion of the map. Such a view requires derivatives.
inline bool is_heat(View view) {
  return view == View::angle || view == View::area || view == View::stretch;
}

/// A range of values and the colors over it.
struct HeatScale {
  double low = 0, high = 1;
  bool diverging = false;
  std::string label;
};

/// The quantity that a view shows at each sample: k, log2 of the area, or log2 of the largest
/// stretch. At folded samples, k is at least 1 and the other two are infinite.
Eigen::VectorXd heat_values(View view, const Distortion& distortion);

/// The fixed scale of a view or, when `automatic`, a scale that spans the finite values.
HeatScale heat_scale(View view, const Eigen::VectorXd& values, bool automatic);

using Color = std::array<float, 3>;
/// The color at `t` in [0, 1] (clamped).
Color heat_color(double t, bool diverging);
/// Position of a value on a scale, clamped to [0, 1]. NaN maps to 1.
double heat_position(const HeatScale& scale, double value);

}  // namespace holomorph
