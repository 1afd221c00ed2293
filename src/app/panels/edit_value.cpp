// Parameters are shown in numbers that an artist reads.
#include "app/panels/edit_value.h"

#include <algorithm>
#include <cmath>

#include "app/look/controls.h"
#include "edit/edits/method_edits.h"

namespace holomorph {
namespace {

double value_of(const Deformation& deformation, const Method& method, const ParameterSpec& spec) {
  if (deformation.method == method.id) return parameter(method, deformation.parameters, spec.key);
  return parameter(method, chosen_parameters(deformation), spec.key);
}

void choice_row(Workspace& workspace, const Method& method, const ParameterSpec& spec) {
  const Deformation deformation = workspace.shown.deformation();
  const auto chosen = static_cast<size_t>(value_of(deformation, method, spec));
  row_label(spec.label, spec.hint);
  std::optional<size_t> clicked;
  if (spec.options.size() <= 3) {
    std::vector<std::string> names;
    for (const auto& option : spec.options) names.push_back(option.label);
    clicked = segmented(spec.label, names, chosen, ImGui::GetContentRegionAvail().x);
  } else if (begin_dropdown("##" + spec.label, spec.options[chosen].label)) {
    for (size_t i = 0; i < spec.options.size(); ++i)
      if (dropdown_row(spec.options[i].label, i == chosen)) clicked = i;
    end_dropdown();
  }
  if (clicked)
    workspace.commit(
        spec.label + ": " + spec.options[*clicked].label,
        with_parameter(deformation, method.id, spec.key, static_cast<double>(*clicked)));
}

}  // namespace

DisplayedParameter displayed(const ParameterSpec& spec, double value) {
  if (spec.percent)
    return {100 * value,
            {100 * spec.lowest, 100 * spec.highest, "%", 0, spec.logarithmic, 100 * spec.fallback}};
  const auto along = [&](double v) {
    return 100 * std::log(v / spec.lowest) / std::log(spec.highest / spec.lowest);
  };
  if (spec.logarithmic)
    return {std::round(10 * along(value)) / 10, {0, 100, "", 0, false, along(spec.fallback)}};
  constexpr double kWide = 10;  // a range whose values need no decimals
  const int decimals = spec.highest - spec.lowest < kWide ? 2 : 0;
  return {value, {spec.lowest, spec.highest, "", decimals, false, spec.fallback}};
}

double parameter_of(const ParameterSpec& spec, double displayed) {
  double value = displayed;
  if (spec.percent)
    value = displayed / 100;
  else if (spec.logarithmic)
    value = spec.lowest * std::pow(spec.highest / spec.lowest, displayed / 100);
  return std::clamp(value, spec.lowest, spec.highest);
}

void parameter_row(Workspace& workspace, const Method& method, const ParameterSpec& spec) {
  if (spec.type == ParameterSpec::Type::choice) return choice_row(workspace, method, spec);
  const Deformation deformation = workspace.shown.deformation();
  const double value = value_of(deformation, method, spec);
  if (spec.type == ParameterSpec::Type::toggle) {
    if (switch_row(spec.label, value != 0, spec.hint))
      workspace.commit(spec.label,
                       with_parameter(deformation, method.id, spec.key, value != 0 ? 0 : 1));
    return;
  }
  DisplayedParameter shown = displayed(spec, value);
  const Change change = slider_row(spec.label, shown.value, shown.number, spec.hint);
  apply_change(workspace, change, spec.label, [&](const Deformation& base) {
    return with_parameter(base, method.id, spec.key, parameter_of(spec, shown.value));
  });
}

}  // namespace holomorph
