// The menu bar, with the name of the scene in its middle, and the context menu.
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/look/controls.h"
#include "app/look/surfaces.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"
#include "edit/actions/menus.h"

namespace holomorph {
namespace {

/// What drawing the menus needs and finds out.
struct MenuDrawing {
  Workspace& workspace;
  Preferences& preferences;
  Thumbnails& thumbnails;
  PanelAnswer& answer;
  bool leaves_out_disabled = false;
};

void action_entry(const std::string& id, MenuDrawing& drawing) {
  const Action& action = drawing.workspace.actions.named(id);
  const std::string keys = action.keys.empty() ? "" : text_of(action.keys[0]);
  const bool checked = action.checked && action.checked(drawing.workspace);
  const bool enabled = action.enabled(drawing.workspace),
             chosen = menu_entry(action.label, keys, checked, enabled);
  const char* hint = !enabled && *action.needs ? action.needs : action.hint;
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) && *hint)
    drawing.answer.hint = hint;
  if (chosen) run(action, drawing.workspace);
}

void recent_menu(MenuDrawing& drawing) {
  const std::vector<Path>& recent = drawing.preferences.recent;
  if (!begin_menu("Open recent", !recent.empty())) return;
  for (size_t i = 0; i < recent.size(); ++i)
    if (recent_row(static_cast<int>(i), recent[i], drawing.thumbnails))
      drawing.answer.open = recent[i];
  end_menu();
}

void look_entries(const char* group, MenuDrawing& drawing) {
  for (const Look& look : looks(drawing.preferences))
    if (look.group == group &&
        menu_entry(look.label, "", look.preferences == drawing.preferences)) {
      drawing.preferences = look.preferences;
      drawing.answer.style_changed = true;
    }
}

void interface_menu(MenuDrawing& drawing) {
  if (!begin_menu("Interface")) return;
  look_entries("Theme", drawing);
  menu_separator();
  if (begin_menu("Interface size")) {
    look_entries("Interface size", drawing);
    end_menu();
  }
  const auto setting = [&](const char* label, bool& on) {
    if (!menu_entry(label, "", on)) return;
    on = !on;
    drawing.answer.preferences_changed = true;
  };
  if (menu_entry("Reduce motion", "", drawing.preferences.reduce_motion)) {
    drawing.preferences.reduce_motion = !drawing.preferences.reduce_motion;
    drawing.answer.style_changed = true;
  }
  setting("First steps", drawing.preferences.hints);
  setting("System file dialogs", drawing.preferences.native_dialogs);
  end_menu();
}

void entries(const std::vector<MenuItem>& items, MenuDrawing& drawing) {
  bool separates = false, any = false;  // no separator at the start, and never two
  for (const MenuItem& item : items) {
    if (item.name.empty()) {
      separates = any;
      continue;
    }
    const bool action = item.entries.empty() && item.name[0] != '*';
    if (action && drawing.leaves_out_disabled &&
        !drawing.workspace.actions.named(item.name).enabled(drawing.workspace))
      continue;
    if (std::exchange(separates, false)) menu_separator();
    any = true;
    if (item.name == "*recent")
      recent_menu(drawing);
    else if (item.name == "*interface")
      interface_menu(drawing);
    else if (action)
      action_entry(item.name, drawing);
    else if (begin_menu(item.name.c_str())) {
      entries(item.entries, drawing);
      end_menu();
    }
  }
}

/// The name of the scene in the middle of the bar, if it does not touch the menus.
void draw_scene_name(const Workspace& workspace, float menus_end, float buttons, float height) {
  if (workspace.document.empty()) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float width = ImGui::GetWindowWidth();
  const Document& document = workspace.document;
  const Path file = document.path().empty() ? document.first_picture() : document.path();
  const std::string name = file.empty() ? "Untitled" : file.stem().string(),
                    state = document.path().empty() ? "  \u2014  Not saved"
                            : document.modified()   ? "  \u2014  Edited"
                                                    : "";
  const float long_name = text_size(Type::strong, name).x,
              long_state = text_size(Type::body, state).x;
  float x = (width - long_name - long_state) / 2;
  x = std::max(x, menus_end + px(16));
  if (x + long_name + long_state > buttons - px(16)) return;
  const float y = (height - font(Type::body)->FontSize) / 2;
  draw_text(list, Type::strong, {x, y}, theme_colors().text, name);
  draw_text(list, Type::body, {x + long_name, y}, theme_colors().muted, state);
}

}  // namespace

PanelAnswer draw_menu_bar(Workspace& workspace, Preferences& preferences, Thumbnails& thumbnails,
                          PanelFocus* focus) {
  PanelAnswer answer;
  MenuDrawing drawing{workspace, preferences, thumbnails, answer};
  const float height = px(36);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {px(8), (height - ImGui::GetFontSize()) / 2});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(10), px(8)});
  const bool open = ImGui::BeginMainMenuBar();
  ImGui::PopStyleVar(1);
  if (!open) {
    ImGui::PopStyleVar(1);
    return answer;
  }
  if (focus) focus->go_to_menu("File");
  const bool escape = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(20), px(8)});
  for (const MenuItem& menu : menus()) {
    const bool shown = begin_menu(menu.name.c_str());
    if (!shown) continue;
    entries(menu.entries, drawing);
    if (escape) ImGui::CloseCurrentPopup();
    end_menu();
  }
  ImGui::PopStyleVar();
  const float menus_end = ImGui::GetCursorPosX(), side = px(28), small = px(24);
  const float export_width = text_size(Type::strong, "Export").x + px(20),
              buttons = ImGui::GetWindowWidth() - export_width - 3 * side - px(56);
  draw_scene_name(workspace, menus_end, buttons, height);
  if (!workspace.document.empty() && buttons > menus_end) {
    const auto place = [&](float x, float tall) {
      ImGui::SetCursorPos({std::round(x), std::round((height - tall) / 2)});
    };
    float x = buttons + px(8);
    for (const char* id : {"edit.undo", "edit.redo"}) {
      place(x, side);
      action_icon_button(id, workspace);
      x += side + px(4);
    }
    x += px(8);
    const float middle = height / 2;
    ImGui::GetWindowDrawList()->AddLine({x - px(6), middle - px(10)}, {x - px(6), middle + px(10)},
                                        faded(theme_colors().line));
    place(x, side);
    action_icon_button("view.before_after", workspace);
    x += side + px(8);
    place(x, small);
    if (small_button("Export", ButtonKind::primary)) run("file.export", workspace);
    tooltip_of(workspace.actions.named("file.export"));
  }
  ImGui::EndMainMenuBar();
  ImGui::PopStyleVar(1);
  return answer;
}

PanelAnswer draw_context_menu(Workspace& workspace, Preferences& preferences,
                              Thumbnails& thumbnails) {
  PanelAnswer answer;
  if (!begin_menu_popup("context")) return answer;
  MenuDrawing drawing{workspace, preferences, thumbnails, answer, true};
  entries(context_menu(), drawing);
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  end_menu_popup();
  return answer;
}

}  // namespace holomorph
