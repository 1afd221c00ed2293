// Key U. Draws an outline. The cage then takes its shape. The user draws the outline freehand or
// sets it point by point. A freehand outline is closed and smoothed when the button is released.
// Dragging the outline bends it.
#include <algorithm>

#include "core/geometry/polyline.h"
#include "core/outline/outline_match.h"
#include "edit/tools/freehand.h"
#include "edit/tools/pen_path.h"

namespace holomorph {
namespace {

constexpr double kOutlineStepPx = 4, kOutlineShortestPx = 60;
constexpr double kOutlineReach = 0.12;  ///< reach of a pull, as a fraction of the outline's length

class OutlineTool final : public Tool {
 public:
  ToolId id() const override { return ToolId::outline; }

  void input(const Input& input, Workspace& workspace) override {
    if (path_.active()) {
      if (path_.follow(input, workspace.layer_view(), workspace.display.handle_px))
        close(workspace);
      return;
    }
    if (drawing_.active()) {
      if (drawing_.follow(input)) finish(input, workspace);
      return;
    }
    if (pull_) return follow_pull(input, workspace);
    hovered_ = input.inside && is_near(input, workspace);
    if (!input.pressed) return;
    if (!workspace.shown.deformation().has_cage())
      return workspace.messages.say("An outline needs a cage. Make a cage first.");
    if (!hovered_) return drawing_.start(input);
    const Points& outline = workspace.shown.deformation().outline;
    const auto nearest = std::ranges::min_element(
        outline, {}, [&](Complex z) { return std::abs(z - input.position); });
    pull_ = Pull{static_cast<size_t>(nearest - outline.begin()), input.mods.ctrl, input.position,
                 input.px, workspace.shown.deformation()};
  }

  void cancel(Workspace& workspace) override {
    drawing_.cancel();
    path_.cancel();
    if (pull_) workspace.shown.preview.reset();
    pull_.reset();
  }
  bool key(Key key, Workspace& workspace) override {
    const PenPath::Answer answer = path_.key(key);
    if (answer == PenPath::Answer::close) close(workspace);
    if (answer == PenPath::Answer::too_few)
      workspace.messages.say("An outline needs at least three points.");
    return answer != PenPath::Answer::ignored || Tool::key(key, workspace);
  }
  bool busy() const override { return path_.active() || drawing_.active() || pull_.has_value(); }
  ToolOverlay overlay() const override {
    ToolOverlay overlay;
    overlay.line = drawing_.line();
    if (drawing_.active()) overlay.line_end = overlay.line.front();
    path_.show(overlay);
    return overlay;
  }
  std::string hint(const Workspace& workspace) const override {
    if (!workspace.shown.deformation().has_cage())
      return "Make a cage first; it takes the shape of the outline";
    if (path_.active() && path_.closes()) return "Click to close the outline";
    if (path_.active())
      return "Click for a corner, drag for a smooth point; press Enter or click the first point to "
             "close; Backspace removes the last point";
    if (drawing_.active()) return "Release to close the outline; Esc cancels";
    if (hovered_ || pull_) return "Drag to bend the outline; Ctrl-drag to move it";
    return "Drag to draw the outline that the cage takes, or click its points";
  }

 private:
  struct Pull {
    size_t point;
    bool whole;  ///< the whole outline moves
    Complex start, start_px;
    Deformation deformation;
  };

  static bool is_near(const Input& input, const Workspace& workspace) {
    const Points& outline = workspace.shown.deformation().outline;
    if (!workspace.shows_outline()) return false;
    const double distance = nearest_on_polygon(outline, input.position).distance;
    return distance * workspace.layer_view().zoom <= workspace.display.handle_px;
  }

  /// Ends a freehand drawing. If the line stays within the drag threshold, it counts as a click,
  /// which sets the first point of a path.
  void finish(const Input& input, Workspace& workspace) {
    const Complex first = drawing_.line().front();
    const bool clicked = std::ranges::all_of(drawing_.line(), [&](Complex z) {
      return std::abs(z - first) * workspace.layer_view().zoom < kDragThresholdPx;
    });
    Points outline =
        drawing_.finish(true, kOutlineStepPx, kOutlineShortestPx, workspace.layer_view());
    if (clicked) {
      path_.set_point(first);
      path_.follow(input, workspace.layer_view(), workspace.display.handle_px);
    } else if (outline.empty()) {
      workspace.messages.say(
          "Hold the button down and draw all around the shape, or click its points.");
    } else {
      set_outline(workspace, "Draw outline", std::move(outline));
    }
  }

  void close(Workspace& workspace) {
    // Keep a rejected path, because the user can still remove points from it.
    if (set_outline(workspace, "Draw outline", flattened(path_.cage()).points)) path_.cancel();
  }

  void follow_pull(const Input& input, Workspace& workspace) {
    if (workspace.shown.preview || std::abs(input.px - pull_->start_px) >= kDragThresholdPx) {
      const Points& before = pull_->deformation.outline;
      const Complex by = input.position - pull_->start;
      Deformation deformation = pull_->deformation;
      if (pull_->whole)
        for (Complex& z : deformation.outline) z += by;
      else
        deformation.outline =
            pulled(before, true, pull_->point, by, kOutlineReach * Polyline(before, true).length());
      workspace.shown.preview = std::move(deformation);
    }
    if (input.down && !input.released) return;
    const bool whole = pull_->whole;
    pull_.reset();
    if (workspace.shown.preview)
      workspace.commit(whole ? "Move outline" : "Bend outline", *workspace.shown.preview);
  }

  Freehand drawing_;
  PenPath path_;
  std::optional<Pull> pull_;
  bool hovered_ = false;
};

}  // namespace

bool set_outline(Workspace& workspace, const std::string& label, Points outline,
                 std::optional<SurfaceReference> surface) {
  try {
    check_outline(outline);
  } catch (const Error& error) {
    workspace.messages.complain(error);
    return false;
  }
  if (!workspace.commit(label,
                        with_outline(workspace.shown.own(), std::move(outline), std::move(surface)),
                        EditBase::document))
    return false;
  workspace.mode = EditMode::pose;
  workspace.display.show_surface = true;
  workspace.playback = {0, true};
  return true;
}

std::unique_ptr<Tool> outline_tool() {
  return std::make_unique<OutlineTool>();
}

}  // namespace holomorph
