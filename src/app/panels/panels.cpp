// Menus, toolbar, help and palette read the action table; nothing is listed twice.
#include "app/panels/panels.h"

#include <algorithm>
#include <utility>

namespace holomorph {

namespace {
constexpr float kTooltipWidth = 26;  ///< in units of the font size
}  // namespace

PanelSizes PanelSizes::at(double scale) {
  const double line = ImGui::GetFrameHeight();
  const double inspector = std::min(300 * scale, 0.38 * ImGui::GetIO().DisplaySize.x);
  PanelSizes sizes{line, 52 * scale, inspector, line + 6 * scale, line + 64 * scale};
  sizes.two_rows = ImGui::GetIO().DisplaySize.x - sizes.toolbar - sizes.inspector < 800 * scale;
  if (sizes.two_rows) sizes.timeline += line + 4 * scale;
  return sizes;
}

std::vector<Look> looks(const Preferences& now) {
  std::vector<Look> all;
  for (const auto& [theme, label] :
       {std::pair(Theme::dark, "Dark"), std::pair(Theme::light, "Light"),
        std::pair(Theme::contrast, "High contrast")}) {
    all.push_back({"Theme", label, now});
    all.back().preferences.theme = theme;
  }
  for (const double scale : {0.0, 1.0, 1.25, 1.5, 2.0}) {
    const std::string label =
        scale == 0 ? "Automatic" : std::to_string(std::lround(100 * scale)) + " %";
    all.push_back({"Interface size", label, now});
    all.back().preferences.ui_scale = scale;
  }
  return all;
}

void tooltip(const std::string& text) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTooltipWidth * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void tooltip_of(const Action& action) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(label_with_keys(action).c_str());
  if (*action.hint) {
    ImGui::PushTextWrapPos(kTooltipWidth * ImGui::GetFontSize());
    ImGui::TextDisabled("%s", action.hint);
    ImGui::PopTextWrapPos();
  }
  ImGui::EndTooltip();
}

void begin_card(const char* name, ImVec2 at, ImVec2 pivot, double scale) {
  ImGui::SetNextWindowPos(at, ImGuiCond_Always, pivot);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, static_cast<float>(8 * scale));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin(name, nullptr, kPanel | ImGuiWindowFlags_AlwaysAutoResize);
}

void end_card() {
  ImGui::End();
  ImGui::PopStyleVar(2);
}

bool text_row(int number, const std::string& text, bool selected, ImVec2 size,
              ImGuiSelectableFlags flags) {
  const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::CalcTextSize(text.c_str());
  if (size.x <= 0 && ImGui::GetContentRegionAvail().x < room.x)
    size.x = room.x;  // at least as wide as the text, for example in menus
  ImGui::PushID(number);
  const bool chosen = ImGui::Selectable("##row", selected, flags, size);
  ImGui::PopID();
  const float middle = (ImGui::GetItemRectMin().y + ImGui::GetItemRectMax().y) / 2;
  ImGui::GetWindowDrawList()->AddText({at.x, middle - room.y / 2},
                                      ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  return chosen;
}

bool escape_pressed() {
  bool& covered = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("covered"));
  const bool was = std::exchange(covered, ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId));
  return !was && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
}

namespace {

void action_item(const Action& action, Workspace& workspace) {
  const std::string keys = action.keys.empty() ? "" : text_of(action.keys[0]);
  const bool checked = action.checked && action.checked(workspace);
  if (ImGui::MenuItem(action.label.c_str(), keys.c_str(), checked, action.enabled(workspace)))
    run(action, workspace);
  if (*action.hint) tooltip_of(action);
}

void look_menu(const char* group, Preferences& preferences, PanelAnswer& answer) {
  if (!ImGui::BeginMenu(group)) return;
  for (const Look& look : looks(preferences))
    if (look.group == group &&
        ImGui::MenuItem(look.label.c_str(), "", look.preferences == preferences)) {
      preferences = look.preferences;
      answer.style_changed = true;
    }
  ImGui::EndMenu();
}

void menu_of(const char* name, Workspace& workspace) {
  for (const Action& action : workspace.actions.rows())
    if (std::string_view(action.menu) == name) action_item(action, workspace);
}

}  // namespace

void detail_slider(Workspace& workspace, float width) {
  float detail = static_cast<float>(workspace.tools.auto_cage.detail);
  ImGui::SetNextItemWidth(width);
  if (ImGui::SliderFloat("Detail", &detail, 0, 100, "%.0f", ImGuiSliderFlags_AlwaysClamp))
    workspace.tools.auto_cage.detail = detail;
  tooltip(
      "How closely the next cage made from the picture follows it. An opaque picture gets its "
      "rectangle.");
}

