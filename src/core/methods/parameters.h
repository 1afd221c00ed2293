// Functions that create the parameters in a method's table row.
#pragma once

#include "core/maps/method.h"

namespace holomorph {

inline ParameterSpec number(std::string key, std::string label, std::string hint, double fallback,
                            double lowest, double highest) {
  ParameterSpec spec{std::move(key), std::move(label), std::move(hint)};
  spec.fallback = fallback;
  spec.lowest = lowest;
  spec.highest = highest;
  return spec;
}

/// A number with a logarithmic slider.
inline ParameterSpec by_decades(std::string key, std::string label, std::string hint,
                                double fallback, double lowest, double highest) {
  ParameterSpec spec =
      number(std::move(key), std::move(label), std::move(hint), fallback, lowest, highest);
  spec.logarithmic = true;
  return spec;
}

inline ParameterSpec toggle(std::string key, std::string label, std::string hint,
                            bool fallback = false) {
  ParameterSpec spec = number(std::move(key), std::move(label), std::move(hint), fallback, 0, 1);
  spec.type = ParameterSpec::Type::toggle;
  return spec;
}

/// A choice among options; `fallback` is the index of the default.
inline ParameterSpec one_of(std::string key, std::string label, std::string hint,
                            std::vector<ParameterSpec::Option> options, size_t fallback = 0) {
  const double highest = static_cast<double>(options.size()) - 1;
  ParameterSpec spec = number(std::move(key), std::move(label), std::move(hint),
                              static_cast<double>(fallback), 0, highest);
  spec.type = ParameterSpec::Type::choice;
  spec.options = std::move(options);
  return spec;
}

/// Returns `spec`, displayed in percent.
inline ParameterSpec in_percent(ParameterSpec spec) {
  spec.percent = true;
  return spec;
}

/// Returns `spec`, limited to take effect only while the parameter `key` has this value.
inline ParameterSpec used_with(std::string key, double value, ParameterSpec spec) {
  spec.used_when = ParameterSpec::Condition{std::move(key), value};
  return spec;
}

/// The weight of mean |f_zbar|^2 for a softness from 0 to 1. For positive softness, it falls
/// exponentially from 1, which is nearly conformal, to 0.001. Softness 0 requires f_zbar = 0
/// exactly, and the returned weight is 0.
inline double stiffness_of(double softness) {
  return softness > 0 ? std::pow(10.0, -3 * softness) : 0;
}

}  // namespace holomorph
