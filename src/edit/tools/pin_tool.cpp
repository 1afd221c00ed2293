// N: a click on the picture sets a pin and goes on dragging it; a click on a pin picks it.
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
      workspace.messages.say(needs_a_cage(workspace, "Pins act inside a cage"));
      return;
    }
    const auto rest = rest_at(workspace, input.position);
    if (!rest) {
      workspace.messages.say(workspace.map().busy()
                                 ? "One moment, the map is being prepared."
                                 : "A pin goes on the picture, inside the cage.");
      return;
    }
    const bool switches = !method_named(workspace.shown.deformation().method).uses_pins;
    // At rest a pin's pose is where the picture is posed, so that adding it moves nothing.
    const Complex pose = workspace.at_rest() ? posed_at(workspace.map(), *rest) : input.position;
    if (!workspace.commit("Add pin", with_pin(workspace.shown.deformation(), *rest, pose,
                                              workspace.in_keyframes({&*rest, 1}))))
      return;
    if (switches)
      workspace.messages.say("The method is \"Cage and pins\": cage points and pins act together.");
    workspace.selection = {
        {Handle::Kind::pin, static_cast<Index>(workspace.shown.deformation().pins.size()) - 1, 0}};
    drag_.start_amending(input, workspace.selection, workspace.shown.deformation());
  }

  std::string hint(const Workspace& workspace) const override {
    if (!workspace.shown.deformation().has_cage())
      return needs_a_cage(workspace, "Pins act inside a cage");
    if (ring_.hovered() && !hover_)
      return "Drag the ring to turn the picture around the pin, scroll on it to scale";
    return hover_ ? "Drag to move; Alt-click deletes"
                  : "Click on the picture to set a pin, and drag it";
  }
};

}  // namespace

std::unique_ptr<Tool> pin_tool() {
  return std::make_unique<PinTool>();
}

}  // namespace holomorph
