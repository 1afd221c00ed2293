// O: an outline is drawn in one go, closed and smoothed when it is let go; the picture's shape goes
// onto it.
#include <utility>

#include "core/outline_match.h"
#include "core/polyline.h"
#include "edit/tool.h"

namespace holomorph {
namespace {

constexpr double kStepPx = 3;       ///< between the points that are kept while drawing
constexpr double kShortestPx = 60;  ///< of an outline
constexpr int kLeast = 24, kMost = 400, kSmoothings = 3;

/// A closed freehand line at equal steps, its tremor smoothed.
Points smoothed(const Points& line, double step) {
  const Polyline drawn(line, true);
  const double wanted = drawn.length() / step;
  Points points =
      at_equal_lengths(drawn, static_cast<Index>(std::clamp<double>(wanted, kLeast, kMost)));
  for (int pass = 0; pass < kSmoothings; ++pass) {
    const Points before = points;
    const size_t n = points.size();
    for (size_t i = 0; i < n; ++i)
      points[i] = 0.25 * (before[(i + n - 1) % n] + 2.0 * before[i] + before[(i + 1) % n]);
  }
  return points;
}

class OutlineTool final : public Tool {
 public:
  ToolId id() const override { return ToolId::outline; }

  void input(const Input& input, Workspace& workspace) override {
    if (!line_.empty()) return draw(input, workspace);
    if (!input.pressed) return;
    if (!workspace.scene().has_cage()) {
      workspace.say("The outline is for the cage's shape: make a cage first.");
      return;
    }
    line_ = {input.position};
    last_px_ = input.px;
  }

  void cancel(Workspace&) override { line_.clear(); }
  bool key(Key key, Workspace& workspace) override {
    if (key != Key::escape || line_.empty()) return false;
    cancel(workspace);
    return true;
  }
  bool busy() const override { return !line_.empty(); }
  ToolOverlay overlay() const override {
    ToolOverlay overlay;
    overlay.line = line_;
    if (!line_.empty()) overlay.line_end = line_.front();
    return overlay;
  }
  std::string hint(const Workspace& workspace) const override {
    if (!workspace.scene().has_cage()) return "Make a cage first: its shape goes onto the outline";
    return line_.empty() ? "Drag to draw the outline that the picture's shape goes onto"
                         : "Let go to close the outline; Esc gives it up";
  }

 private:
  void draw(const Input& input, Workspace& workspace) {
    if (std::abs(input.px - last_px_) >= kStepPx) {
      line_.push_back(input.position);
      last_px_ = input.px;
    }
    if (!input.released) return;
    const Points line = std::exchange(line_, {});
    double length = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i) length += std::abs(line[i + 1] - line[i]);
    if (line.size() < 4 || length * workspace.viewport.zoom < kShortestPx) {
      workspace.say("Keep the button down and draw all around the new shape.");
      return;
    }
    Scene scene = workspace.scene();
    scene.outline = smoothed(line, 4 / workspace.viewport.zoom);
    try {
      check_outline(scene.outline);
    } catch (const Error& error) {
      workspace.complain(error);
      return;
    }
    if (scene.method != "outline") scene = with_method(std::move(scene), "outline");
    workspace.layer = Layer::pose;
    workspace.commit("Draw outline", scene);
  }

  Points line_;  ///< so far
  Complex last_px_;
};

}  // namespace

std::unique_ptr<Tool> outline_tool() {
  return std::make_unique<OutlineTool>();
}

}  // namespace holomorph
