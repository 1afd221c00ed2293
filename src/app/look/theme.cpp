// Neutral panels with one accent color. The picture should be the most colorful thing in the
// window.
#include "app/look/theme.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

#include "app/look/fonts.h"

namespace holomorph {
namespace {

constexpr double kFade = 0.15;  ///< duration of changes, seconds

constexpr ImU32 rgb(unsigned hex, unsigned alpha = 255) {
  return IM_COL32(hex >> 16 & 255, hex >> 8 & 255, hex & 255, alpha);
}

ThemeColors colors_of(Theme theme) {
  if (theme == Theme::contrast)
    return {.canvas = rgb(0x000000),
            .chrome = rgb(0x000000),
            .panel = rgb(0x000000),
            .field = rgb(0x000000),
            .raised = rgb(0x000000),
            .hover = rgb(0x1f2a33),
            .pressed = rgb(0x003a52),
            .line = rgb(0xffffff),
            .edge = rgb(0xffffff),
            .control = rgb(0xffffff),
            .text = rgb(0xffffff),
            .muted = rgb(0xd8d8d8),
            .faint = rgb(0x9a9a9a),
            .accent = rgb(0x4de1ff),
            .accent_fill = rgb(0x4de1ff),
            .on_accent = rgb(0x000000),
            .accent_tint = rgb(0x003a52),
            .warning = rgb(0xffd23f),
            .error = rgb(0xff9d94),
            .error_fill = rgb(0xff9d94),
            .success = rgb(0x7cffb2),
            .page_a = rgb(0x202020),
            .page_b = rgb(0x2c2c2c)};
  if (theme == Theme::light)
    return {.canvas = rgb(0xd3d5da),
            .chrome = rgb(0xe6e7ea),
            .panel = rgb(0xf6f6f8),
            .field = rgb(0xffffff),
            .raised = rgb(0xffffff),
            .hover = rgb(0xe4e6eb),
            .pressed = rgb(0xd6d9e0),
            .line = rgb(0xdddfe4),
            .edge = rgb(0xc5c8d0),
            .control = rgb(0x7a7e88),
            .text = rgb(0x1b1c20),
            .muted = rgb(0x565a64),
            .faint = rgb(0x9a9da6),
            .accent = rgb(0x1f5bcc),
            .accent_fill = rgb(0x2a66db),
            .on_accent = rgb(0xffffff),
            .accent_tint = rgb(0xdce7fc),
            .warning = rgb(0x8a5a00),
            .error = rgb(0xb3261e),
            .error_fill = rgb(0xc4302b),
            .success = rgb(0x11713f),
            .page_a = rgb(0xffffff),
            .page_b = rgb(0xeeeff2)};
  return {.canvas = rgb(0x17181b),
          .chrome = rgb(0x1e1f23),
          .panel = rgb(0x25262a),
          .field = rgb(0x1b1c1f),
          .raised = rgb(0x34363c),
          .hover = rgb(0x3d4047),
          .pressed = rgb(0x484b53),
          .line = rgb(0x34363b),
          .edge = rgb(0x474a52),
          .control = rgb(0x858993),
          .text = rgb(0xecedef),
          .muted = rgb(0xa8abb3),
          .faint = rgb(0x6d7079),
          .accent = rgb(0x7faeff),
          .accent_fill = rgb(0x396fdd),
          .on_accent = rgb(0xffffff),
          .accent_tint = rgb(0x2a3a59),
          .warning = rgb(0xf5b64c),
          .error = rgb(0xff8a80),
          .error_fill = rgb(0xc93a35),
          .success = rgb(0x5fd39a),
          .page_a = rgb(0x3a3c41),
          .page_b = rgb(0x404247)};
}

/// The state of the interface's look. Like ImGui's style, there is one for the whole program.
struct State {
  double scale = 0;  ///< 0: no style has been applied yet
  Theme theme = Theme::dark;
  bool reduce_motion = false, moves = false;
  ThemeColors colors = colors_of(Theme::dark), from = colors, to = colors;
  double changed_at = -1;  ///< start of the change of the colors in ImGui's time; -1: none
  struct Seen {
    int frame = 0;
    double since = 0;
  };
  std::map<ImGuiID, Seen> seen;
  std::map<ImGuiID, float> eased;
};

State& state() {
  static State the_state;
  return the_state;
}

ThemeColors blended(const ThemeColors& from, const ThemeColors& to, float t) {
  using List = std::array<ImU32, sizeof(ThemeColors) / sizeof(ImU32)>;
  const List a = std::bit_cast<List>(from), b = std::bit_cast<List>(to);
  List mixed;
  for (size_t i = 0; i < mixed.size(); ++i) mixed[i] = holomorph::blended(a[i], b[i], t);
  return std::bit_cast<ThemeColors>(mixed);
}

void set_imgui_colors() {
  const ThemeColors& c = state().colors;
  const auto set = [](ImGuiCol slot, ImU32 color) {
    ImGui::GetStyle().Colors[slot] = color_of(color);
  };
  set(ImGuiCol_Text, c.text);
  set(ImGuiCol_TextDisabled, c.muted);
  set(ImGuiCol_WindowBg, c.panel);
  set(ImGuiCol_ChildBg, 0);
  set(ImGuiCol_PopupBg, c.raised);
  set(ImGuiCol_MenuBarBg, c.chrome);
  set(ImGuiCol_Border, c.edge);
  set(ImGuiCol_BorderShadow, 0);
  set(ImGuiCol_FrameBg, c.field);
  set(ImGuiCol_FrameBgHovered, c.field);
  set(ImGuiCol_FrameBgActive, c.field);
  set(ImGuiCol_TitleBg, c.panel);
  set(ImGuiCol_TitleBgActive, c.panel);
  set(ImGuiCol_TitleBgCollapsed, c.panel);
  set(ImGuiCol_ScrollbarBg, 0);
  set(ImGuiCol_ScrollbarGrab, c.edge);
  set(ImGuiCol_ScrollbarGrabHovered, c.control);
  set(ImGuiCol_ScrollbarGrabActive, c.control);
  set(ImGuiCol_CheckMark, c.accent);
  set(ImGuiCol_SliderGrab, c.accent_fill);
  set(ImGuiCol_SliderGrabActive, c.accent_fill);
  set(ImGuiCol_Button, c.raised);
  set(ImGuiCol_ButtonHovered, c.hover);
  set(ImGuiCol_ButtonActive, c.pressed);
  set(ImGuiCol_Header, c.accent_tint);
  set(ImGuiCol_HeaderHovered, c.hover);
  set(ImGuiCol_HeaderActive, c.pressed);
  set(ImGuiCol_Separator, c.line);
  set(ImGuiCol_PlotLines, c.accent);
  set(ImGuiCol_PlotHistogram, c.accent_fill);
  set(ImGuiCol_TableHeaderBg, c.panel);
  set(ImGuiCol_TableBorderLight, c.line);
  set(ImGuiCol_TableBorderStrong, c.line);
  set(ImGuiCol_TableRowBg, 0);
  set(ImGuiCol_TableRowBgAlt, faded(c.hover, 0.25f));
  set(ImGuiCol_TextSelectedBg, faded(c.accent_fill, 0.5f));
  set(ImGuiCol_NavHighlight, c.accent);
  set(ImGuiCol_ModalWindowDimBg, IM_COL32(0, 0, 0, 128));
  set(ImGuiCol_NavWindowingDimBg, 0);
}

void set_imgui_sizes() {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  style.WindowRounding = 0;
  style.ChildRounding = px(6);
  style.FrameRounding = px(4);
  style.PopupRounding = px(8);
  style.GrabRounding = px(4);
  style.ScrollbarRounding = px(4);
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 1;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 1;
  style.FramePadding = {px(8), px(6)};
  style.ItemSpacing = {px(8), px(8)};
  style.ItemInnerSpacing = {px(8), px(4)};
  style.WindowPadding = {px(16), px(12)};
  style.CellPadding = {px(8), px(4)};
  style.IndentSpacing = px(16);
  style.ScrollbarSize = px(10);
  style.GrabMinSize = px(14);
  style.WindowMinSize = {1, 1};
  style.DisabledAlpha = 0.4f;
  style.CircleTessellationMaxError = 0.2f;
}

/// Fast at first, then slower.
float ease_out(double t) {
  const double rest = 1 - std::clamp(t, 0.0, 1.0);
  return static_cast<float>(1 - rest * rest * rest);
}

}  // namespace

const ThemeColors& theme_colors() {
  return state().colors;
}
bool has_high_contrast() {
  return state().theme == Theme::contrast;
}
bool is_light() {
  return state().theme == Theme::light;
}

bool apply_theme(double scale, Theme theme, bool reduce_motion) {
  State& s = state();
  const bool first = s.scale == 0, rescaled = s.scale != scale;
  s.scale = scale;
  s.reduce_motion = reduce_motion;
  if (first || theme != s.theme) {
    s.theme = theme;
    s.from = s.colors;
    s.to = colors_of(theme);
    s.changed_at = ImGui::GetTime();
    if (first || reduce_motion) {
      s.colors = s.to;
      s.changed_at = -1;
    }
  }
  set_imgui_sizes();
  set_imgui_colors();
  if (rescaled) load_fonts();
  return rescaled;
}

void advance_theme() {
  State& s = state();
  if (s.changed_at < 0) return;
  const double t = (ImGui::GetTime() - s.changed_at) / kFade;
  s.colors = t < 1 ? blended(s.from, s.to, ease_out(t)) : s.to;
  if (t >= 1) s.changed_at = -1;
  s.moves = true;
  set_imgui_colors();
}

float px(double units) {
  return static_cast<float>(std::round(units * state().scale));
}

ImFont* font(Type type) {
  const ImVector<ImFont*>& fonts = ImGui::GetIO().Fonts->Fonts;
  return fonts[std::min(static_cast<int>(type), fonts.Size - 1)];
}

ImVec4 color_of(ImU32 color) {
  return ImGui::ColorConvertU32ToFloat4(color);
}

ImU32 faded(ImU32 color, float alpha) {
  const float a =
      static_cast<float>(color >> IM_COL32_A_SHIFT & 255) * alpha * ImGui::GetStyle().Alpha;
  return (color & ~IM_COL32_A_MASK) | static_cast<ImU32>(std::lround(a)) << IM_COL32_A_SHIFT;
}

ImU32 blended(ImU32 from, ImU32 to, float t) {
  const ImVec4 a = color_of(from), b = color_of(to);
  return ImGui::ColorConvertFloat4ToU32(
      {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z), a.w + t * (b.w - a.w)});
}

