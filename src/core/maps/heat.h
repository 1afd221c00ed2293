// Heat maps: which quantity a view shows, its range, and the colors.
//
// Sequential maps follow viridis (matplotlib, CC0), the diverging one ColorBrewer's RdBu; both are
// readable with every common color-vision deficiency.
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
/// The view of this name; throws Error listing the names.
View view_named(const std::string& name);

/// Whether a view shows a quantity of the map and so needs derivatives.
inline bool is_heat(View view) {
  return view == View::angle || view == View::area || view == View::stretch;
}

/// A range of values and the colors over it.
struct HeatScale {
  double low = 0, high = 1;
  bool diverging = false;
  std::string label;
};

/// What a view shows per sample: k; log2 of the area; log2 of the largest stretch. Folded samples
/// are at +-infinity or one.
Eigen::VectorXd heat_values(View view, const Distortion& distortion);

/// The fixed scale of a view, or one that spans the finite values when `automatic`.
HeatScale heat_scale(View view, const Eigen::VectorXd& values, bool automatic);

using Color = std::array<float, 3>;
/// The color at `t` in [0, 1] (clamped).
Color heat_color(double t, bool diverging);
/// Position of a value on a scale, clamped to [0, 1]; not-a-number counts as the far end.
double heat_position(const HeatScale& scale, double value);

}  // namespace holomorph
