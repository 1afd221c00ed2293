// Each control is an ImGui item with a drawing of its own, so that keys and focus work as usual.
#include "app/look/controls.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>
// Must follow imgui.h, because it does not include that header itself.

#include <algorithm>
#include <cmath>

#include "app/look/imgui_versions.h"
#include "edit/actions/icons.h"
#include "edit/workspace.h"

namespace holomorph {
namespace {

float label_column = 0;  ///< 0: the usual width

/// An item that can be pressed, without a drawing.
struct Pressed {
  ImRect box;
  bool pressed = false, hovered = false, held = false;
};
Pressed press(const std::string& name, ImVec2 size) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  Pressed result;
  result.box = {at, at + size};
  result.pressed = ImGui::InvisibleButton(name.c_str(), size);
  result.hovered = ImGui::IsItemHovered();
  result.held = ImGui::IsItemActive();
  return result;
}

/// The name of an item: the part of a label after its icon, and before "##"; or a label that is not
/// displayed, without its "##".
std::string plain_name(const std::string& label) {
  if (label.starts_with("##")) return label.substr(2);
  std::string name = label.substr(0, label.find("##"));
  if (name.size() > 3 && static_cast<unsigned char>(name[0]) == 0xee)
    name.erase(0, name.find_first_not_of(' ', 3));
  return name;
}

bool draw_button(const std::string& label, ButtonKind kind, float width, float height,
                 float rounding) {
  const ThemeColors& c = theme_colors();
  const std::string text = label.substr(0, label.find("##"));
  const ImVec2 size = text_size(Type::strong, text);
  if (width < 0) width = ImGui::GetContentRegionAvail().x;
  if (width == 0) width = std::ceil(size.x) + (height < px(32) ? px(20) : px(28));
  const Pressed item = press(label, {width, height});
  ImU32 fill = c.raised, color = c.text;
  const float depth = item.held && item.hovered ? 0.16f : item.hovered ? 0.08f : 0;
  const auto darker = [&](ImU32 base) { return blended(base, IM_COL32_BLACK, depth); };
  const ImU32 surface = item.held && item.hovered ? c.pressed : item.hovered ? c.hover : c.raised;
  switch (kind) {
    case ButtonKind::primary:
      fill = darker(c.accent_fill);
      color = c.on_accent;
      break;
    case ButtonKind::danger:
      fill = darker(c.error_fill);
      color = c.on_accent;
      break;
    case ButtonKind::secondary:
      fill = surface;
      break;
    case ButtonKind::flat:
    case ButtonKind::flat_danger:
      fill = item.hovered || item.held ? surface : 0;
      color = kind == ButtonKind::flat ? c.text : c.error;
      break;
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (fill) list.AddRectFilled(item.box.Min, item.box.Max, faded(fill), rounding);
  if (kind == ButtonKind::secondary && (is_light() || has_high_contrast()))
    list.AddRect(item.box.Min, item.box.Max, faded(c.edge), rounding);
  draw_centered_text(list, Type::strong, item.box.Min, item.box.Max, color, text);
  draw_focus_ring(rounding);
  name_item(plain_name(label));
  return item.pressed;
}

}  // namespace

float label_width() {
  return label_column > 0 ? label_column : px(80);
}

ScopedLabelWidth::ScopedLabelWidth(float width) : before_(label_column) {
  label_column = width;
}
ScopedLabelWidth::~ScopedLabelWidth() {
  label_column = before_;
}

void row_label(const std::string& label, const std::string& hint) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_text(*ImGui::GetWindowDrawList(), Type::body,
            {at.x, at.y + (px(28) - font(Type::body)->FontSize) / 2}, theme_colors().muted,
            shortened_text(label, label_width()));
  ImGui::Dummy({label_width(), px(28)});
  tooltip(hint);
  ImGui::SameLine(0, px(8));
}

bool toggle_switch(const std::string& name, bool on) {
  const ThemeColors& c = theme_colors();
  const Pressed item = press(name, {px(32), px(28)});
  const float t = eased(ImGui::GetItemID(), on), r = px(9), y = item.box.GetCenter().y;
  const ImVec2 from(item.box.Min.x, y - r), to(item.box.Max.x, y + r);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(from, to, faded(blended(is_light() ? c.control : c.pressed, c.accent_fill, t)),
                     r);
  if (has_high_contrast()) list.AddRect(from, to, faded(c.edge), r);
  const float x = from.x + r + t * (to.x - from.x - 2 * r);
  list.AddCircleFilled({x, y}, px(7), faded(IM_COL32_WHITE), 24);
  draw_focus_ring(r);
  name_item(plain_name(name));
  return item.pressed;
}

bool switch_row(const std::string& label, bool on, const std::string& hint) {
  row_label(label, hint);
  const bool toggled = toggle_switch(label, on);
  tooltip(hint);
  return toggled;
}

