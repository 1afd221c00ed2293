// The welcome page of an empty window: what to do at the left, recent files and samples at the
// right.
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "app/look/controls.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"

namespace holomorph {
namespace {

constexpr size_t kMostLarge = 8;  ///< recent files with large tiles

/// A row of the column of actions: an icon, a label, and a key at the right.
bool action_row(const char* icon, const std::string& label, const std::string& key) {
  const ThemeColors& c = theme_colors();
  const ImVec2 at = ImGui::GetCursorScreenPos(), size(ImGui::GetContentRegionAvail().x, px(32));
  const bool clicked = ImGui::InvisibleButton(label.c_str(), size);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (hovered)
    list.AddRectFilled(at - ImVec2(px(8), 0), at + size + ImVec2(px(8), 0), faded(c.hover), px(6));
  const float middle = at.y + size.y / 2;
  draw_icon(list, icon, {at.x + px(10), middle}, hovered ? c.text : c.muted);
  draw_text(list, Type::body, {at.x + px(32), middle - font(Type::body)->FontSize / 2}, c.text,
            label);
  draw_text(
      list, Type::caption,
      {at.x + size.x - text_size(Type::caption, key).x, middle - font(Type::caption)->FontSize / 2},
      c.muted, key);
  draw_focus_ring(px(6));
  name_item(label);
  return clicked;
}

void unsaved_work(const std::vector<Recovery>& recoverable, PanelAnswer& answer) {
  if (recoverable.empty()) return;
  ImGui::Dummy({0, px(8)});
  colored_text(theme_colors().warning, "Unsaved work");
  for (const auto& [path, label, origin] : recoverable) {
    ImGui::PushID(path.c_str());
    wrapped_text(label);
    if (small_button("Recover", ButtonKind::primary)) answer.recover = path;
    ImGui::SameLine();
    // Requires a second click, because discarding cannot be undone.
    bool& sure = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("sure"));
    if (small_button(sure ? "Really discard?" : "Discard", ButtonKind::flat_danger)) {
      if (sure) answer.discard = path;
      sure = !sure;
    }
    ImGui::PopID();
  }
}

/// A tile with a picture and two lines below it.
struct Tile {
  std::string id, title, text;
  const Texture* texture = nullptr;
  float progress = -1;  ///< of the pose that plays; negative: none
};

/// Draws a tile. Returns whether it was clicked, and whether the pointer is on it.
std::pair<bool, bool> draw_tile(const Tile& tile, ImVec2 size) {
  const ThemeColors& c = theme_colors();
  ImGui::BeginGroup();
  const bool clicked = ImGui::InvisibleButton(tile.id.c_str(), size);
  const bool hovered = ImGui::IsItemHovered();
  const bool focused = ImGui::IsItemFocused() && !ImGui::GetCurrentContext()->NavDisableHighlight;
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(from, to, faded(hovered ? c.hover : c.panel), px(8));
  if (tile.texture && tile.texture->id()) {
    const float w = static_cast<float>(tile.texture->width()),
                h = static_cast<float>(tile.texture->height());
    const float fit = std::min((size.x - px(24)) / w, (size.y - px(24)) / h);
    const ImVec2 corner((from.x + to.x - w * fit) / 2, (from.y + to.y - h * fit) / 2);
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(tile.texture->id())),
                  corner, {corner.x + w * fit, corner.y + h * fit}, {0, 0}, {1, 1},
                  faded(IM_COL32_WHITE));
  }
  list.AddRect(from, to, faded(hovered || focused ? c.accent : c.line), px(8), 0,
               hovered || focused ? px(2) : 1);
  if (tile.progress >= 0) {
    const float x0 = from.x + px(12), x1 = to.x - px(12), y = to.y - px(10);
    list.AddRectFilled({x0, y}, {x1, y + px(3)}, faded(c.edge), px(2));
    list.AddRectFilled({x0, y}, {x0 + tile.progress * (x1 - x0), y + px(3)}, faded(c.accent),
                       px(2));
  }
  name_item(tile.title);
  {
    const ScopedFont strong(Type::strong);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - px(2));
    ImGui::TextUnformatted(shortened_text(tile.title, size.x).c_str());
  }
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() - px(6));
  const ScopedFont small(Type::caption);
  muted_text(shortened_text(tile.text, size.x));
  ImGui::EndGroup();
  return {clicked, hovered};
}

/// How many tiles of at least this width fit into a row, and the width that fills the row.
struct Columns {
  size_t count = 1;
  float width = 1;
};
Columns columns_of(float room, float least, float gap, size_t most) {
  const float fit = std::floor((room + gap) / (least + gap));
  Columns columns;
  columns.count = std::clamp<size_t>(static_cast<size_t>(std::max(fit, 1.0f)), 1, most);
  columns.width = std::floor((room + gap) / static_cast<float>(columns.count)) - gap;
  return columns;
}

void heading(const char* text) {
  const ScopedFont title(Type::title);
  ImGui::TextUnformatted(text);
}

