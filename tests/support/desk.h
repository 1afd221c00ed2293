// A workspace without a window, and the mouse actions to use it.
#pragma once

#include <chrono>
#include <thread>

#include "edit/tools/tool.h"
#include "support/shapes.h"

namespace holomorph {

/// A workspace whose viewport shows one plane unit as one pixel, with its tools.
struct TestWorkspace {
  Workspace workspace{MeshOptions{500}};
  std::vector<std::unique_ptr<Tool>> tools;
  double now_ms = 0;

  explicit TestWorkspace(const Points& polygon = {}) {
    tools.push_back(select_tool());
    tools.push_back(pen_tool());
    tools.push_back(pin_tool());
    tools.push_back(stroke_tool());
    tools.push_back(outline_tool());
    tools.push_back(angle_tool());
    tools.push_back(brush_tool());
    tools.push_back(attach_tool());
    workspace.display.viewport = {{100, 100}, 1, 0, 0, 1000, 1000};
    if (!polygon.empty()) workspace.commit("Cage", with_cage(Deformation{}, polygon));
    settle();
  }
  void settle() { workspace.map().finish(workspace.shown.deformation(), {}); }
  /// Updates the map, frame by frame, until the worker has nothing left to do.
  void update() {
    workspace.update_map({});
    while (workspace.map().busy()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      workspace.update_map({});
    }
  }
  Tool& tool() {
    for (const auto& tool : tools)
      if (tool->id() == workspace.tools.active) return *tool;
    return *tools[0];
  }
  /// The pointer at a point of the scene's plane.
  Input at(Complex z, Modifiers mods = {}) const {
    Input input;
    input.px = workspace.display.viewport.px_at_plane(z);
    const Similarity placed = workspace.placement(workspace.document.scene().edited);
    input.position = is_identity(placed) ? z : workspace.layer_view().plane_at_px(input.px);
    input.inside = true;
    input.mods = mods;
    input.now_ms = now_ms;
    return input;
  }
  void hover(Complex z) { tool().input(at(z), workspace); }
  void press(Complex z, Modifiers mods = {}, bool twice = false) {
    hover(z);
    Input input = at(z, mods);
    input.pressed = input.down = true;
    input.double_clicked = twice;
    tool().input(input, workspace);
  }
  void move(Complex z, Modifiers mods = {}) {
    Input input = at(z, mods);
    input.down = true;
    tool().input(input, workspace);
  }
  void release(Complex z, Modifiers mods = {}) {
    Input input = at(z, mods);
    input.released = true;
    tool().input(input, workspace);
  }
  void click(Complex z, Modifiers mods = {}) {
    press(z, mods);
    release(z, mods);
  }
  void drag(Complex from, Complex to, Modifiers mods = {}) {
    press(from);
    move(0.5 * (from + to), mods);
    move(to, mods);
    release(to, mods);
  }
  /// Moves along a line with the button down.
  void draw(const Points& line, Modifiers mods = {}) {
    press(line.front(), mods);
    for (const Complex& z : line) move(z, mods);
    release(line.back(), mods);
  }
  const Deformation& deformation() const { return workspace.shown.deformation(); }
  size_t steps() const { return workspace.document.history().entries().size(); }
};

}  // namespace holomorph
