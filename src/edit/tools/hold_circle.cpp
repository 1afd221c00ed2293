#include "edit/tools/hold_circle.h"

#include "edit/frame.h"
#include "edit/input.h"

namespace holomorph {

void HoldCircle::hover(const Input& input, const Workspace& workspace) {
  if (active_) return;
  pin_.reset();
  const Deformation& deformation = workspace.shown.deformation();
  if (!input.inside || !deformation.held_beyond || !can_choose_frame(workspace)) return;
  const double reach = 0.6 * workspace.display.handle_px / workspace.layer_view().zoom;
  for (size_t i = 0; i < deformation.pins.size(); ++i)
    if (std::abs(std::abs(input.position - deformation.pins[i].rest) - *deformation.held_beyond) <
        reach)
      pin_ = i;
}

void HoldCircle::start(const Input& input, const Workspace& workspace) {
  active_ = true;
  start_deformation_ = workspace.shown.deformation();
  start_distance_ = std::abs(input.position - start_deformation_.pins[*pin_].rest);
}

void HoldCircle::follow(const Input& input, Workspace& workspace) {
  const double by =
      std::abs(input.position - start_deformation_.pins[*pin_].rest) - start_distance_;
  if (by != 0)
    workspace.shown.preview = held_beyond(start_deformation_, *start_deformation_.held_beyond + by);
  if (input.down && !input.released) return;
  active_ = false;
  if (workspace.shown.preview) workspace.commit("Hold the rest", *workspace.shown.preview);
}

void HoldCircle::cancel(Workspace& workspace) {
  if (active_) workspace.shown.preview.reset();
  active_ = false;
  pin_.reset();
}

}  // namespace holomorph