void hole_slider(Workspace& workspace, float width) {
  float smallest = static_cast<float>(workspace.tools.auto_cage.hole_width);
  ImGui::SetNextItemWidth(width);
  if (ImGui::SliderFloat("Smallest hole", &smallest, 0, 100, "%.1f %%",
                         ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
    workspace.tools.auto_cage.hole_width = smallest;
  tooltip(
      "Empty regions inside the picture become holes of the next cage if they are wider than this, "
      "in percent of the picture's size. 100 % fills all of them.");
}

PanelAnswer draw_menu_bar(Workspace& workspace, Preferences& preferences, PanelFocus* focus) {
  PanelAnswer answer;
  if (!ImGui::BeginMainMenuBar()) return answer;
  if (focus) focus->go_to_menu("File");
  const bool escape = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  for (const char* name : {"File", "Edit", "Tools", "Cage", "Layer", "Time", "View", "Help"}) {
    if (!ImGui::BeginMenu(name)) continue;
    if (std::string_view(name) == "File" &&
        ImGui::BeginMenu("Open recent", !preferences.recent.empty())) {
      for (size_t i = 0; i < preferences.recent.size(); ++i)
        if (text_row(static_cast<int>(i), preferences.recent[i].string(), false))
          answer.open = preferences.recent[i];
      ImGui::EndMenu();
    }
    menu_of(name, workspace);
    if (std::string_view(name) == "Cage") {
      ImGui::Separator();
      detail_slider(workspace, 160);
      hole_slider(workspace, 160);
      ImGui::Checkbox("Curved", &workspace.tools.auto_cage.curved);
    }
    if (escape) ImGui::CloseCurrentPopup();
    if (std::string_view(name) == "View") {
      ImGui::Separator();
      look_menu("Theme", preferences, answer);
      look_menu("Interface size", preferences, answer);
      if (ImGui::MenuItem("First steps", "", preferences.hints)) {
        preferences.hints = !preferences.hints;
        answer.preferences_changed = true;
      }
      if (ImGui::MenuItem("System file dialogs", "", preferences.native_dialogs)) {
        preferences.native_dialogs = !preferences.native_dialogs;
        answer.preferences_changed = true;
      }
    }
    ImGui::EndMenu();
  }
  const std::string title =
      workspace.document.empty()
          ? ""
          : workspace.document.title() + (workspace.document.modified() ? " *" : "");
  const float width = ImGui::CalcTextSize(title.c_str()).x;
  ImGui::SetCursorPosX(
      std::max(ImGui::GetCursorPosX() + 20, (ImGui::GetWindowWidth() - width) / 2));
  ImGui::TextDisabled("%s", title.c_str());
  ImGui::EndMainMenuBar();
  return answer;
}

void draw_toolbar(Workspace& workspace, double scale) {
  const PanelSizes sizes = PanelSizes::at(scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float s = static_cast<float>(scale);
  ImGui::SetNextWindowPos({0, static_cast<float>(sizes.menu)});
  ImGui::SetNextWindowSize({static_cast<float>(sizes.toolbar),
                            display.y - static_cast<float>(sizes.menu + sizes.status)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {6 * s, 8 * s});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});  // padding clips icons in small buttons
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8 * s, 5 * s});
  ImGui::Begin("Toolbar", nullptr, kPanel | ImGuiWindowFlags_NoScrollbar);
  static constexpr const char* kIds[] = {"tool.select",
                                         "tool.pen",
                                         "tool.pin",
                                         "tool.stroke",
                                         "tool.outline",
                                         "tool.angle",
                                         "tool.brush",
                                         "",
                                         "edit.soft",
                                         "edit.symmetry",
                                         "edit.snap",
                                         "",
                                         "cage.from_picture",
                                         "cage.rest",
                                         "",
                                         "edit.undo",
                                         "edit.redo",
                                         "",
                                         "view.fit",
                                         "view.timeline",
                                         "help.keys"};
  // Shrink the buttons until all buttons and lines fit into the height.
  const long lines = std::ranges::count(kIds, std::string_view(),
                                        [](const char* id) { return std::string_view(id); });
  const float buttons = static_cast<float>(std::size(kIds) - static_cast<size_t>(lines)),
              room = ImGui::GetContentRegionAvail().y - static_cast<float>(lines) * 21 * s,
              gap = ImGui::GetStyle().ItemSpacing.y;
  // If the buttons would become too small for their icons, use two columns.
  const bool pairs = room / buttons - gap < 24 * s;
  const float rows = pairs ? std::ceil(buttons / 2) + static_cast<float>(lines) / 2 : buttons;
  const ImVec2 button((pairs ? 18.5f : 40) * s, std::min(38 * s, room / rows - gap));
  bool left = true;  // the next button goes into the left column
  for (const char* id : kIds) {
    if (!*id) {
      left = true;
      ImGui::Dummy({0, 2 * s});
      ImGui::Separator();
      ImGui::Dummy({0, 2 * s});
      continue;
    }
    const Action& action = workspace.actions.named(id);
    const bool on = action.checked && action.checked(workspace),
               enabled = action.enabled(workspace);
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_HeaderActive));
    if (!left && pairs) ImGui::SameLine(0, 3 * s);
    left = !left;
    ImGui::BeginDisabled(!enabled);
    const std::string face = std::string(*action.icon ? action.icon : "\uf0b2") + "###" + id;
    if (ImGui::Button(face.c_str(), button)) run(action, workspace);
    ImGui::EndDisabled();
    if (on) ImGui::PopStyleColor();
    tooltip_of(action);
  }
  ImGui::End();
  ImGui::PopStyleVar(3);
}

bool begin_combo(const char* label, const char* preview) {
  if (!ImGui::BeginCombo(label, preview, ImGuiComboFlags_HeightLargest)) return false;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  return true;
}

void draw_context_menu(Workspace& workspace) {
  if (!ImGui::BeginPopup("context")) return;
  for (const char* id : {"edit.delete", "edit.reset", "edit.pin_up", "edit.pin_down",
                         "edit.free_angle", "cage.corner", "cage.raise", "cage.lower",
                         "edit.select_all", "view.frame", "view.fit", "cage.rest"})
    if (const Action& action = workspace.actions.named(id); action.enabled(workspace))
      action_item(action, workspace);
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace holomorph
