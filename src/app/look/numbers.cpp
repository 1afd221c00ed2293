// ImGui's drag field keeps its behavior, but its text is drawn here, because ImGui centers it.
#include "app/look/numbers.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cstdio>

#include "app/look/controls.h"
#include "app/look/imgui_versions.h"
#include "edit/actions/icons.h"

namespace holomorph {
namespace {

std::string text_of(double value, const Number& number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", number.decimals, value);
  if (std::string_view(text) == "-0") return "0";
  return text;
}

double fraction_of(double value, const Number& number) {
  if (number.logarithmic && number.low > 0)
    return std::log(std::clamp(value, number.low, number.high) / number.low) /
           std::log(number.high / number.low);
  return std::clamp((value - number.low) / (number.high - number.low), 0.0, 1.0);
}

double value_at(double fraction, const Number& number) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  if (number.logarithmic && number.low > 0)
    return number.low * std::pow(number.high / number.low, fraction);
  return number.low + fraction * (number.high - number.low);
}

Change change_of_item(bool changed) {
  return {changed, ImGui::IsItemDeactivatedAfterEdit()};
}

void merge(Change& all, const Change& more) {
  all.changed = all.changed || more.changed;
  all.ended = all.ended || more.ended;
}

/// The track with its knob.
Change track(const std::string& name, double& value, const Number& number, float width) {
  ImGuiWindow* window = ImGui::GetCurrentWindow();
  if (window->SkipItems) return {};
  const ThemeColors& c = theme_colors();
  const ImVec2 at = window->DC.CursorPos;
  const ImRect box(at, at + ImVec2(width, px(28)));
  const ImGuiID id = window->GetID((name + "##track").c_str());
  ImGui::ItemSize(box.GetSize(), 0);
  if (!ImGui::ItemAdd(box, id)) return {};
  ImGuiContext& imgui = *ImGui::GetCurrentContext();
  const bool hovered = is_hoverable(box, id);
  if ((hovered && imgui.IO.MouseClicked[0]) || is_activated(imgui, id)) {
    ImGui::SetActiveID(id, window);
    ImGui::SetFocusID(id, window);
    ImGui::FocusWindow(window);
    imgui.ActiveIdUsingNavDirMask |= (1 << ImGuiDir_Left) | (1 << ImGuiDir_Right);
  }
  const float knob = px(14), from = box.Min.x + knob / 2, to = box.Max.x - knob / 2;
  ImRect grab;
  // ImGui's slider works on the fraction, so that logarithmic scales need no care.
  double fraction = fraction_of(value, number);
  constexpr double kLow = 0, kHigh = 1;
  const bool moved = ImGui::SliderBehavior(box, id, ImGuiDataType_Double, &fraction, &kLow, &kHigh,
                                           "%.9f", ImGuiSliderFlags_NoRoundToFormat, &grab);
  if (moved) {
    const double scale = std::pow(10.0, number.decimals),
                 next = std::round(value_at(fraction, number) * scale) / scale;
    value = std::clamp(next, number.low, number.high);
    ImGui::MarkItemEdited(id);
  }
  const float y = box.GetCenter().y, x = from + static_cast<float>(fraction) * (to - from);
  ImDrawList& list = *window->DrawList;
  const float thick = px(2);
  list.AddRectFilled({box.Min.x, y - thick}, {box.Max.x, y + thick},
                     faded(has_high_contrast() ? c.faint : c.edge), thick);
  list.AddRectFilled({box.Min.x, y - thick}, {x, y + thick}, faded(c.accent_fill), thick);
  if (hovered || imgui.ActiveId == id) list.AddCircleFilled({x, y}, px(12), faded(c.accent, 0.25f));
  list.AddCircleFilled({x, y + 1}, knob / 2 + 0.5f, faded(IM_COL32(0, 0, 0, 70)), 24);
  list.AddCircleFilled({x, y}, knob / 2, faded(IM_COL32_WHITE), 24);
  draw_focus_ring(px(4));
  return change_of_item(moved);
}

/// The range of a number, up to a value beyond it that may be typed.
std::pair<double, double> range_of(const Number& number, double value) {
  if (number.typed == 0) return {number.low, number.high};
  const double far = std::min(std::abs(value), number.typed);
  return {std::min(number.low, -far), std::max(number.high, far)};
}

/// The label of a row as something that drags the number.
Change dragged_label(const std::string& label, double& value, const Number& number,
                     const std::string& hint) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushItemFlag(ImGuiItemFlags_NoNav, true);
  ImGui::InvisibleButton((label + "##label").c_str(), {label_width(), px(28)});
  ImGui::PopItemFlag();
  draw_text(*ImGui::GetWindowDrawList(), Type::body,
            {at.x, at.y + (px(28) - font(Type::body)->FontSize) / 2}, theme_colors().muted,
            shortened_text(label, label_width()));
  tooltip(hint);
  if (ImGui::IsItemHovered() || ImGui::IsItemActive())
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  bool changed = false;
  if (number.neutral && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
    changed = value != *number.neutral;
    value = *number.neutral;
  } else if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0) {
    const double step = ImGui::GetIO().MouseDelta.x, before = value;
    const double range = number.high - number.low;
    if (number.speed > 0 || !std::isfinite(range))
      value += step * std::max(number.speed, 1e-9);
    else if (value < number.low || value > number.high)
      value += step * range / 200;
    else
      value = value_at(fraction_of(value, number) + step / 200, number);
    const auto [low, high] = range_of(number, before);
    value = std::clamp(value, low, high);
    changed = true;
  }
  if (changed) ImGui::MarkItemEdited(ImGui::GetItemID());
  return change_of_item(changed);
}

}  // namespace

