// Up and Down choose, Enter runs, and what cannot be done now is grey.
#include "app/palette.h"

#include <algorithm>
#include <utility>

#include "app/panels.h"
#include "edit/edits.h"
// After imgui.h, which it does not include itself.
#include <imgui_stdlib.h>

namespace holomorph {
namespace {

struct Row {
  std::string label, keys;
  bool enabled = true;
  std::function<void(Workspace&)> run;
};

std::vector<Row> rows_of(const Workspace& workspace) {
  std::vector<Row> rows;
  for (const Action& action : actions())
    if (action.run)
      rows.push_back({action.label, action.keys.empty() ? "" : text_of(action.keys[0]),
                      action.enabled(workspace),
                      [id = action.id](Workspace& w) { run(action_named(id), w); }});
  for (const Method& method : methods())
    rows.push_back({"Method: " + method.label, "", workspace.scene().has_cage(),
                    [id = method.id, label = method.label](Workspace& w) {
                      w.commit("Method: " + label, with_method(w.scene(), id));
                    }});
  return rows;
}

}  // namespace

void Palette::show() {
  open_ = opening_ = true;
  text_.clear();
  chosen_ = 0;
}

void Palette::draw(Workspace& workspace, double scale) {
  if (!open_) return;
  const float s = static_cast<float>(scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x / 2, 80 * s}, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowSize(
      {std::min(560 * s, display.x - 40), std::min(400 * s, display.y - 120 * s)});
  ImGui::Begin("Find an action", nullptr, kPanel & ~ImGuiWindowFlags_NoBringToFrontOnFocus);
  if (std::exchange(opening_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputTextWithHint("##palette", "Type what you want to do", &text_,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemEdited()) chosen_ = 0;
  std::vector<Row> rows = rows_of(workspace);
  std::erase_if(rows, [&](const Row& row) { return !has_words(row.label, text_); });
  // What can be done now comes first.
  std::stable_partition(rows.begin(), rows.end(), [](const Row& row) { return row.enabled; });
  const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
  const int step = pressed(ImGuiKey_DownArrow) ? 1 : pressed(ImGuiKey_UpArrow) ? -1 : 0;
  chosen_ = std::clamp(chosen_ + step, 0, std::max(0, static_cast<int>(rows.size()) - 1));
  const Row* run = nullptr;
  ImGui::BeginChild("rows");
  for (size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const bool chosen = static_cast<int>(i) == chosen_;
    ImGui::BeginDisabled(!row.enabled);
    if (ImGui::Selectable((row.label + "###" + row.label).c_str(), chosen)) run = &row;
    ImGui::EndDisabled();
    if (chosen && step != 0) ImGui::SetScrollHereY();
    if (chosen && entered && row.enabled) run = &row;
    if (row.keys.empty()) continue;
    ImGui::SameLine(ImGui::GetWindowWidth() - 150 * s);
    ImGui::TextDisabled("%s", row.keys.c_str());
  }
  if (rows.empty()) ImGui::TextDisabled("Nothing is called that.");
  ImGui::EndChild();
  const bool left =
      pressed(ImGuiKey_Escape) ||
      (ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows));
  ImGui::End();
  open_ = !run && !left;
  opening_ = open_ && entered;  // nothing was run: the field goes on taking what is typed
  if (run) run->run(workspace);
}

}  // namespace holomorph
