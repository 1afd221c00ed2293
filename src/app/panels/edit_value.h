// Connects controls to edits of the displayed deformation.
#pragma once

#include "app/look/numbers.h"
#include "core/maps/method.h"
#include "edit/workspace.h"

namespace holomorph {

/// Shows an edit while a control moves, and commits it as one step when the control is released.
/// `edit` returns the edited deformation, given the one that is displayed.
template <class Edit>
void apply_change(Workspace& workspace, const Change& change, const std::string& step, Edit edit) {
  if (change.changed) workspace.shown.preview = edit(workspace.shown.base());
  if (change.ended && workspace.shown.preview)
    workspace.commit(step, Deformation(*workspace.shown.preview));
}

/// The value of a parameter as the interface shows it: in percent, from 0 to 100 along a
/// logarithmic scale, or as it is. With its range and unit.
struct DisplayedParameter {
  double value = 0;
  Number number;
};
DisplayedParameter displayed(const ParameterSpec& spec, double value);
/// The parameter's value for a displayed one.
double parameter_of(const ParameterSpec& spec, double displayed);

/// Draws a slider for a parameter of a method.
void parameter_row(Workspace& workspace, const Method& method, const ParameterSpec& spec);

}  // namespace holomorph
