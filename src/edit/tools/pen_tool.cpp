// Key P. Draws a cage point by point, inserts points in the edges of a finished cage, and moves its
// points.
#include "edit/actions/actions.h"
#include "edit/tools/handle_tool.h"
#include "edit/tools/pen_path.h"

namespace holomorph {
namespace {

class PenTool final : public HandleTool {
 public:
  ToolId id() const override { return ToolId::pen; }

  void input(const Input& input, Workspace& workspace) override {
    if (follow(input, workspace)) return;
    if (path_.active()) {
      if (path_.follow(input, workspace.display.viewport, workspace.display.handle_px))
        close(workspace);
      return;
    }
    hover_.reset();
    insertion_.reset();
    if (input.inside) idle(input, workspace);
  }

  bool key(Key key, Workspace& workspace) override {
    if (!path_.active()) return HandleTool::key(key, workspace);
    const PenPath::Answer answer = path_.key(key);
    if (answer == PenPath::Answer::close) close(workspace);
    if (answer == PenPath::Answer::too_few)
      workspace.messages.say("A cage needs at least three points.");
    return answer != PenPath::Answer::ignored;
  }

  void cancel(Workspace& workspace) override {
    HandleTool::cancel(workspace);
    path_.cancel();
    insertion_.reset();
  }
  bool busy() const override { return HandleTool::busy() || path_.active(); }

  ToolOverlay overlay() const override {
    ToolOverlay overlay = HandleTool::overlay();
    path_.show(overlay);
    overlay.insertion = insertion_;
    return overlay;
  }

  std::string hint(const Workspace& workspace) const override {
    if (path_.active() && path_.closes()) return "Click to close the cage";
    if (path_.active())
      return "Click for a corner, drag for a smooth point; click the first point, press Enter or "
             "double-click to close; Backspace removes the last point; Esc cancels";
    if (!workspace.shown.deformation().has_cage()) return "Click around the picture to draw a cage";
    if (insertion_) return "Click to insert a point; rest shape and pose do not change";
    return "Click an edge to insert a point; click elsewhere to draw another cage instead of this "
           "one";
  }

 private:
  /// Handles input while no path is being drawn.
  void idle(const Input& input, Workspace& workspace) {
    const Deformation& deformation = workspace.shown.deformation();
    if (deformation.has_cage()) {
      find(input, workspace);
      if (hover_) {
        if (input.pressed) press(input, workspace);
        return;
      }
      if (const auto hit = edge_at(workspace, input.px)) {
        insertion_ = hit->point;
        if (!input.pressed || !insert_at(workspace, *hit)) return;
        drag_.start_amending(input, workspace.selection, workspace.shown.deformation());
        return;
      }
    }
    if (!input.pressed) return;
    // A cage is drawn around the picture at rest.
    if (deformation.has_cage() && deformation != at_rest(deformation)) {
      if (workspace.mode == EditMode::pose)
        workspace.messages.say(
            "Drawing another cage on the picture at rest. It replaces this cage when you close it. "
            "Undo with " +
            workspace.actions.key_of("edit.undo") + ".");
      workspace.mode = EditMode::rest;
    }
    workspace.selection.clear();
    path_.set_point(input.position);
  }

  void close(Workspace& workspace) {
    // Keep a rejected path, because the user can still remove points from it.
    if (!workspace.commit("Draw cage", with_cage(workspace.shown.own(), path_.cage()),
                          EditBase::document))
      return;
    path_.cancel();
    workspace.mode = EditMode::pose;
    workspace.tools.active = ToolId::select;
  }

  PenPath path_;
  std::optional<Complex> insertion_;
};

}  // namespace

std::unique_ptr<Tool> pen_tool() {
  return std::make_unique<PenTool>();
}

}  // namespace holomorph