bool check_box(const std::string& label, bool& on) {
  const ThemeColors& c = theme_colors();
  const float side = px(18), height = px(28), gap = px(8);
  const Pressed item =
      press(label, {side + gap + text_size(Type::body, plain_name(label)).x, height});
  if (item.pressed) on = !on;
  const ImVec2 from(item.box.Min.x, item.box.GetCenter().y - side / 2),
      to = from + ImVec2(side, side);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 edge = on ? c.accent_fill : item.hovered ? c.accent : c.control;
  list.AddRectFilled(from, to, faded(on ? c.accent_fill : c.field), px(4));
  list.AddRect(from, to, faded(edge), px(4), 0, 1.5f);
  if (on) draw_icon(list, icon_named("check"), (from + to) * 0.5f, c.on_accent, Type::caption);
  draw_text(list, Type::body, {to.x + gap, item.box.GetCenter().y - font(Type::body)->FontSize / 2},
            c.text, plain_name(label));
  draw_focus_ring(px(4));
  name_item(plain_name(label));
  return item.pressed;
}

std::optional<size_t> segmented(const std::string& name, const std::vector<std::string>& options,
                                std::optional<size_t> chosen, float width) {
  const ThemeColors& c = theme_colors();
  float widest = 0;
  for (const std::string& option : options)
    widest = std::max(widest, text_size(Type::strong, option).x);
  const float pad = px(2), count = static_cast<float>(options.size());
  if (width <= 0) width = count * (std::ceil(widest) + px(24)) + 2 * pad;
  const float each = (width - 2 * pad) / count, height = px(28);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, at + ImVec2(width, height), faded(c.field), px(6));
  list.AddRect(at, at + ImVec2(width, height), faded(c.edge), px(6));
  std::optional<size_t> clicked;
  ImGui::BeginGroup();
  ImGui::PushID(name.c_str());
  for (size_t i = 0; i < options.size(); ++i) {
    if (i > 0) ImGui::SameLine(0, 0);
    ImGui::SetCursorScreenPos({std::round(at.x + pad + each * static_cast<float>(i)), at.y});
    const Pressed item = press(options[i], {std::floor(each), height});
    if (item.pressed) clicked = i;
    const bool on = chosen == i;
    const ImVec2 from = item.box.Min + ImVec2(0, pad + 1), to = item.box.Max - ImVec2(0, pad + 1);
    if (on || item.hovered)
      list.AddRectFilled(from, to,
                         faded(!on                   ? c.hover
                               : has_high_contrast() ? c.accent_fill
                               : is_light()          ? c.accent_tint
                                                     : c.pressed),
                         px(4));
    const ImU32 color = !on                   ? c.muted
                        : has_high_contrast() ? c.on_accent
                        : is_light()          ? c.accent
                                              : c.text;
    draw_centered_text(list, on ? Type::strong : Type::body, item.box.Min, item.box.Max, color,
                       options[i]);
    draw_focus_ring(px(4));
    name_item(plain_name(name) + ": " + options[i]);
  }
  ImGui::PopID();
  ImGui::EndGroup();
  return clicked;
}

bool begin_dropdown(const std::string& name, const std::string& preview, float width) {
  const ThemeColors& c = theme_colors();
  if (width <= 0) width = ImGui::GetContentRegionAvail().x;
  ImGui::SetNextItemWidth(width);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(4), px(4)});
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool open = ImGui::BeginCombo(
      name.c_str(), "", ImGuiComboFlags_HeightLargest | ImGuiComboFlags_NoArrowButton);
  ImGui::PopStyleVar();
  const bool hovered = ImGui::IsMouseHoveringRect(at, at + ImVec2(width, height));
  const float y = at.y + (height - font(Type::body)->FontSize) / 2;
  list.PushClipRect(at, at + ImVec2(width - px(24), height), true);
  draw_text(list, Type::body, {at.x + px(8), y}, c.text, preview);
  list.PopClipRect();
  draw_icon(list, icon_named("down"), {at.x + width - px(14), at.y + height / 2},
            hovered ? c.text : c.muted, Type::caption);
  if (!open) {
    draw_focus_ring(px(4));
    name_item(plain_name(name));
    return false;
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), 0});
  const ImVec2 from = ImGui::GetWindowPos(), to = from + ImGui::GetWindowSize();
  draw_shadow(*ImGui::GetWindowDrawList(), from, to, px(12), 0.32f);
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  return true;
}

bool dropdown_row(const std::string& label, bool chosen, bool enabled) {
  const ThemeColors& c = theme_colors();
  ImGui::BeginDisabled(!enabled);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = px(28),
              width = std::max(ImGui::GetContentRegionAvail().x,
                               text_size(Type::body, plain_name(label)).x + px(40));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  const bool clicked = ImGui::Selectable(("##" + label).c_str(), false, 0, {width, height});
  ImGui::PopStyleVar();
  if (chosen) ImGui::SetItemDefaultFocus();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = at.y + height / 2;
  if (chosen)
    draw_icon(list, icon_named("check"), {at.x + px(14), middle}, c.accent, Type::caption);
  draw_text(list, Type::body, {at.x + px(28), middle - font(Type::body)->FontSize / 2}, c.text,
            plain_name(label));
  name_item(plain_name(label));
  ImGui::EndDisabled();
  return clicked;
}

