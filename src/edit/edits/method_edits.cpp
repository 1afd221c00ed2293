// The switch is stored as the method `bounded`; see method_edits.h.
#include "edit/edits/method_edits.h"

#include <algorithm>

#include "core/error.h"

namespace holomorph {
namespace {

const Method& bounded() {
  return usual_method(MethodUse::bounds);
}
const std::string kReference = "reference";

/// The number of a method among those that `bounded` can follow; none if it cannot.
std::optional<double> reference_to(const std::string& id) {
  for (const ParameterSpec& spec : bounded().parameters) {
    if (spec.key != kReference) continue;
    const auto found = std::ranges::find(spec.options, id, &ParameterSpec::Option::id);
    if (found != spec.options.end()) return static_cast<double>(found - spec.options.begin());
  }
  return {};
}

}  // namespace

const Method& chosen_method(const Deformation& deformation) {
  return followed_method(method_named(deformation.method), deformation.parameters);
}

bool prevents_folds(const Deformation& deformation) {
  return method_named(deformation.method).follows_others;
}

bool can_prevent_folds(const Method& method) {
  return !method.never_folds && reference_to(method.id).has_value();
}

bool has_method_for(const Deformation& deformation, MethodUse use) {
  return chosen_method(deformation).id == usual_method(use).id;
}

Deformation with_method_for(Deformation deformation, MethodUse use) {
  return with_method(std::move(deformation), usual_method(use).id);
}

Deformation with_chosen_method(Deformation deformation, const std::string& id) {
  if (chosen_method(deformation).id == id) return deformation;
  // While another method is used, the explicit parameter `reference` of `bounded` means that folds
  // were prevented before.
  const auto& others = deformation.other_parameters;
  const auto kept = others.find(bounded().id);
  const bool had_switch = can_prevent_folds(chosen_method(deformation));
  const bool prevents = prevents_folds(deformation) ||
                        (!had_switch && kept != others.end() && kept->second.contains(kReference));
  if (prevents && can_prevent_folds(method_named(id))) {
    deformation = with_method(std::move(deformation), bounded().id);
    deformation.parameters[kReference] = *reference_to(id);
    return deformation;
  }
  if (prevents_folds(deformation))
    deformation.parameters[kReference] = *reference_to(chosen_method(deformation).id);
  return with_method(std::move(deformation), id);
}

Deformation with_folds_prevented(Deformation deformation, bool on) {
  const std::string id = chosen_method(deformation).id;
  if (on == prevents_folds(deformation) || !can_prevent_folds(method_named(id))) return deformation;
  if (on) {
    deformation = with_method(std::move(deformation), bounded().id);
    deformation.parameters[kReference] = *reference_to(id);
    return deformation;
  }
  deformation.parameters.erase(kReference);
  return with_method(std::move(deformation), id);
}

const Parameters& chosen_parameters(const Deformation& deformation) {
  static const Parameters none;
  const std::string& id = chosen_method(deformation).id;
  if (id == deformation.method) return deformation.parameters;
  const auto found = deformation.other_parameters.find(id);
  return found == deformation.other_parameters.end() ? none : found->second;
}

Deformation with_parameter(Deformation deformation, const std::string& method,
                           const std::string& key, double value) {
  if (method == deformation.method)
    deformation.parameters[key] = value;
  else
    deformation.other_parameters[method][key] = value;
  return deformation;
}

Deformation with_preset(Deformation deformation, const Preset& preset) {
  for (const Preset& other : method_named(deformation.method).presets)
    for (const auto& entry : other.parameters) deformation.parameters.erase(entry.first);
  for (const auto& [key, value] : preset.parameters) deformation.parameters[key] = value;
  return deformation;
}

}  // namespace holomorph
