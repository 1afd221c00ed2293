// Key P. Draws a cage or a hole in it point by point, inserts points in the edges of a finished
// cage, and moves its points.
#include "core/cauchy/cauchy.h"
#include "edit/actions/actions.h"
#include "edit/edits/hole_edits.h"
#include "edit/picking.h"
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
      if (path_.follow(input, workspace.layer_view(), workspace.display.handle_px))
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
      workspace.messages.say(draws_hole_ ? "A hole needs at least three points."
                                         : "A cage needs at least three points.");
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
    overlay.in_cage = draws_hole_;
    overlay.insertion = insertion_;
    return overlay;
  }

  std::string hint(const Workspace& workspace) const override {
    if (path_.active() && path_.closes())
      return draws_hole_ ? "Click to close the hole" : "Click to close the cage";
    if (path_.active())
      return "Click for a corner, drag for a smooth point; click the first point, press Enter or "
             "double-click to close; Backspace removes the last point; Esc cancels";
    if (!workspace.shown.deformation().has_cage()) return "Click around the picture to draw a cage";
    if (insertion_) return "Click to insert a point; rest shape and pose do not change";
    return "Click an edge to insert a point; click inside the cage to draw a hole; click outside "
           "to draw another cage instead of this one";
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
    if (deformation.has_cage() && is_in_hole(workspace, input.position))
      return workspace.messages.say(
          "This is a hole already. Click the picture to draw another, or outside to draw a cage.");
    workspace.selection.clear();
    draws_hole_ = deformation.has_cage() && is_on_picture(workspace, input.position);
    // Cages and holes are drawn on the picture at rest.
    const bool switches = deformation.has_cage() && deformation != at_rest(deformation) &&
                          workspace.mode == EditMode::pose;
    if (switches) workspace.mode = EditMode::rest;
    if (switches && draws_hole_)  // the picture has moved away from the pointer
      return workspace.messages.say("This is the picture at rest. Click around the hole.");
    if (switches)
      workspace.messages.say(
          "Drawing another cage on the picture at rest. It replaces this cage when you close it. "
          "Undo with " +
          workspace.actions.key_of("edit.undo") + ".");
    path_.set_point(input.position);
  }

  static bool is_on_picture(const Workspace& workspace, Complex z) {
    return workspace.at_rest() ? contains(workspace.shown.deformation().rest, z)
                               : rest_at(workspace, z).has_value();
  }

  void close(Workspace& workspace) {
    if (draws_hole_) return close_hole(workspace);
    // Keep a rejected path, because the user can still remove points from it.
    if (!workspace.commit("Draw cage", with_cage(workspace.shown.own(), path_.cage()),
                          EditBase::document))
      return;
    path_.cancel();
    workspace.mode = EditMode::pose;
    workspace.tools.active = ToolId::select;
  }

  void close_hole(Workspace& workspace) {
    const Cage hole = path_.cage();
    const VectorXc controls = controls_of(hole);
    const Points rest(controls.begin(), controls.end());
    Points posed;
    for (const Complex& z : rest)
      if (workspace.map().has_map()) posed.push_back(posed_at(workspace.map(), z));
    if (!workspace.require_keyframe_maps()) return;
    Deformation drawn =
        with_hole(workspace.shown.deformation(), hole, posed, workspace.keyframe_images(rest));
    if (const auto fault = rest_fault(drawn.rest))
      return workspace.messages.complain("This hole cannot be used: " + std::string(fault->what()) +
                                             ". Backspace removes the last point.",
                                         fault->where());
    if (!workspace.commit("Draw hole", std::move(drawn))) return;
    path_.cancel();
    workspace.mode = EditMode::pose;
  }

  PenPath path_;
  bool draws_hole_ = false;
  std::optional<Complex> insertion_;
};

}  // namespace

std::unique_ptr<Tool> pen_tool() {
  return std::make_unique<PenTool>();
}

}  // namespace holomorph