void end_dropdown() {
  ImGui::PopStyleVar();
  ImGui::EndCombo();
}

bool button(const std::string& label, ButtonKind kind, float width) {
  return draw_button(label, kind, width, px(32), px(6));
}
bool small_button(const std::string& label, ButtonKind kind) {
  return draw_button(label, kind, 0, px(24), px(4));
}

bool icon_button(const std::string& name, const char* icon, const std::string& tip, bool on,
                 float size, Type icon_size) {
  const ThemeColors& c = theme_colors();
  if (size <= 0) size = px(28);
  const Pressed item = press(name, {size, size});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 fill = item.held && item.hovered ? c.pressed
                     : item.hovered            ? c.hover
                     : on                      ? c.accent_tint
                                               : 0;
  if (fill) list.AddRectFilled(item.box.Min, item.box.Max, faded(fill), px(6));
  draw_icon(list, icon, item.box.GetCenter(),
            on             ? c.accent
            : item.hovered ? c.text
                           : c.muted,
            icon_size);
  draw_focus_ring(px(6));
  name_item(plain_name(name));
  tooltip(tip);
  return item.pressed;
}

void action_icon_button(const std::string& id, Workspace& workspace) {
  const Action& action = workspace.actions.named(id);
  ImGui::BeginDisabled(!action.enabled(workspace));
  const bool pressed =
      icon_button(id, action.icon, "", action.checked && action.checked(workspace));
  tooltip_of(action);
  ImGui::EndDisabled();
  if (pressed) run(id, workspace);
}

bool begin_section(const std::string& title, const std::string& state, ImU32 state_color,
                   bool& open) {
  const ThemeColors& c = theme_colors();
  const float pad = ImGui::GetStyle().WindowPadding.x, height = px(36);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  allow_overlap_of_next_item();  // sections may put a button into the title
  const Pressed item = press(title + "##section", {width, height});
  allow_overlap_of_last_item();
  const std::string shown = plain_name(title);
  if (item.pressed) open = !open;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  // The line extends into the padding, but not above or below the panel.
  if (at.y >= list.GetClipRectMin().y && at.y < list.GetClipRectMax().y) {
    list.PushClipRect({at.x - pad, at.y - 1}, {at.x + width + pad, at.y + height}, false);
    list.AddLine({at.x - pad, at.y}, {at.x + width + pad, at.y}, faded(c.line));
    list.PopClipRect();
  }
  const float middle = at.y + height / 2;
  draw_text(list, Type::strong, {at.x, middle - font(Type::strong)->FontSize / 2}, c.text, shown);
  draw_icon(list, open ? icon_named("down") : icon_named("right"), {at.x + width - px(8), middle},
            item.hovered ? c.text : c.muted, Type::caption);
  if (!state.empty()) {
    const float room = width - px(32) - text_size(Type::strong, shown).x;
    const std::string text = fitted_text(state, room);
    draw_text(list, Type::body,
              {at.x + width - px(22) - text_size(Type::body, text).x,
               middle - font(Type::body)->FontSize / 2},
              state_color, text);
  }
  draw_focus_ring(px(4));
  const size_t id = title.find("###");
  name_item("section " + (id == std::string::npos ? title : title.substr(id + 3)));
  return open;
}

bool text_field(const std::string& name, std::string& text, const char* hint, float width,
                ImGuiInputTextFlags flags) {
  const TabStop stop;
  ImGui::SetNextItemWidth(width);
  const bool entered = ImGui::InputTextWithHint(name.c_str(), hint, &text,
                                                flags | ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemActive()) {
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddRect(from, to, faded(theme_colors().accent), px(4), 0, 1.5f);
  }
  name_item(plain_name(name));
  return entered;
}

bool color_field(const std::string& name, std::array<std::uint8_t, 3>& color, float width) {
  const TabStop stop;
  float values[3];
  for (size_t k = 0; k < 3; ++k) values[k] = static_cast<float>(color[k]) / 255;
  ImGui::SetNextItemWidth(width);
  if (!ImGui::ColorEdit3(name.c_str(), values, ImGuiColorEditFlags_DisplayHex)) return false;
  for (size_t k = 0; k < 3; ++k)
    color[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(values[k], 0.0f, 1.0f)));
  return true;
}

void bar_separator(float height) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float tall = px(20), x = std::round(at.x + px(12)),
              y = std::round(at.y + (height - tall) / 2);
  ImGui::GetWindowDrawList()->AddLine({x, y}, {x, y + tall}, faded(theme_colors().line));
  ImGui::Dummy({px(25), height});
}

}  // namespace holomorph
