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
    if (placing_ && !nodes_.empty()) return place(input, workspace);
    closes_ = false;
    hover_.reset();
    insertion_.reset();
    if (!input.inside) return;
    if (nodes_.empty()) return idle(input, workspace);
    const double to_first = std::abs(workspace.viewport.px_at_plane(nodes_[0].at) - input.px);
    closes_ = nodes_.size() >= 3 && to_first < workspace.handle_px;
    if (input.mods.shift) pointer_ = constrained(input.position);
    if (!input.pressed) return;
    // The second click of a double-click would repeat the last point: it closes instead.
    const bool repeated =
        std::abs(workspace.viewport.px_at_plane(nodes_.back().at) - input.px) < kDragThresholdPx;
    if (closes_ || (input.double_clicked && repeated && nodes_.size() >= 3))
      close(workspace);
    else if (!repeated)
      set_point(*pointer_);
  }

  bool key(Key key, Workspace& workspace) override {
    if (nodes_.empty()) {
      if (key != Key::escape) return false;
      cancel(workspace);
      workspace.selection.clear();
      return true;
    }
    if (key == Key::enter) {
      if (nodes_.size() >= 3)
        close(workspace);
      else
        workspace.say("A cage needs at least three points.");
    } else if (key == Key::backspace || key == Key::del) {
      nodes_.pop_back();
      placing_ = false;
    } else if (key == Key::escape) {
      nodes_.clear();
    } else {
      return false;
    }
    return true;
  }

  void cancel(Workspace& workspace) override {
    drag_.cancel(workspace);
    nodes_.clear();
    hover_.reset();
    insertion_.reset();
  }
  bool busy() const override { return !nodes_.empty() || drag_.active(); }

  ToolOverlay overlay() const override {
    ToolOverlay overlay;
    overlay.line = drawn();
    for (const Node& node : nodes_) overlay.line_points.push_back(node.at);
    if (!nodes_.empty() && !placing_) overlay.line_end = pointer_;
    overlay.closes = closes_;
    overlay.hover = hover_;
    overlay.insertion = insertion_;
    return overlay;
  }

  std::string hint(const Workspace& workspace) const override {
    if (closes_) return "Click to close the cage";
    if (!nodes_.empty())
      return "Click the first point, press Enter or double-click to close; drag for a smooth "
             "point; "
             "Backspace takes one back; Esc cancels";
    if (!workspace.scene().has_cage()) return "Click around the picture to draw a cage";
    if (insertion_) return "Click to insert a point; rest and pose keep their shape";
    return "Click an edge to insert a point; click elsewhere to draw another cage in place of this "
           "one";
  }

 private:
  /// A point of the cage being drawn; a tangent of 0 is a corner.
  struct Node {
    Complex at, tangent;
  };

  /// Nothing is being drawn.
  void idle(const Input& input, Workspace& workspace) {
    const Scene& scene = workspace.scene();
    if (scene.has_cage()) {
      hover_ = handle_at(workspace, input.px);
      if (hover_) {
        if (!input.pressed) return;
        if (edits_point(input, *hover_, workspace)) return hover_.reset();
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
    set_point(input.position);
  }

  void set_point(Complex at) {
    nodes_.push_back({at, 0});
    placing_ = true;
  }

  /// Dragging on after a point was set pulls out its tangent.
  void place(const Input& input, const Workspace& workspace) {
    Node& node = nodes_.back();
    const double off = std::abs(workspace.viewport.px_at_plane(node.at) - input.px);
    if (node.tangent != Complex(0) || off >= kDragThresholdPx)
      node.tangent = input.position - node.at;
    placing_ = input.down && !input.released;
  }

  /// The segment between two nodes: straight between corners, else a cubic.
  static Points segment(const Node& from, const Node& to) {
    if (from.tangent == Complex(0) && to.tangent == Complex(0)) return {from.at};
    const Complex third = (to.at - from.at) / 3.0;
    return {from.at, from.at + (from.tangent == Complex(0) ? third : from.tangent),
            to.at - (to.tangent == Complex(0) ? third : to.tangent)};
  }

  Cage cage() const {
    Cage cage;
    for (size_t i = 0; i < nodes_.size(); ++i)
      cage.segments.push_back(segment(nodes_[i], nodes_[(i + 1) % nodes_.size()]));
    return cage;
  }

  /// What is drawn so far, as a polyline; the last point's tangent shows while it is pulled.
  Points drawn() const {
    Points line;
    for (size_t i = 0; i + 1 < nodes_.size(); ++i) {
      Points controls = segment(nodes_[i], nodes_[i + 1]);
      controls.push_back(nodes_[i + 1].at);
      const int pieces = controls.size() == 2 ? 1 : 24;
      for (int k = 0; k < pieces; ++k)
        line.push_back(bezier_point(controls, static_cast<double>(k) / pieces));
    }
    if (nodes_.empty()) return line;
    line.push_back(nodes_.back().at);
    if (placing_ && nodes_.back().tangent != Complex(0))
      line.push_back(nodes_.back().at + nodes_.back().tangent);
    return line;
  }

  void close(Workspace& workspace) {
    closes_ = false;
    // A refused drawing stays, so that a point can be taken back.
    if (!workspace.commit("Draw cage", with_cage(workspace.scene(), cage()))) return;
    nodes_.clear();
    workspace.layer = Layer::pose;
    workspace.tool = ToolId::select;
  }

  /// In steps of 15 degrees from the last point.
  Complex constrained(Complex z) const {
    const Complex by = z - nodes_.back().at;
    return nodes_.back().at +
           std::polar(std::abs(by), std::round(std::arg(by) / (kPi / 12)) * (kPi / 12));
  }

  std::vector<Node> nodes_;
  bool placing_ = false;  ///< the button is still down on the last point
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
