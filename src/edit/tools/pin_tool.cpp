// Key N. A press on the picture sets a pin, which can be dragged in the same gesture. A press on a
// pin selects it.
#include "core/geometry/polyline.h"
#include "edit/actions/actions.h"
#include "edit/frame.h"
#include "edit/hold_rest.h"
#include "edit/picture_cage.h"
#include "edit/tools/handle_tool.h"
#include "edit/tools/hold_circle.h"

namespace holomorph {
namespace {

class PinTool final : public HandleTool {
 public:
  ToolId id() const override { return ToolId::pin; }

  /// A new pin needs the map of the pose that the user sees.
  bool waits(const Input& input, const Workspace& workspace) const override {
    if (workspace.knows_map() || handle_at(workspace, input.px)) return false;
    PinRing ring = ring_;
    ring.hover(input, workspace);
    HoldCircle circle = circle_;
    circle.hover(input, workspace);
    return !ring.hovered() && !circle.hovered();
  }

  void input(const Input& input, Workspace& workspace) override {
    if (circle_.active()) return circle_.follow(input, workspace);
    if (follow(input, workspace)) return;
    find(input, workspace);
    ring_.hover(input, workspace);
    circle_.hover(input, workspace);
    if (input.inside && input.pressed && on_circle()) return circle_.start(input, workspace);
    if (!input.inside || !input.pressed || press(input, workspace)) return;
    if (!workspace.shown.deformation().has_cage()) return set_first(input, workspace);
    const auto rest = rest_at(workspace, input.position);
    if (!rest) {
      workspace.messages.say(workspace.map().busy()
                                 ? "The map is being prepared. Try again in a moment."
                                 : "Click the picture inside the cage to set a pin.");
      return;
    }
    if (!workspace.require_keyframe_maps()) return;
    const std::string method = workspace.shown.deformation().method;
    // At rest, the pin's pose is the image of the point under the map, so adding the pin moves
    // nothing.
    const Complex pose = workspace.at_rest() ? posed_at(workspace.map(), *rest) : input.position;
    Deformation pinned = with_pin(workspace.shown.deformation(), *rest, pose,
                                  workspace.keyframe_images({&*rest, 1}));
    if (pinned.method != method) pinned = with_usual_frame(workspace, std::move(pinned));
    if (!workspace.commit("Add pin", std::move(pinned))) return;
    if (const std::string& now = workspace.shown.deformation().method; now != method)
      workspace.messages.say("Switched to " + method_named(now).label + ".");
    hold_last(input, workspace);
  }

  void cancel(Workspace& workspace) override {
    HandleTool::cancel(workspace);
    circle_.cancel(workspace);
    coming_.reset();
  }
  bool busy() const override { return HandleTool::busy() || circle_.active(); }
  bool has_ring() const override { return true; }
  ToolOverlay overlay() const override {
    ToolOverlay overlay = HandleTool::overlay();
    if (coming_) overlay.coming_pins.push_back(*coming_);
    return overlay;
  }

  std::string hint(const Workspace& workspace) const override {
    if (!workspace.shown.deformation().has_cage())
      return workspace.document.image()
                 ? "Click the picture to set a pin. The first pin also makes the cage"
                 : needs_a_cage(workspace, "Pins need a cage");
    if (ring_.active() || (ring_.hovered() && !hover_)) return ring_.hint(workspace);
    if (circle_.active() || on_circle())
      return "Drag the circle to choose how much of the picture may move";
    if (can_hold_rest(workspace) && !drag_.active())
      return can_choose_frame(workspace)
                 ? "Click parts that should stay, or press 'Hold the rest'"
                 : "One pin moves the whole picture. Click parts that should stay, or press 'Hold "
                   "the rest'";
    return hover_ ? "Drag to move; Alt-click to delete"
                  : "Click the picture to set a pin, then drag it";
  }

 private:
  /// Selects the newest pin and starts to drag it.
  void hold_last(const Input& input, Workspace& workspace) {
    workspace.selection = {
        {Handle::Kind::pin, static_cast<Index>(workspace.shown.deformation().pins.size()) - 1, 0}};
    drag_.start_amending(input, workspace.selection, workspace.shown.deformation());
    ring_.hover(input, workspace);  // shows the ring of this pin
  }

  /// Makes the cage from the picture and sets a pin in it, in one step.
  void set_first(const Input& input, Workspace& workspace) {
    if (!workspace.document.image())
      return workspace.messages.say(needs_a_cage(workspace, "Pins need a cage"));
    coming_ = input.px;
    const Method& method = method_of_first_pin(workspace);
    make_picture_cage(workspace, method, true, [this, input, &workspace](Cage cage) {
      coming_.reset();
      if (!encloses(outline_of(cage), input.position)) {
        workspace.messages.say("There is nothing here. Click the picture to set a pin.");
        return false;
      }
      const Deformation caged = with_cage(workspace.shown.own(), std::move(cage));
      Scene scene = with_deformation(
          workspace.document.scene(),
          with_usual_frame(workspace, with_pin(caged, input.position, input.position, {})));
      // Inside a frame, nothing leaves a gap that the original would have to fill.
      if (scene.deformation().frame != Frame::free) scene = without_original(std::move(scene));
      if (!workspace.commit_layers("Add pin", std::move(scene))) return false;
      hold_last(input, workspace);
      return true;
    });
  }

  bool on_circle() const { return circle_.hovered() && !hover_ && !ring_.hovered(); }

  HoldCircle circle_;
  std::optional<Complex> coming_;  ///< where the first pin will be, in window px
};

}  // namespace

std::unique_ptr<Tool> pin_tool() {
  return std::make_unique<PinTool>();
}

}  // namespace holomorph