void draw_actions(Workspace& workspace, const std::vector<Recovery>& recoverable,
                  PanelAnswer& answer) {
  ImGui::Dummy({0, px(8)});
  {
    const ScopedFont display(Type::display);
    ImGui::TextUnformatted("Holomorph");
  }
  muted_text("Bend a picture as if it were rubber.");
  ImGui::Dummy({0, px(8)});
  if (button(std::string(icon_named("folder")) + "  Open a picture or scene", ButtonKind::primary,
             -1))
    run("file.open", workspace);
  caption("or drop a file anywhere in this window");
  unsaved_work(recoverable, answer);
  ImGui::Dummy({0, px(8)});
  const ActionTable& actions = workspace.actions;
  const auto row = [&](const char* icon, const char* label, const char* id) {
    const Action& action = actions.named(id);
    if (action_row(icon, label, action.keys.empty() ? "" : text_of(action.keys[0])))
      run(id, workspace);
  };
  row(icon_named("picture"), "New from clipboard", "file.paste_picture");
  row(icon_named("search"), "Find an action", "help.palette");
  row(icon_named("help"), "Keys and gestures", "help.keys");
}

void draw_recent(const Preferences& preferences, Thumbnails& thumbnails, PanelAnswer& answer) {
  std::vector<Path> files;
  for (const Path& file : preferences.recent)
    if (files.size() < kMostLarge && path_exists(file)) files.push_back(file);
  if (files.empty()) return;
  heading("Recent");
  const float gap = px(16);
  const Columns columns = columns_of(ImGui::GetContentRegionAvail().x, px(220), gap, 4);
  for (size_t i = 0; i < std::min(files.size(), 2 * columns.count); ++i) {
    if (i % columns.count > 0) ImGui::SameLine(0, gap);
    ImGui::PushID(static_cast<int>(i));
    const Tile tile{"recent", files[i].stem().string(), files[i].parent_path().string(),
                    thumbnails.of_file(files[i])};
    const ImVec2 size(columns.width, std::floor(0.7f * columns.width));
    if (draw_tile(tile, size).first) answer.open = files[i];
    ImGui::PopID();
  }
  ImGui::Dummy({0, px(16)});
}

void draw_samples(Samples& samples, Workspace& workspace, PanelAnswer& answer) {
  heading("Samples");
  const float gap = px(16);
  const std::vector<Sample>& all = samples.shown();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  // The largest tiles of which all rows fit into the window. They may be flatter than usual.
  constexpr float kUsual = 0.8f, kFlattest = 0.62f;  // height, relative to the width
  Columns columns;
  ImVec2 size;
  for (size_t count = 3; count <= 6; ++count) {
    columns = {count, std::floor((room.x + gap) / static_cast<float>(count)) - gap};
    const auto rows = static_cast<float>((all.size() + count) / count);
    const float fits = std::floor(room.y / rows) - px(60);
    size = {columns.width,
            std::floor(std::clamp(fits, kFlattest * columns.width, kUsual * columns.width))};
    if (columns.width < px(176) || fits >= kFlattest * columns.width) break;
  }
  std::optional<size_t> hovered;
  for (size_t i = 0; i < all.size(); ++i) {
    if (i % columns.count > 0) ImGui::SameLine(0, gap);
    ImGui::PushID(static_cast<int>(1000 + i));
    const Tile tile{"sample", all[i].title, all[i].line, samples.picture(i), samples.progress(i)};
    const auto [clicked, over] = draw_tile(tile, size);
    if (clicked) answer.sample = all[i].scene;
    if (over) hovered = i;
    tooltip(all[i].text);
    ImGui::PopID();
  }
  samples.play(hovered);
  if (all.size() % columns.count > 0) ImGui::SameLine(0, gap);
  const ThemeColors& c = theme_colors();
  const bool own = ImGui::InvisibleButton("Your picture", size);
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::IsItemHovered() ? c.text : c.muted;
  list.AddRect(from, to, faded(ImGui::IsItemHovered() ? c.accent : c.edge), px(8));
  draw_icon(list, icon_named("add"), (from + to) * 0.5f - ImVec2(0, px(12)), ink);
  draw_centered_text(list, Type::body, from + ImVec2(0, px(28)), to, ink, "Your picture");
  draw_focus_ring(px(8));
  name_item("Your picture");
  if (own) run("file.open", workspace);
}

}  // namespace

PanelAnswer draw_welcome(Workspace& workspace, const Preferences& preferences, Samples& samples,
                         const std::vector<Recovery>& recoverable, Thumbnails& thumbnails,
                         const PanelSizes& sizes) {
  PanelAnswer answer;
  const ThemeColors& c = theme_colors();
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float top = static_cast<float>(sizes.menu),
              bottom = display.y - static_cast<float>(sizes.status);
  const float column = std::min(px(304), std::floor(0.4f * display.x));
  // One window, so that the keyboard reaches everything in it.
  begin_panel("Welcome", {0, top}, {display.x, bottom}, c.chrome, {0, 0},
              ImGuiWindowFlags_NoScrollbar);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({0, top}, {column, bottom}, faded(c.panel));
  list.AddLine({column, top}, {column, bottom}, faded(c.line));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(32), px(24)});
  ImGui::BeginChild("actions", {column, 0}, false,
                    ImGuiWindowFlags_NavFlattened | ImGuiWindowFlags_AlwaysUseWindowPadding);
  draw_actions(workspace, recoverable, answer);
  ImGui::EndChild();
  ImGui::SameLine(0, 0);
  ImGui::BeginChild("files", {0, 0}, false,
                    ImGuiWindowFlags_NavFlattened | ImGuiWindowFlags_AlwaysUseWindowPadding);
  draw_recent(preferences, thumbnails, answer);
  draw_samples(samples, workspace, answer);
  ImGui::EndChild();
  ImGui::PopStyleVar();
  end_panel();
  return answer;
}

}  // namespace holomorph
