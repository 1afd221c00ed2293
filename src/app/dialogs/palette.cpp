// Up and Down choose a row, and Enter runs it. Disabled rows are gray.
#include "app/dialogs/palette.h"

#include <algorithm>
#include <utility>

#include "app/look/controls.h"
#include "app/look/surfaces.h"
#include "edit/actions/icons.h"
#include "edit/edits/edits.h"
#include "edit/edits/method_edits.h"
#include "system/text.h"
// Must follow imgui.h, because it does not include that header itself.
#include <imgui_stdlib.h>

namespace holomorph {
namespace {

struct Row {
  std::string label, keys;
  std::string found_by = {};  ///< searched in addition to the label
  bool enabled = true, checked = false;
  std::function<void()> run;
};

/// Adds rows for methods, presets and parameters. A row makes its change only when it is run.
void add_method_rows(Workspace& workspace, std::vector<Row>& rows) {
  const Deformation& deformation = workspace.shown.deformation();
  const Method& method = method_named(deformation.method);
  const auto add = [&](const std::string& label, bool is,
                       std::function<void(Deformation&)> change) {
    rows.push_back({label, "", "", deformation.has_cage(), is, [&workspace, label, change] {
                      Deformation after = workspace.shown.deformation();
                      change(after);
                      workspace.commit(label, std::move(after));
                    }});
  };
  for (const Method& other : methods())
    add("Method: " + other.label, other.id == method.id,
        [id = other.id](Deformation& after) { after = with_method(std::move(after), id); });
  for (const Preset& preset : method.presets) {
    const bool is = std::ranges::all_of(preset.parameters, [&](const auto& entry) {
      return parameter(method, deformation.parameters, entry.first) == entry.second;
    });
    add("Preset: " + preset.label, is,
        [preset](Deformation& after) { after = with_preset(std::move(after), preset); });
  }
  for (const ParameterSpec& spec : method.parameters) {
    if (spec.needs_parts && deformation.rest.parts.empty()) continue;
    std::vector<std::string> names;
    if (spec.type == ParameterSpec::Type::toggle) names = {"off", "on"};
    if (spec.type == ParameterSpec::Type::choice)
      for (const auto& option : spec.options) names.push_back(option.label);
    for (size_t i = 0; i < names.size(); ++i) {
      const double value = static_cast<double>(i);
      add(spec.label + ": " + names[i],
          parameter(method, deformation.parameters, spec.key) == value,
          [key = spec.key, value](Deformation& after) { after.parameters[key] = value; });
    }
  }
}

std::vector<Row> rows_of(Workspace& workspace, Preferences& preferences, PanelAnswer& answer) {
  std::vector<Row> rows;
  for (const Action& action : workspace.actions.rows())
    if (action.run)
      rows.push_back({action.label, action.keys.empty() ? "" : text_of(action.keys[0]),
                      action.id + " " + action.hint, action.enabled(workspace),
                      action.checked && action.checked(workspace),
                      [&, id = action.id] { run(id, workspace); }});
  add_method_rows(workspace, rows);
  for (const Look& look : looks(preferences))
    rows.push_back(
        {look.group + ": " + look.label, "", "", true, look.preferences == preferences, [&, look] {
           preferences = look.preferences;
           answer.style_changed = true;
         }});
  return rows;
}

}  // namespace

void Palette::show() {
  open_ = opening_ = true;
  text_.clear();
  chosen_ = 0;
}

PanelAnswer Palette::draw(Workspace& workspace, Preferences& preferences) {
  PanelAnswer answer;
  if (!open_) return answer;
  const ThemeColors& c = theme_colors();
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize(
      {std::min(px(560), display.x - px(40)), std::min(px(408), display.y - px(112))});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(8), px(8)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, color_of(c.raised));
  begin_floating("Find an action", {display.x / 2, px(64)}, {0.5f, 0.0f});
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  if (std::exchange(opening_, false)) ImGui::SetKeyboardFocusHere();
  const bool entered = text_field("##palette", text_, "Type what you want to do", -1);
  if (ImGui::IsItemEdited()) chosen_ = 0;
  std::vector<Row> rows = rows_of(workspace, preferences, answer);
  std::erase_if(rows,
                [&](const Row& row) { return !has_words(row.label + " " + row.found_by, text_); });
  // Enabled rows come first.
  std::stable_partition(rows.begin(), rows.end(), [](const Row& row) { return row.enabled; });
  const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
  const int step = pressed(ImGuiKey_DownArrow) ? 1 : pressed(ImGuiKey_UpArrow) ? -1 : 0;
  chosen_ = std::clamp(chosen_ + step, 0, std::max(0, static_cast<int>(rows.size()) - 1));
  const Row* run = nullptr;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGui::BeginChild("rows");
  for (size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const bool chosen = static_cast<int>(i) == chosen_;
    ImGui::BeginDisabled(!row.enabled);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = px(28);
    if (ImGui::Selectable(("###" + row.label).c_str(), chosen, 0, {width, height})) run = &row;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = at.y + height / 2, y = middle - font(Type::body)->FontSize / 2;
    if (row.checked)
      draw_icon(list, icon_named("check"), {at.x + px(14), middle}, c.accent, Type::caption);
    draw_text(list, Type::body, {at.x + px(28), y}, c.text, row.label);
    if (!row.keys.empty())
      draw_text(list, Type::body, {at.x + width - text_size(Type::body, row.keys).x - px(8), y},
                c.muted, row.keys);
    ImGui::EndDisabled();
    if (chosen && step != 0) ImGui::SetScrollHereY();
    if (chosen && entered && row.enabled) run = &row;
  }
  if (rows.empty()) muted_text("Nothing found.");
  ImGui::EndChild();
  ImGui::PopStyleVar();
  const bool left =
      pressed(ImGuiKey_Escape) ||
      (ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows));
  end_card();
  open_ = !run && !left;
  opening_ = open_ && entered;  // keeps the focus on the field if Enter did not close the palette
  if (run) run->run();
  return answer;
}

}  // namespace holomorph