Change number_field(const std::string& name, double& value, const Number& number, float width,
                    const std::string& prefix) {
  const TabStop stop;
  ImGui::SetNextItemWidth(width);
  const ImGuiID id = ImGui::GetID(name.c_str());
  const bool types = ImGui::TempInputIsActive(id);
  const bool bounded = std::isfinite(number.high - number.low);
  const double speed = number.speed > 0 ? number.speed
                       : bounded        ? (number.high - number.low) / 300
                                        : std::pow(10.0, -number.decimals);
  const auto [low, high] = range_of(number, types ? number.typed : value);
  char format[16];
  std::snprintf(format, sizeof format, "%%.%df", number.decimals);
  ImGui::PushStyleColor(ImGuiCol_Text, types ? color_of(theme_colors().text) : ImVec4(0, 0, 0, 0));
  ImGui::PushStyleColor(ImGuiCol_Border,
                        color_of(types ? theme_colors().accent : theme_colors().edge));
  const bool changed = ImGui::DragScalar(
      name.c_str(), ImGuiDataType_Double, &value, static_cast<float>(speed),
      bounded ? &low : nullptr, bounded ? &high : nullptr, format,
      ImGuiSliderFlags_NoRoundToFormat |
          (bounded ? ImGuiSliderFlags_AlwaysClamp : ImGuiSliderFlags_None) |
          (number.logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None));
  ImGui::PopStyleColor(2);
  const Change change = change_of_item(changed);
  name_item(name.starts_with("##") ? name.substr(2) : name);
  if (!types) {
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float y = (from.y + to.y - font(Type::body)->FontSize) / 2;
    float x = from.x + px(8);
    list.PushClipRect(from, to, true);
    if (!prefix.empty()) {
      draw_text(list, Type::body, {x, y}, theme_colors().muted, prefix);
      x += text_size(Type::body, prefix).x + px(8);
    }
    const std::string text = text_of(value, number);
    draw_text(list, Type::body, {x, y}, theme_colors().text, text);
    const float unit = text_size(Type::body, number.unit).x,
                end = x + text_size(Type::body, text).x + px(3);
    if (*number.unit && end + unit < to.x - px(2))
      draw_text(list, Type::body, {std::max(end, to.x - px(8) - unit), y}, theme_colors().muted,
                number.unit);
    list.PopClipRect();
  }
  draw_focus_ring(px(4));
  if (std::isfinite(value)) return change;
  value = 0;
  return {};
}

Change slider(const std::string& name, double& value, const Number& number, float width) {
  const float field = px(64), gap = px(8);
  Change all = track(name, value, number, width - field - gap);
  ImGui::SameLine(0, gap);
  merge(all, number_field(name, value, number, field));
  return all;
}

Change slider_row(const std::string& label, double& value, const Number& number,
                  const std::string& hint) {
  Change all = dragged_label(label, value, number, hint);
  ImGui::SameLine(0, px(8));
  ImGui::BeginGroup();
  merge(all, slider("##" + label, value, number, ImGui::GetContentRegionAvail().x));
  ImGui::EndGroup();
  tooltip(hint);
  name_item(label);
  return all;
}

Change number_row(const std::string& label, double& value, const Number& number,
                  const std::string& hint) {
  Change all = dragged_label(label, value, number, hint);
  ImGui::SameLine(0, px(8));
  merge(all, number_field("##" + label, value, number, ImGui::GetContentRegionAvail().x));
  tooltip(hint);
  name_item(label);
  return all;
}

Change stepper(const std::string& name, double& value, const Number& number, float width) {
  const ThemeColors& c = theme_colors();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = px(28), side = px(28);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, at + ImVec2(width, height), faded(c.field), px(4));
  list.AddRect(at, at + ImVec2(width, height), faded(c.edge), px(4));
  ImGui::PushID(name.c_str());
  Change change;
  const auto step = [&](const char* icon, double by) {
    if (icon_button(by < 0 ? "less" : "more", icon, "", false, side, Type::caption)) {
      value = std::clamp(value + by, number.low, number.high);
      change = {true, true};
    }
  };
  step(icon_named("minus"), -1);
  ImGui::SameLine(0, 0);
  const std::string text = text_of(value, number);
  draw_centered_text(list, Type::body, at + ImVec2(side, 0), at + ImVec2(width - side, height),
                     c.text, text);
  ImGui::Dummy({width - 2 * side, height});
  ImGui::SameLine(0, 0);
  step(icon_named("add"), 1);
  ImGui::PopID();
  return change;
}

}  // namespace holomorph
