// Menus, toolbar, help and palette read the action table; nothing is listed twice.
#include "app/panels.h"

#include <algorithm>
#include <utility>

#include "scene/report.h"

namespace holomorph {

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
        scale == 0 ? "As the display" : std::to_string(std::lround(100 * scale)) + " %";
    all.push_back({"Size of the interface", label, now});
    all.back().preferences.ui_scale = scale;
  }
  return all;
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

void tooltip_of(const char* id) {
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("%s", label_with_keys(action_named(id)).c_str());
}

void menu_of(const char* name, Workspace& workspace) {
  for (const Action& action : actions())
    if (std::string_view(action.menu) == name) action_item(action, workspace);
}

}  // namespace

void points_slider(Workspace& workspace, float width) {
  ImGui::SetNextItemWidth(width);
  ImGui::SliderInt("points", &workspace.auto_cage_vertices, 4, 200, "%d",
                   ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("For the next cage that is made from the picture; an opaque one gets four");
}

PanelAnswer draw_menu_bar(Workspace& workspace, Preferences& preferences, bool opens) {
  PanelAnswer answer;
  if (!ImGui::BeginMainMenuBar()) return answer;
  if (opens) ImGui::OpenPopup("File");
  const bool escape = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  for (const char* name : {"File", "Edit", "Tools", "Cage", "Layer", "Time", "View", "Help"}) {
    if (!ImGui::BeginMenu(name)) continue;
    if (std::string_view(name) == "File" &&
        ImGui::BeginMenu("Open recent", !preferences.recent.empty())) {
      for (const Path& path : preferences.recent)
        if (ImGui::MenuItem(path.c_str())) answer.open = path;
      ImGui::EndMenu();
    }
    menu_of(name, workspace);
    if (std::string_view(name) == "Cage") {
      ImGui::Separator();
      points_slider(workspace, 160);
      ImGui::Checkbox("curved", &workspace.auto_cage_curved);
    }
    if (escape) ImGui::CloseCurrentPopup();
    if (std::string_view(name) == "View") {
      ImGui::Separator();
      look_menu("Theme", preferences, answer);
      look_menu("Size of the interface", preferences, answer);
      if (ImGui::MenuItem("First steps", "", preferences.hints)) {
        preferences.hints = !preferences.hints;
        answer.preferences_changed = true;
      }
      if (ImGui::MenuItem("The desktop's file dialogs", "", preferences.native_dialogs)) {
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
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});  // low buttons keep their icons whole
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
  // All buttons and lines fit into any height.
  const long lines = std::ranges::count(kIds, std::string_view(),
                                        [](const char* id) { return std::string_view(id); });
  const float buttons = static_cast<float>(std::size(kIds) - static_cast<size_t>(lines)),
              room = ImGui::GetContentRegionAvail().y - static_cast<float>(lines) * 21 * s,
              gap = ImGui::GetStyle().ItemSpacing.y;
  // Where they would become too low for their icons they stand in two columns.
  const bool pairs = room / buttons - gap < 24 * s;
  const float rows = pairs ? std::ceil(buttons / 2) + static_cast<float>(lines) / 2 : buttons;
  const ImVec2 button((pairs ? 18.5f : 40) * s, std::min(38 * s, room / rows - gap));
  bool left = true;  // the next one stands at the left
  for (const char* id : kIds) {
    if (!*id) {
      left = true;
      ImGui::Dummy({0, 2 * s});
      ImGui::Separator();
      ImGui::Dummy({0, 2 * s});
      continue;
    }
    const Action& action = action_named(id);
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
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("%s", label_with_keys(action).c_str());
  }
  ImGui::End();
  ImGui::PopStyleVar(3);
}

namespace {

/// Green that is readable on the bar of either theme.
ImVec4 proved_color() {
  const ImVec4 bar = ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg);
  return bar.x > 0.5f ? ImVec4(0.05f, 0.45f, 0.15f, 1) : ImVec4(0.45f, 0.85f, 0.5f, 1);
}

}  // namespace

void draw_status_bar(Workspace& workspace, const StatusLine& status, double scale) {
  const PanelSizes sizes = PanelSizes::at(scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float s = static_cast<float>(scale), height = static_cast<float>(sizes.status);
  ImGui::SetNextWindowPos({0, display.y - height});
  ImGui::SetNextWindowSize({display.x, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12 * s, 4 * s});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
  ImGui::Begin("Status", nullptr, kPanel | ImGuiWindowFlags_NoScrollbar);
  ImGui::AlignTextToFramePadding();
  const LiveMap& map = workspace.map();
  std::string hint, note;
  ImVec4 note_color;
  if (map.error()) {
    ImGui::TextColored({1.0f, 0.45f, 0.4f, 1}, "\uf071 %s", map.error()->what());
    if (const auto where = map.error()->where()) {
      ImGui::SameLine();
      if (ImGui::SmallButton("Show me")) workspace.viewport.center = *where;
    }
  } else {
    hint = status.hint;
    const auto state = map.map().status;
    if (map.has_map() && state == SampledMap::Status::certified) {
      note = "\uf00c " + map.map().note;
      note_color = proved_color();
    } else if (map.has_map() && state == SampledMap::Status::infeasible) {
      note = "\uf071 " + map.map().note;
      note_color = {1.0f, 0.45f, 0.4f, 1};
    } else if (!map.injectivity().folds_at.empty()) {
      ImGui::TextColored({1.0f, 0.45f, 0.4f, 1}, "\uf071 The picture folds over itself");
      ImGui::SameLine();
      if (ImGui::SmallButton("Show me")) run(action_named("view.fold"), workspace);
      ImGui::SameLine();
    }
  }
  char right[240] = "";
  int used = 0;
  const auto add = [&](const char* format, auto... values) {
    used +=
        std::snprintf(right + used, sizeof right - static_cast<size_t>(used), format, values...);
    used = std::min(used, static_cast<int>(sizeof right) - 1);
  };
  const Influence& influence = workspace.influence;
  if (influence.soft) add("Soft, %.0f   ", influence.reach);
  if (influence.symmetric) add("%s   ", "Symmetry");
  if (workspace.snaps) add("%s   ", "Snap");
  if (status.cursor) add("%.1f, %.1f   ", status.cursor->real(), status.cursor->imag());
  if (status.cursor_at_rest)
    add("from %.1f, %.1f   ", status.cursor_at_rest->real(), status.cursor_at_rest->imag());
  if (!workspace.document.empty()) add("%.0f %%   ", 100 * workspace.viewport.zoom);
  if (map.has_map()) {
    add("%s: ", method_named(workspace.scene().method).label.c_str());
    const bool closed_form = map.map().status == SampledMap::Status::exact;
    add("%s%.2f ms%s   ",
        closed_form ? "" : (std::string(name_of(map.map().status)) + ", ").c_str(),
        map.pose_milliseconds(), status.by_operator ? " (GPU)" : "");
  }
  if (!workspace.document.empty()) add("%s", status.draft ? "draft" : "final");
  const float width = ImGui::CalcTextSize(right).x;
  // Cut off before it reaches the figures.
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushClipRect(at, {display.x - width - 30 * s, display.y}, true);
  if (!note.empty()) {
    const float left = display.x - width - 30 * s - ImGui::GetCursorScreenPos().x;
    ImGui::TextColored(note_color, "%s", fitted_text(note, left).c_str());
    ImGui::SameLine();
  }
  const float room = display.x - width - 30 * s - ImGui::GetCursorScreenPos().x;
  ImGui::TextUnformatted(fitted_text(hint, room).c_str());
  ImGui::PopClipRect();
  ImGui::SameLine(display.x - width - 14 * s);
  ImGui::TextDisabled("%s", right);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
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
    if (const Action& action = action_named(id); action.enabled(workspace))
      action_item(action, workspace);
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void draw_missing_picture(Workspace& workspace, double scale, float above) {
  const std::vector<size_t> missing = workspace.document.without_picture();
  if (missing.empty()) return;
  const Path file = layer_at(workspace.document.scene(), missing.front()).image->file;
  const float s = static_cast<float>(scale);
  const Viewport& view = workspace.viewport;
  ImGui::SetNextWindowPos({static_cast<float>(view.left + view.width / 2),
                           static_cast<float>(view.top + view.height) - std::max(24 * s, above)},
                          ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8 * s);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin("Missing picture", nullptr, kPanel | ImGuiWindowFlags_AlwaysAutoResize);
  std::error_code ignored;
  const bool is_there = std::filesystem::exists(file, ignored);
  ImGui::Text(
      "\uf071  %s %s%s", file.filename().c_str(), is_there ? "cannot be read" : "is missing",
      missing.size() > 1 ? (", and " + std::to_string(missing.size() - 1) + " more").c_str() : "");
  ImGui::PushTextWrapPos(static_cast<float>(std::min(420 * scale, view.width - 48 * scale)));
  ImGui::TextDisabled("It %s in %s.", is_there ? "is" : "was", file.parent_path().c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::Button("Find it...")) run(action_named("file.find_picture"), workspace);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

float draw_cage_offer(Workspace& workspace, double scale) {
  if (!workspace.document.image() || workspace.scene().has_cage()) return 0;
  const float s = static_cast<float>(scale);
  const Viewport& view = workspace.viewport;
  ImGui::SetNextWindowPos({static_cast<float>(view.left + view.width / 2),
                           static_cast<float>(view.top + view.height) - 24 * s},
                          ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8 * s);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin("Cage offer", nullptr, kPanel | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextUnformatted("This picture needs a cage before it can bend.");
  // Beside each other where there is room.
  const bool row = view.width > 600 * scale;
  const auto button = [&](const char* face, const char* id) {
    if (ImGui::Button(face, {190 * s, 0})) run(action_named(id), workspace);
    tooltip_of(id);
    if (row) ImGui::SameLine();
  };
  button("\uf0d0  Make from picture", "cage.from_picture");
  button("\uf040  Draw it", "tool.pen");
  button("\uf047  Only move and scale", "cage.box");
  if (row) ImGui::NewLine();
  points_slider(workspace, 190 * s);
  ImGui::SameLine();
  ImGui::Checkbox("curved", &workspace.auto_cage_curved);
  const float height = ImGui::GetWindowHeight();
  ImGui::End();
  ImGui::PopStyleVar(2);
  return height + 32 * s;
}

PanelAnswer draw_welcome(Workspace& workspace, const Preferences& preferences,
                         const std::vector<Sample>& samples,
                         const std::vector<Recovery>& recoverable, double scale) {
  PanelAnswer answer;
  const float s = static_cast<float>(scale);
  const PanelSizes sizes = PanelSizes::at(scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, static_cast<float>(sizes.menu)});
  ImGui::SetNextWindowSize({display.x, display.y - static_cast<float>(sizes.menu + sizes.status)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {48 * s, 32 * s});
  ImGui::Begin("Welcome", nullptr, kPanel);
  ImGui::PushFont(title_font());
  ImGui::TextUnformatted("Holomorph");
  ImGui::PopFont();
  ImGui::TextDisabled("Bend a picture: give it a cage, then drag cage points and pins.");
  ImGui::Dummy({0, 8 * s});
  if (ImGui::Button("\uf07c  Open a picture or a scene", {270 * s, 40 * s}))
    run(action_named("file.open"), workspace);
  ImGui::SameLine();
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + (40 * s - ImGui::GetTextLineHeight()) / 2 - 5 * s);
  ImGui::TextDisabled("or drop a file on this window");
  if (!recoverable.empty()) {
    ImGui::Dummy({0, 8 * s});
    ImGui::PushStyleColor(ImGuiCol_Text, canvas_colors(preferences.theme).warning);
    ImGui::TextUnformatted("Work that was not saved:");
    ImGui::PopStyleColor();
    for (const auto& [path, label] : recoverable) {
      ImGui::PushID(path.c_str());
      ImGui::AlignTextToFramePadding();
      ImGui::TextUnformatted(label.c_str());
      ImGui::SameLine();
      if (ImGui::Button("Recover")) answer.recover = path;
      ImGui::SameLine();
      // Twice, because it cannot be undone.
      bool& sure = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("sure"));
      if (ImGui::Button(sure ? "Really discard?###discard" : "Discard###discard")) {
        if (sure) answer.discard = path;
        sure = !sure;
      }
      ImGui::PopID();
    }
  }
  ImGui::Dummy({0, 10 * s});
  ImGui::TextUnformatted("Samples");
  // All in one row, if that does not make them too small.
  const float count = static_cast<float>(std::max<size_t>(samples.size(), 1)),
              tile = std::clamp((display.x - 116 * s) / count - 20 * s, 110 * s, 200 * s);
  for (size_t i = 0; i < samples.size(); ++i) {
    const Sample& sample = samples[i];
    ImGui::PushID(static_cast<int>(i));
    if (i > 0 && ImGui::GetItemRectMax().x + tile + 60 * s < display.x) ImGui::SameLine(0, 20 * s);
    ImGui::BeginGroup();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::Button("##tile", {tile, tile})) answer.sample = sample.scene;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (sample.thumbnail.id()) {
      const float w = static_cast<float>(sample.thumbnail.width()),
                  h = static_cast<float>(sample.thumbnail.height());
      const float fit = (tile - 24 * s) / std::max(w, h);
      const ImVec2 corner(at.x + (tile - w * fit) / 2, at.y + (tile - h * fit) / 2);
      list.AddImage(
          reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(sample.thumbnail.id())), corner,
          {corner.x + w * fit, corner.y + h * fit});
    }
    ImGui::TextUnformatted(sample.title.c_str());
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + tile);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", sample.text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::EndGroup();
    ImGui::PopID();
  }
  if (!preferences.recent.empty()) {
    ImGui::Dummy({0, 10 * s});
    ImGui::TextUnformatted("Recent");
    for (size_t i = 0; i < std::min<size_t>(preferences.recent.size(), 6); ++i)
      if (ImGui::Selectable(preferences.recent[i].c_str(), false, 0,
                            {std::min(display.x - 100 * s, 640 * s), 0}))
        answer.open = preferences.recent[i];
  }
  ImGui::End();
  ImGui::PopStyleVar();
  return answer;
}

}  // namespace holomorph