float appearance(ImGuiID id) {
  State& s = state();
  const int frame = ImGui::GetFrameCount();
  State::Seen& seen = s.seen[id];
  if (seen.frame < frame - 1) seen.since = ImGui::GetTime();
  seen.frame = frame;
  const double t = (ImGui::GetTime() - seen.since) / kFade;
  if (s.reduce_motion || t >= 1) return 1;
  s.moves = true;
  return std::max(ease_out(t), 0.01f);  // ImGui ignores windows with alpha 0
}

float eased(ImGuiID id, bool on) {
  State& s = state();
  const float goal = on ? 1 : 0;
  float& value = s.eased.try_emplace(id, goal).first->second;
  const float step = ImGui::GetIO().DeltaTime / static_cast<float>(kFade);
  if (s.reduce_motion || std::abs(goal - value) <= step)
    value = goal;
  else {
    value += goal > value ? step : -step;
    s.moves = true;
  }
  return value;
}

bool take_motion() {
  return std::exchange(state().moves, false);
}

void draw_shadow(ImDrawList& list, ImVec2 from, ImVec2 to, float blur, float alpha) {
  if (has_high_contrast()) return;
  const ImU32 color = faded(IM_COL32_BLACK, is_light() ? alpha / 2 : alpha);
  const float drop = blur / 3;
  const auto [u0, u1] = shadow_texture();
  const ImVec2 middle = (u0 + u1) * 0.5f;
  const float xs[] = {from.x - blur, from.x + blur, to.x - blur, to.x + blur},
              ys[] = {from.y - blur + drop, from.y + blur + drop, to.y - blur + drop,
                      to.y + blur + drop},
              us[] = {u0.x, middle.x, middle.x, u1.x}, vs[] = {u0.y, middle.y, middle.y, u1.y};
  const ImVec2 all = ImGui::GetIO().DisplaySize;
  const ImRect bands[] = {{0, 0, all.x, from.y},
                          {0, to.y, all.x, all.y},
                          {0, from.y, from.x, to.y},
                          {to.x, from.y, all.x, to.y}};
  for (const ImRect& band : bands) {
    list.PushClipRect(band.Min, band.Max);
    for (size_t j = 0; j < 3; ++j)
      for (size_t i = 0; i < 3; ++i)
        list.AddImage(ImGui::GetIO().Fonts->TexID, {xs[i], ys[j]}, {xs[i + 1], ys[j + 1]},
                      {us[i], vs[j]}, {us[i + 1], vs[j + 1]}, color);
    list.PopClipRect();
  }
}

CanvasColors canvas_colors() {
  const ThemeColors& c = theme_colors();
  const auto plain = [](ImU32 color) {
    const ImVec4 v = color_of(color);
    return Color{v.x, v.y, v.z};
  };
  CanvasColors colors;
  colors.canvas = plain(c.canvas);
  colors.page_a = plain(c.page_a);
  colors.page_b = plain(c.page_b);
  colors.pose = rgb(0x35d0a5);
  colors.rest = rgb(0xff7a6b);
  colors.pin = rgb(0xffb02e);
  colors.stroke = rgb(0x7cc8ff);
  colors.curve = rgb(0xd0a2ff);
  colors.unreached = rgb(0xffd58a);
  colors.selected = rgb(0x5b9bff);
  colors.hover = rgb(0xffffff);
  colors.fold = rgb(0xff5247);
  colors.overlap = rgb(0xf5b64c);
  colors.outline = rgb(0x000000, has_high_contrast() ? 255 : 90);
  colors.text = c.text;
  colors.panel = c.raised;
  colors.warning = rgb(0xff5247);
  colors.accent = rgb(0x5b9bff);
  return colors;
}

}  // namespace holomorph
