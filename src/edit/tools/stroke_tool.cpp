// Key S. Draws strokes on the picture. The picture follows when strokes are moved, bent or redrawn.
#include <algorithm>
#include <utility>

#include "core/geometry/polyline.h"
#include "edit/actions/actions.h"
#include "edit/tools/freehand.h"
#include "edit/tools/handle_tool.h"

namespace holomorph {
namespace {

constexpr double kStrokeStepPx = 6, kStrokeShortestPx = 12;
constexpr double kStrokeReach = 0.25,
                 kStrokeEndReach = 1;  ///< reach of a pull, as a fraction of the stroke's length

class StrokeTool final : public HandleTool {
 public:
  ToolId id() const override { return ToolId::stroke; }

  bool waits(const Input& input, const Workspace& workspace) const override {
    return !workspace.knows_map() && !handle_at(workspace, input.px);
  }

  void input(const Input& input, Workspace& workspace) override {
    if (drawing_.active()) {
      if (drawing_.follow(input)) finish(workspace);
      return;
    }
    if (follow(input, workspace)) return;
    if (pull_) return follow_pull(input, workspace);
    find(input, workspace);
    if (!input.inside || !input.pressed) return;
    const bool redraws = input.mods.shift && selected_stroke(workspace);
    if (!hover_ || redraws) return start_drawing(input, workspace);
    press(input, workspace);
  }

  void cancel(Workspace& workspace) override {
    HandleTool::cancel(workspace);
    if (pull_) workspace.shown.preview.reset();
    pull_.reset();
    drawing_.cancel();
    redrawn_.reset();
  }
  bool busy() const override {
    return HandleTool::busy() || drawing_.active() || pull_.has_value();
  }

  ToolOverlay overlay() const override {
    ToolOverlay overlay = HandleTool::overlay();
    overlay.line = drawing_.line();
    return overlay;
  }
  std::string hint(const Workspace& workspace) const override {
    if (!workspace.shown.deformation().has_cage())
      return needs_a_cage(workspace, "Strokes need a cage");
    if (drawing_.active()) return "Release to end the stroke; Esc cancels";
    if (hover_ && hover_->kind == Handle::Kind::stroke)
      return "Drag to move; drag an end or Ctrl-drag to bend; Alt-click to delete";
    return selected_stroke(workspace)
               ? "Shift-drag to redraw the stroke; drag to draw another one"
               : "Drag on the picture to draw a stroke, then drag the stroke";
  }

 private:
  struct Pull {
    Index stroke;
    size_t point;
    double reach;
    Complex start, start_px;
    Deformation deformation;
  };

  static std::optional<Index> selected_stroke(const Workspace& workspace) {
    if (workspace.selection.size() != 1) return {};
    const Handle& handle = *workspace.selection.begin();
    return handle.kind == Handle::Kind::stroke ? std::optional(handle.index) : std::nullopt;
  }

  void start_drawing(const Input& input, Workspace& workspace) {
    if (!workspace.shown.deformation().has_cage())
      return workspace.messages.say(needs_a_cage(workspace, "Strokes need a cage"));
    if (input.mods.shift && !selected_stroke(workspace) &&
        !workspace.shown.deformation().strokes.empty())
      return workspace.messages.say("Click a stroke first. Then Shift-drag to redraw it.");
    redrawn_ = input.mods.shift ? selected_stroke(workspace) : std::nullopt;
    if (!redrawn_ && !rest_at(workspace, input.position))
      return workspace.messages.say(workspace.map().busy()
                                        ? "The map is being prepared. Try again in a moment."
                                        : "Start the stroke on the picture, inside the cage.");
    drawing_.start(input);
  }

  void finish(Workspace& workspace) {
    const Points drawn =
        drawing_.finish(false, kStrokeStepPx, kStrokeShortestPx, workspace.layer_view());
    const auto redrawn_stroke = std::exchange(redrawn_, std::nullopt);
    if (drawn.empty()) {
      workspace.selection.clear();  // a click rather than a stroke
      return;
    }
    if (redrawn_stroke) {
      workspace.commit("Redraw stroke", redrawn(workspace.shown.deformation(), *redrawn_stroke,
                                                drawn, workspace.mode));
      return;
    }
    Points rest, pose;
    for (const Complex& z : drawn) {
      const auto at = rest_at(workspace, z);
      if (!at) continue;
      rest.push_back(*at);
      pose.push_back(workspace.at_rest() ? posed_at(workspace.map(), *at) : z);
    }
    if (rest.size() < 2)
      return workspace.messages.say("Draw the stroke on the picture, inside the cage.");
    if (!workspace.require_keyframe_maps()) return;
    // A stroke over several parts crosses the gaps between them.
    const bool clipped =
        rest.size() < drawn.size() && workspace.shown.deformation().rest.parts.empty();
    const bool switches = !method_named(workspace.shown.deformation().method).uses_strokes;
    if (!workspace.commit("Draw stroke", with_stroke(workspace.shown.deformation(), rest, pose,
                                                     workspace.keyframe_images(rest))))
      return;
    workspace.selection = {{Handle::Kind::stroke,
                            static_cast<Index>(workspace.shown.deformation().strokes.size()) - 1,
                            0}};
    if (clipped) workspace.messages.say("The part of the stroke outside the picture was left out.");
    if (switches) workspace.messages.say(switched_to(MethodUse::strokes));
  }

  /// Dragging an end of a stroke, or any point of it with Ctrl, bends the stroke instead of moving
  /// it.
  bool start_gesture(const Input& input, Workspace& workspace) override {
    if (hover_->kind != Handle::Kind::stroke) return false;
    const Points& curve = curve_of(workspace.shown.deformation(), hover_->index, workspace.mode);
    const auto off = [&](Complex z) {
      return std::abs(workspace.layer_view().px_at_plane(z) - input.px);
    };
    const auto nearest = std::ranges::min_element(curve, {}, off);
    const size_t point = static_cast<size_t>(nearest - curve.begin());
    const bool end = std::min(off(curve.front()), off(curve.back())) <= workspace.display.handle_px;
    if (!end && !input.mods.ctrl) return false;
    const size_t at = !end ? point : off(curve.front()) <= off(curve.back()) ? 0 : curve.size() - 1;
    const double length = Polyline(without_repeats(curve), false).length();
    pull_ = Pull{hover_->index,  at,       (end ? kStrokeEndReach : kStrokeReach) * length,
                 input.position, input.px, workspace.shown.deformation()};
    return true;
  }

  void follow_pull(const Input& input, Workspace& workspace) {
    if (workspace.shown.preview || std::abs(input.px - pull_->start_px) >= kDragThresholdPx)
      workspace.shown.preview =
          with_curve(pull_->deformation, pull_->stroke,
                     pulled(curve_of(pull_->deformation, pull_->stroke, workspace.mode), false,
                            pull_->point, input.position - pull_->start, pull_->reach),
                     workspace.mode);
    if (input.down && !input.released) return;
    pull_.reset();
    if (workspace.shown.preview) workspace.commit("Bend stroke", *workspace.shown.preview);
  }

  Freehand drawing_;
  std::optional<Index> redrawn_;  ///< the stroke that the line being drawn replaces
  std::optional<Pull> pull_;
};

}  // namespace

std::unique_ptr<Tool> stroke_tool() {
  return std::make_unique<StrokeTool>();
}

}  // namespace holomorph
