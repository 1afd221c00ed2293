// Key V. Selects and moves handles, selects with a box, rotates pins, inserts points by
// double-click and deletes handles by Alt-click.
#include "edit/actions/actions.h"
#include "edit/tools/handle_tool.h"
#include "edit/tools/layer_drag.h"

namespace holomorph {
namespace {

class SelectTool final : public HandleTool {
 public:
  ToolId id() const override { return ToolId::select; }

  void input(const Input& input, Workspace& workspace) override {
    if (follow(input, workspace)) return;
    if (box_.active()) return box_.follow(input, workspace);
    if (layer_.active()) return layer_.follow(input, workspace);
    if (marquee_start_) return follow_marquee(input, workspace);
    find(input, workspace);
    ring_.hover(input, workspace);
    box_.hover(input, workspace);
    if (!input.inside || !input.pressed) return;
    if (box_.hovered() && !hover_ && !ring_.hovered()) return box_.start(input, workspace);
    if (press(input, workspace)) return;
    if (input.double_clicked) {
      if (const auto hit = edge_at(workspace, input.px)) insert_at(workspace, *hit);
    } else if (box_.inside() && !input.mods.shift) {
      box_.start(input, workspace);
    } else if (workspace.tools.drags_layers && !input.mods.shift &&
               layer_.start(input, workspace)) {
      hover_.reset();
    } else {
      marquee_start_ = input.px;
      marquee_end_ = input.px;
    }
  }

  void cancel(Workspace& workspace) override {
    HandleTool::cancel(workspace);
    box_.cancel(workspace);
    layer_.cancel(workspace);
    marquee_start_.reset();
  }
  bool busy() const override {
    return HandleTool::busy() || box_.active() || layer_.active() || marquee_start_.has_value();
  }
  ToolOverlay overlay() const override {
    ToolOverlay overlay = HandleTool::overlay();
    if (!drag_.active()) overlay.box = box_.mark();
    if (marquee_start_ && std::abs(marquee_end_ - *marquee_start_) >= kDragThresholdPx) {
      Box box;
      box.include(*marquee_start_);
      box.include(marquee_end_);
      overlay.marquee = box;
    }
    return overlay;
  }

  bool has_ring() const override { return true; }

  std::string hint(const Workspace& workspace) const override {
    if (layer_.active()) return "Hold Shift to move along one axis";
    if (!workspace.shown.deformation().has_cage())
      return "Drag a layer to move it; " + workspace.actions.key_of("tool.pin") +
             " sets pins that bend it";
    if (drag_.active()) return "Hold Shift to move along one axis";
    if (box_.active() || ((box_.hovered() || box_.inside()) && !hover_)) return box_.hint();
    if (ring_.active() || (ring_.hovered() && !hover_)) return ring_.hint(workspace);
    if (hover_ && hover_->kind == Handle::Kind::stroke)
      return "Drag to move; Alt-click to delete; the Stroke tool bends and redraws it";
    if (hover_ && hover_->control > 0)
      return "Drag to bend the curve; hold Alt to break the tangents of a smooth point";
    if (hover_)
      return "Drag to move; Ctrl-drag to record motion; Shift-click to select more; Alt-click to "
             "delete; Ctrl-click for smooth or corner";
    return workspace.mode == EditMode::rest
               ? "Drag points of the rest shape (posed points stay); double-click an edge "
                 "to insert a point; " +
                     workspace.actions.key_of("cage.rest") + " returns to the pose"
               : "Drag points, pins or a layer; drag a box from outside to select; double-click an "
                 "edge "
                 "to insert a point; " +
                     workspace.actions.key_of("cage.rest") + " shows the rest shape";
  }

 private:
  void follow_marquee(const Input& input, Workspace& workspace) {
    marquee_end_ = input.px;
    if (input.down && !input.released) return;
    Box box;
    box.include(*marquee_start_);
    box.include(marquee_end_);
    const bool dragged = std::abs(marquee_end_ - *marquee_start_) >= kDragThresholdPx;
    marquee_start_.reset();
    if (!input.mods.shift) workspace.selection.clear();
    if (!dragged) return;
    const Deformation& deformation = workspace.shown.deformation();
    for (const Handle& handle : handles_of(deformation, workspace.mode))
      if (box.contains(
              workspace.layer_view().px_at_plane(position_of(deformation, handle, workspace.mode))))
        workspace.selection.insert(handle);
  }

  std::optional<Complex> marquee_start_;
  Complex marquee_end_;
  TransformBox box_;
  LayerDrag layer_;
};

}  // namespace

std::unique_ptr<Tool> select_tool() {
  return std::make_unique<SelectTool>();
}

}  // namespace holomorph
