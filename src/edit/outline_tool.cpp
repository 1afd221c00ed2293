// O: an outline is drawn in one go, closed and smoothed when it is let go; the picture's shape goes
// onto it.
#include "core/outline_match.h"
#include "edit/freehand.h"
#include "edit/tool.h"

namespace holomorph {
namespace {

constexpr double kStepPx = 4, kShortestPx = 60;

class OutlineTool final : public Tool {
 public:
  ToolId id() const override { return ToolId::outline; }

  void input(const Input& input, Workspace& workspace) override {
    if (drawing_.active()) {
      if (drawing_.follow(input)) finish(workspace);
      return;
    }
    if (!input.pressed) return;
    if (!workspace.scene().has_cage())
      return workspace.say("The outline is for the cage's shape: make a cage first.");
    drawing_.start(input);
  }

  void cancel(Workspace&) override { drawing_.cancel(); }
  bool key(Key key, Workspace& workspace) override {
    if (key != Key::escape || !drawing_.active()) return false;
    cancel(workspace);
    return true;
  }
  bool busy() const override { return drawing_.active(); }
  ToolOverlay overlay() const override {
    ToolOverlay overlay;
    overlay.line = drawing_.line();
    if (drawing_.active()) overlay.line_end = overlay.line.front();
    return overlay;
  }
  std::string hint(const Workspace& workspace) const override {
    if (!workspace.scene().has_cage()) return "Make a cage first: its shape goes onto the outline";
    return drawing_.active() ? "Let go to close the outline; Esc gives it up"
                             : "Drag to draw the outline that the picture's shape goes onto";
  }

 private:
  void finish(Workspace& workspace) {
    Scene scene = workspace.scene();
    scene.outline = drawing_.finish(true, kStepPx, kShortestPx, workspace.viewport);
    if (scene.outline.empty())
      return workspace.say("Keep the button down and draw all around the new shape.");
    try {
      check_outline(scene.outline);
    } catch (const Error& error) {
      workspace.complain(error);
      return;
    }
    if (scene.method != "outline") scene = with_method(std::move(scene), "outline");
    workspace.layer = Layer::pose;
    if (workspace.commit("Draw outline", scene)) workspace.playback = {0, true};
  }

  Freehand drawing_;
};

}  // namespace

std::unique_ptr<Tool> outline_tool() {
  return std::make_unique<OutlineTool>();
}

}  // namespace holomorph
