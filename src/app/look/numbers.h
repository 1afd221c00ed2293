// Controls for numbers: sliders, fields and steppers.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "app/look/items.h"

namespace holomorph {

/// What the user did with a control in this frame. `ended` is set when a change is complete: the
/// pointer was released, or typing ended.
struct Change {
  bool changed = false, ended = false;
  explicit operator bool() const { return changed; }
};

/// The values that a number can have, and how it is written.
struct Number {
  double low = -HUGE_VAL, high = HUGE_VAL;
  const char* unit = "";
  int decimals = 0;
  bool logarithmic = false;
  std::optional<double> neutral = {};  ///< what a double click on the label sets
  double typed = 0;  ///< if not 0, numbers from -typed to typed can be typed, beyond the slider
  double speed = 0;  ///< change per px while the field is dragged; 0: depends on the range
};

/// A label, a slider and a field with the number. Dragging the label also changes the value.
Change slider_row(const std::string& label, double& value, const Number& number,
                  const std::string& hint = "");
/// A slider without a label, and its field. `name` is not displayed.
Change slider(const std::string& name, double& value, const Number& number, float width);
/// A field with a number. It can be dragged, or clicked to type. `prefix` is drawn at its left.
Change number_field(const std::string& name, double& value, const Number& number, float width,
                    const std::string& prefix = "");
/// A label and a field for a number.
Change number_row(const std::string& label, double& value, const Number& number,
                  const std::string& hint = "");

/// Buttons that subtract and add 1, with the number between them.
Change stepper(const std::string& name, double& value, const Number& number, float width);

}  // namespace holomorph
