// V: pick, move, box-select, turn pins, insert by double-click, delete by Alt-click.
#include "edit/tool.h"

namespace holomorph {
namespace {

class SelectTool final : public Tool {
 public:
  ToolId id() const override { return ToolId::select; }

  void input(const Input& input, Workspace& workspace) override {
    if (turning_) return turn(input, workspace);
    if (drag_.active()) {
      drag_.follow(input, workspace, workspace.layer == Layer::rest ? "Move at rest" : "Move");
      return;
    }
    if (marquee_start_) return follow_marquee(input, workspace);
    hover_ = input.inside ? handle_at(workspace, input.px) : std::nullopt;
    ring_ = ring_pin(workspace);
    over_ring_ = ring_ && input.inside && !hover_ && on_ring(input, workspace);
    if (!input.inside || !input.pressed) return;
    if (over_ring_) {
      turning_ = true;
      start_angle_ = angle_to(input, workspace);
      start_scene_ = workspace.scene();
    } else if (hover_ && input.mods.alt) {
      remove(*hover_, workspace);
    } else if (hover_) {
      pick(input, workspace);
    } else if (input.double_clicked) {
      insert(input, workspace);
    } else {
      marquee_start_ = input.px;
      marquee_end_ = input.px;
    }
  }

  void cancel(Workspace& workspace) override {
    drag_.cancel(workspace);
    if (turning_) workspace.preview.reset();
    turning_ = false;
    marquee_start_.reset();
    hover_.reset();
  }
  bool busy() const override { return drag_.active() || turning_ || marquee_start_.has_value(); }
  bool key(Key key, Workspace& workspace) override {
    if (key != Key::escape) return false;
    const bool was_busy = busy();
    cancel(workspace);
    if (!was_busy) workspace.selection.clear();
    return true;
  }

  ToolOverlay overlay() const override {
    ToolOverlay overlay;
    overlay.hover = hover_;
    overlay.ring = ring_;
    if (marquee_start_ && std::abs(marquee_end_ - *marquee_start_) >= kDragThresholdPx) {
      Box box;
      box.include(*marquee_start_);
      box.include(marquee_end_);
      overlay.marquee = box;
    }
    return overlay;
  }

  std::string hint(const Workspace& workspace) const override {
    if (!workspace.scene().has_cage())
      return "Draw a cage with P, or make one from the picture (Cage menu)";
    if (drag_.active()) return "Shift keeps the axis";
    if (turning_) return "Shift snaps to 15 degrees";
    if (over_ring_) return "Drag the ring to turn the picture around the pin";
    if (hover_) return "Drag to move; Shift-click adds to the selection; Alt-click deletes";
    return workspace.layer == Layer::rest ? "Rest: drag points, the pose stays; double-click an "
                                            "edge inserts; Tab returns to the pose"
                                          : "Drag points or pins; drag a box to select; "
                                            "double-click an edge inserts; Tab shows the rest";
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
    drag_.start(input, selection, workspace.scene());
  }

  void remove(Handle handle, Workspace& workspace) {
    try {
      workspace.commit(handle.kind == Handle::Kind::pin ? "Delete pin" : "Delete point",
                       erased(workspace.scene(), {handle}));
      workspace.selection.clear();
    } catch (const Error& error) {
      workspace.complain(error);
    }
    hover_.reset();
  }

  void insert(const Input& input, Workspace& workspace) {
    const CageHit hit =
        nearest_on_cage(cage_of(workspace.scene(), workspace.layer), input.position);
    if (hit.distance * workspace.viewport.zoom > workspace.handle_px || hit.t < 1e-3 ||
        hit.t > 1 - 1e-3)
      return;
    workspace.commit("Insert point", inserted(workspace.scene(), hit.segment, hit.t));
    workspace.selection = {{Handle::Kind::cage, hit.segment + 1, 0}};
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
    const Scene& scene = workspace.scene();
    for (const Handle& handle : handles_of(scene, workspace.layer))
      if (box.contains(workspace.viewport.px_at_plane(position_of(scene, handle, workspace.layer))))
        workspace.selection.insert(handle);
  }

  /// The one selected pin, in the pose.
  static std::optional<Index> ring_pin(const Workspace& workspace) {
    if (workspace.layer != Layer::pose || workspace.selection.size() != 1) return {};
    const Handle handle = *workspace.selection.begin();
    if (handle.kind != Handle::Kind::pin || !exists(workspace.scene(), handle, Layer::pose))
      return {};
    return handle.index;
  }
  Complex ring_center(const Workspace& workspace) const {
    return workspace.viewport.px_at_plane(workspace.scene().pins[*ring_].pose);
  }
  bool on_ring(const Input& input, const Workspace& workspace) const {
    const double radius = kRingRadius * workspace.handle_px;
    return std::abs(std::abs(input.px - ring_center(workspace)) - radius) <
           0.6 * workspace.handle_px;
  }
  double angle_to(const Input& input, const Workspace& workspace) const {
    return -std::arg(input.px - ring_center(workspace));
  }
  void turn(const Input& input, Workspace& workspace) {
    const double before = start_scene_.pins[*ring_].angle.value_or(0);
    double angle = before + std::remainder(angle_to(input, workspace) - start_angle_, 2 * kPi);
    // Unwrapped from frame to frame, so that more than half a turn can be dragged.
    if (workspace.preview) {
      const double last = workspace.preview->pins[*ring_].angle.value_or(0);
      angle += 2 * kPi * std::round((last - angle) / (2 * kPi));
    }
    if (input.mods.shift) angle = std::round(angle / (kPi / 12)) * (kPi / 12);
    workspace.preview = turned(start_scene_, *ring_, angle);
    if (input.down && !input.released) return;
    turning_ = false;
    workspace.commit("Turn pin", *workspace.preview);
  }

  HandleDrag drag_;
  std::optional<Handle> hover_;
  std::optional<Complex> marquee_start_;
  Complex marquee_end_;
  std::optional<Index> ring_;
  bool over_ring_ = false, turning_ = false;
  double start_angle_ = 0;
  Scene start_scene_;
};

}  // namespace

std::unique_ptr<Tool> select_tool() {
  return std::make_unique<SelectTool>();
}

}  // namespace holomorph
