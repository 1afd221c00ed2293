// P: draw a cage point by point; on a finished cage's edge, insert; on its points, move.
#include "edit/tool.h"

namespace holomorph {
namespace {

class PenTool final : public Tool {
 public:
  ToolId id() const override { return ToolId::pen; }

  void input(const Input& input, Workspace& workspace) override {
    pointer_ = input.inside ? std::optional(input.position) : std::nullopt;
    if (drag_.active()) return void(drag_.follow(input, workspace));
    closes_ = false;
    hover_.reset();
    insertion_.reset();
    if (!input.inside) return;
    if (line_.empty()) return idle(input, workspace);
    const double to_first = std::abs(workspace.viewport.px_at_plane(line_[0]) - input.px);
    closes_ = line_.size() >= 3 && to_first < workspace.handle_px;
    if (input.mods.shift) pointer_ = constrained(input.position);
    if (!input.pressed) return;
    // The second click of a double-click would repeat the last point: it closes instead.
    const bool repeated =
        std::abs(workspace.viewport.px_at_plane(line_.back()) - input.px) < kDragThresholdPx;
    if (closes_ || (input.double_clicked && repeated && line_.size() >= 3))
      close(workspace);
    else if (!repeated)
      line_.push_back(*pointer_);
  }

  bool key(Key key, Workspace& workspace) override {
    if (line_.empty()) {
      if (key != Key::escape) return false;
      cancel(workspace);
      workspace.selection.clear();
      return true;
    }
    if (key == Key::enter) {
      if (line_.size() >= 3)
        close(workspace);
      else
        workspace.say("A cage needs at least three points.");
    } else if (key == Key::backspace || key == Key::del) {
      line_.pop_back();
    } else if (key == Key::escape) {
      line_.clear();
    } else {
      return false;
    }
    return true;
  }

  void cancel(Workspace& workspace) override {
    drag_.cancel(workspace);
    line_.clear();
    hover_.reset();
    insertion_.reset();
  }
  bool busy() const override { return !line_.empty() || drag_.active(); }

  ToolOverlay overlay() const override {
    ToolOverlay overlay;
    overlay.line = line_;
    if (!line_.empty()) overlay.line_end = pointer_;
    overlay.closes = closes_;
    overlay.hover = hover_;
    overlay.insertion = insertion_;
    return overlay;
  }

  std::string hint(const Workspace& workspace) const override {
    if (closes_) return "Click to close the cage";
    if (!line_.empty())
      return "Click the first point, press Enter or double-click to close; Backspace takes a point "
             "back; Esc cancels";
    if (!workspace.scene().has_cage()) return "Click around the picture to draw a cage";
    if (insertion_) return "Click to insert a point; rest and pose keep their shape";
    return "Click an edge to insert a point; click elsewhere to draw another cage in place of this "
           "one";
  }

 private:
  /// Nothing is being drawn.
  void idle(const Input& input, Workspace& workspace) {
    const Scene& scene = workspace.scene();
    if (scene.has_cage()) {
      hover_ = handle_at(workspace, input.px);
      if (hover_) {
        if (!input.pressed) return;
        if (input.mods.alt) {
          workspace.erase({*hover_});
          hover_.reset();
          return;
        }
        workspace.selection = {*hover_};
        drag_.start(input, workspace.selection, scene);
        return;
      }
      if (const auto hit = edge_at(workspace, input.px)) {
        insertion_ = hit->point;
        if (!input.pressed || !insert_at(workspace, *hit)) return;
        drag_.start_amending(input, workspace.selection, workspace.scene());
        return;
      }
    }
    if (!input.pressed) return;
    // A cage is drawn around the picture as it rests.
    if (scene.has_cage() && scene != at_rest(scene)) {
      if (workspace.layer == Layer::pose)
        workspace.say(
            "Drawing another cage on the picture at rest. Closing it replaces the cage; Ctrl+Z "
            "brings it back.");
      workspace.layer = Layer::rest;
    }
    workspace.selection.clear();
    line_.push_back(input.position);
  }

  void close(Workspace& workspace) {
    const Points polygon = std::move(line_);
    line_.clear();
    closes_ = false;
    if (!workspace.commit("Draw cage", with_cage(workspace.scene(), polygon))) {
      line_ = polygon;  // the drawing stays, so that a point can be taken back
      return;
    }
    workspace.layer = Layer::pose;
    workspace.tool = ToolId::select;
  }

  /// In steps of 15 degrees from the last point.
  Complex constrained(Complex z) const {
    const Complex by = z - line_.back();
    return line_.back() +
           std::polar(std::abs(by), std::round(std::arg(by) / (kPi / 12)) * (kPi / 12));
  }

  Points line_;
  std::optional<Complex> pointer_, insertion_;
  std::optional<Handle> hover_;
  HandleDrag drag_;
  bool closes_ = false;
};

}  // namespace

std::unique_ptr<Tool> pen_tool() {
  return std::make_unique<PenTool>();
}

}  // namespace holomorph
