// Key N. A press on the picture sets a pin, which can be dragged in the same gesture. A press on a
// pin selects it.
#include "edit/actions/actions.h"
#include "edit/tools/handle_tool.h"

namespace holomorph {
namespace {

class PinTool final : public HandleTool {
 public:
  ToolId id() const override { return ToolId::pin; }

  void input(const Input& input, Workspace& workspace) override {
    if (follow(input, workspace)) return;
    find(input, workspace);
    ring_.hover(input, workspace);
    if (!input.inside || !input.pressed || press(input, workspace)) return;
    if (!workspace.shown.deformation().has_cage()) {
      workspace.messages.say(needs_a_cage(workspace, "Pins need a cage"));
      return;
    }
    const auto rest = rest_at(workspace, input.position);
    if (!rest) {
      workspace.messages.say(workspace.map().busy()
                                 ? "The map is being prepared. Try again in a moment."
                                 : "Click the picture inside the cage to set a pin.");
      return;
    }
    const bool switches = !method_named(workspace.shown.deformation().method).uses_pins;
    // At rest, the pin's pose is the image of the point under the map, so adding the pin moves
    // nothing.
    const Complex pose = workspace.at_rest() ? posed_at(workspace.map(), *rest) : input.position;
    if (!workspace.commit("Add pin", with_pin(workspace.shown.deformation(), *rest, pose,
                                              workspace.keyframe_images({&*rest, 1}))))
      return;
    if (switches) workspace.messages.say(switched_to(MethodUse::pins));
    workspace.selection = {
        {Handle::Kind::pin, static_cast<Index>(workspace.shown.deformation().pins.size()) - 1, 0}};
    drag_.start_amending(input, workspace.selection, workspace.shown.deformation());
  }

  bool has_ring() const override { return true; }

  std::string hint(const Workspace& workspace) const override {
    if (!workspace.shown.deformation().has_cage())
      return needs_a_cage(workspace, "Pins need a cage");
    if (ring_.hovered() && !hover_)
      return "Drag the ring to rotate the picture around the pin; scroll on it to scale";
    return hover_ ? "Drag to move; Alt-click to delete"
                  : "Click the picture to set a pin, then drag it";
  }
};

}  // namespace

std::unique_ptr<Tool> pin_tool() {
  return std::make_unique<PinTool>();
}

}  // namespace holomorph
