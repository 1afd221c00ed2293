// The keys and the search over all actions, both read off the action table.
#include "app/panels.h"
// After imgui.h, which it does not include itself.
#include <imgui_stdlib.h>

namespace holomorph {

bool draw_help(double scale) {
  const float s = static_cast<float>(scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(760 * s, display.x - 40), std::min(600 * s, display.y - 60)});
  bool open = true;
  ImGui::Begin(
      "Keys and mouse", &open,
      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoResize);
  static constexpr const char* kMouse[][2] = {
      {"Drag a point or pin", "move it; Shift keeps the axis"},
      {"Drag on empty canvas", "select with a box; Shift adds"},
      {"Double-click an edge", "insert a cage point"},
      {"Alt-click a point or pin", "delete it"},
      {"Drag the box of what is selected",
       "scale; the knob turns; Shift free or 15 degrees, Alt middle"},
      {"Ctrl-drag points, pins, strokes", "record their motion as keyframes, by the clock"},
      {"Ctrl-click a cage point", "smooth or corner; drag its tangents, Alt breaks them"},
      {"Drag the ring of a selected pin", "turn the picture around it; Shift: 15 degree steps"},
      {"Wheel on the ring", "scale the picture around the pin"},
      {"Drag a stroke", "move it; at an end, or with Ctrl, bend it"},
      {"Shift-drag with a stroke selected", "draw its new place"},
      {"With U, drag the outline", "bend it; with Ctrl move all of it"},
      {"With A, drag a corner's ring or arm", "turn it; open or shut it; Shift: 15 degree steps"},
      {"With A, drag an edge", "let it bend, or keep it straight"},
      {"Drag on the timeline", "go to a time; move a key, Alt between frames"},
      {"Middle drag, Space-drag", "pan"},
      {"Wheel", "zoom at the cursor"},
      {"Right click", "menu of what is under the cursor"},
      {"Ctrl-click a number field", "type into it"},
      {"Hold H", "hide cage and pins"},
      {"Hold \\", "show the original picture"},
      {"Enter, Backspace, Esc", "while drawing: close, take a point back, cancel"}};
  const auto row = [](const std::string& left, const std::string& right) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(left.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(right.c_str());
  };
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg)) {
    for (const auto& line : kMouse) row(line[0], line[1]);
    for (const Action& action : actions()) {
      std::string keys;
      for (const Shortcut& key : action.keys)
        if (keys.find(text_of(key)) == std::string::npos || text_of(key).size() == 1)
          keys += (keys.empty() ? "" : ", ") + text_of(key);
      if (!keys.empty()) row(keys, action.label);
    }
    ImGui::EndTable();
  }
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) open = false;
  ImGui::End();
  return open;
}

bool draw_palette(Workspace& workspace, std::string& text, bool opening, double scale) {
  const float s = static_cast<float>(scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x / 2, 80 * s}, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowSize({std::min(520 * s, display.x - 40), 380 * s});
  ImGui::Begin("Find an action", nullptr, kPanel & ~ImGuiWindowFlags_NoBringToFrontOnFocus);
  if (opening) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputTextWithHint("##palette", "Type what you want to do", &text,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  const Action* chosen = nullptr;
  bool first = true;
  for (const Action& action : actions()) {
    if (lower_case(action.label).find(lower_case(text)) == std::string::npos) continue;
    const bool enabled = action.enabled(workspace);
    if (entered && first && enabled) chosen = &action;
    first = false;
    ImGui::BeginDisabled(!enabled);
    if (ImGui::Selectable((action.label + "###" + action.id).c_str())) chosen = &action;
    ImGui::EndDisabled();
    if (!action.keys.empty()) {
      ImGui::SameLine(ImGui::GetWindowWidth() - 150 * s);
      ImGui::TextDisabled("%s", text_of(action.keys[0]).c_str());
    }
  }
  if (first) ImGui::TextDisabled("Nothing is called that.");
  const bool left =
      ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)) ||
      (ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows));
  ImGui::End();
  if (chosen) run(*chosen, workspace);
  return !chosen && !left;
}

}  // namespace holomorph
