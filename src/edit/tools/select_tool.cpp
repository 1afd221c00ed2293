// V: pick, move, box-select, turn pins, insert by double-click, delete by Alt-click.
#include "edit/actions/actions.h"
#include "edit/tools/tool.h"

namespace holomorph {
namespace {

class SelectTool final : public Tool {
 public:
  ToolId id() const override { return ToolId::select; }

  void input(const Input& input, Workspace& workspace) override {
    if (ring_.active()) return ring_.follow(input, workspace);
    if (box_.active()) return box_.follow(input, workspace);
    if (drag_.active()) return void(drag_.follow(input, workspace));
    if (marquee_start_) return follow_marquee(input, workspace);
    hover_ = input.inside ? handle_at(workspace, input.px) : std::nullopt;
    ring_.hover(input, workspace);
    box_.hover(input, workspace);
    if (!input.inside || !input.pressed) return;
    if (ring_.hovered() && !hover_) {
      ring_.start(input, workspace);
    } else if (box_.hovered() && !hover_) {
      box_.start(input, workspace);
    } else if (hover_ && erases(input, *hover_, workspace)) {
      hover_.reset();
    } else if (hover_) {
      pick(input, workspace);
    } else if (input.double_clicked) {
      if (const auto hit = edge_at(workspace, input.px)) insert_at(workspace, *hit);
    } else if (box_.inside() && !input.mods.shift) {
      box_.start(input, workspace);
    } else {
      marquee_start_ = input.px;
      marquee_end_ = input.px;
    }
  }

  void cancel(Workspace& workspace) override {
    drag_.cancel(workspace);
    ring_.cancel(workspace);
    box_.cancel(workspace);
    marquee_start_.reset();
    hover_.reset();
  }
  bool busy() const override {
    return drag_.active() || ring_.active() || box_.active() || marquee_start_.has_value();
  }
  bool scroll(const Input& input, Workspace& workspace) override {
    return ring_.scroll(input, workspace);
  }
  bool key(Key key, Workspace& workspace) override {
    if (key != Key::escape) return false;
    const bool was_busy = busy();
    cancel(workspace);
    if (!was_busy) workspace.selection.clear();
    return true;
  }

  ToolOverlay overlay() const override {
    ToolOverlay overlay;
    overlay.guides = drag_.guides();
    overlay.hover = hover_;
    overlay.ring = ring_.pin();
    overlay.ring_hovered = ring_.hovered() || ring_.active();
    if (!drag_.active()) overlay.box = box_.mark();
    if (marquee_start_ && std::abs(marquee_end_ - *marquee_start_) >= kDragThresholdPx) {
      Box box;
      box.include(*marquee_start_);
      box.include(marquee_end_);
      overlay.marquee = box;
    }
    return overlay;
  }

  std::string hint(const Workspace& workspace) const override {
    if (!workspace.shown.deformation().has_cage())
      return needs_a_cage("What bends is inside a cage");
    if (drag_.active()) return "Shift keeps the axis";
    if (box_.active() || ((box_.hovered() || box_.inside()) && !hover_)) return box_.hint();
    if (ring_.active()) return "Shift snaps to 15 degrees";
    if (ring_.hovered() && !hover_)
      return "Drag the ring to turn the picture around the pin, scroll on it to scale";
    if (hover_ && hover_->kind == Handle::Kind::stroke)
      return "Drag to move; S bends and redraws strokes; Alt-click deletes";
    if (hover_ && hover_->control > 0) return "Drag to bend; Alt breaks a smooth point's tangents";
    if (hover_)
      return "Drag to move, with Ctrl to record motion; Shift-click adds; Alt-click deletes; "
             "Ctrl-click: smooth or corner";
    return workspace.mode == EditMode::rest
               ? "Rest: drag points, the pose stays; double-click an edge inserts; " +
                     key_of("cage.rest") + " returns to the pose"
               : "Drag points or pins; drag a box to select; double-click an edge inserts; " +
                     key_of("cage.rest") + " shows the rest";
  }

 private:
  void pick(const Input& input, Workspace& workspace) {
    Selection& selection = workspace.selection;
    if (input.mods.shift && selection.contains(*hover_)) {
      selection.erase(*hover_);
      return;
    }
    if (!input.mods.shift && !selection.contains(*hover_)) selection.clear();
    selection.insert(*hover_);
    drag_.start(input, *hover_, selection, workspace.shown.deformation());
  }

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
      if (box.contains(workspace.display.viewport.px_at_plane(
              position_of(deformation, handle, workspace.mode))))
        workspace.selection.insert(handle);
  }

  HandleDrag drag_;
  std::optional<Handle> hover_;
  std::optional<Complex> marquee_start_;
  Complex marquee_end_;
  PinRing ring_;
  TransformBox box_;
};

}  // namespace

std::unique_ptr<Tool> select_tool() {
  return std::make_unique<SelectTool>();
}

}  // namespace holomorph
