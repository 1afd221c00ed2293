// Sizes and small parts that several panels share.
#include "app/panels/panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/look/controls.h"
#include "edit/actions/icons.h"

namespace holomorph {

PanelSizes PanelSizes::now() {
  const double width = ImGui::GetIO().DisplaySize.x;
  PanelSizes sizes{};
  sizes.menu = px(36);
  sizes.toolbar = px(48);
  sizes.options = px(44);
  sizes.inspector = std::min<double>(px(304), std::floor(0.4 * width));
  sizes.status = px(28);
  sizes.two_rows = width - sizes.toolbar - sizes.inspector < px(860);
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

void draw_checkerboard(ImDrawList& list, ImVec2 from, ImVec2 to, float cell) {
  const ThemeColors& c = theme_colors();
  list.AddRectFilled(from, to, faded(c.page_a));
  list.PushClipRect(from, to, true);
  int row = 0;
  for (float y = from.y; y < to.y; y += cell, ++row)
    for (float x = from.x + (row % 2 == 0 ? cell : 0); x < to.x; x += 2 * cell)
      list.AddRectFilled({x, y}, {x + cell, y + cell}, faded(c.page_b));
  list.PopClipRect();
}

void draw_thumbnail(ImDrawList& list, const Texture* texture, ImVec2 at, float side,
                    float rounding) {
  const ImVec2 to(at.x + side, at.y + side);
  draw_checkerboard(list, at, to, px(4));
  if (texture && texture->id()) {
    const float w = static_cast<float>(texture->width()), h = static_cast<float>(texture->height()),
                fit = (side - px(4)) / std::max(w, h);
    const ImVec2 corner(at.x + (side - w * fit) / 2, at.y + (side - h * fit) / 2);
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture->id())), corner,
                  {corner.x + w * fit, corner.y + h * fit}, {0, 0}, {1, 1}, faded(IM_COL32_WHITE));
  }
  list.AddRect({at.x - 1, at.y - 1}, {to.x + 1, to.y + 1}, faded(theme_colors().line), rounding);
}

bool recent_row(int number, const Path& file, Thumbnails& thumbnails) {
  const float side = px(36), height = px(44);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const std::string name = file.filename().string(), folder = file.parent_path().string();
  const float width = std::max({ImGui::GetContentRegionAvail().x, px(300)});
  ImGui::PushID(number);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, px(2)});
  const bool chosen = ImGui::Selectable("##recent", false, 0, {width, height});
  ImGui::PopStyleVar();
  ImGui::PopID();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_thumbnail(list, thumbnails.of_file(file), {at.x + px(4), at.y + (height - side) / 2}, side,
                 px(4));
  const float x = at.x + side + px(16), room = width - side - px(20);
  list.PushClipRect(at, {at.x + width, at.y + height}, true);
  draw_text(list, Type::body, {x, at.y + px(5)}, theme_colors().text, shortened_text(name, room));
  draw_text(list, Type::caption, {x, at.y + px(23)}, theme_colors().muted,
            shortened_text(folder, room));
  list.PopClipRect();
  name_item(name);
  return chosen;
}

}  // namespace holomorph
