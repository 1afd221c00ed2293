// Grays with one accent color. The picture should be the most colorful thing in the window.
#include "app/theme.h"

#include <filesystem>
#include <sstream>

namespace holomorph {
namespace {

ImVec4 rgb(unsigned hex, float alpha = 1) {
  return {static_cast<float>(hex >> 16 & 255) / 255, static_cast<float>(hex >> 8 & 255) / 255,
          static_cast<float>(hex & 255) / 255, alpha};
}

void add_fonts(float size) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  static const ImWchar text[] = {0x20,   0x24f,  0x370,  0x3ff,  0x2010, 0x2044,
                                 0x20ac, 0x20ac, 0x2190, 0x2193, 0};
  static const ImWchar icons[] = {0xf000, 0xf2e0, 0};
  const bool has_text = std::filesystem::exists(HOLOMORPH_FONT_FILE);
  if (has_text) {
    fonts.AddFontFromFileTTF(HOLOMORPH_FONT_FILE, size, nullptr, text);
  } else {
    ImFontConfig config;
    config.SizePixels = size;
    fonts.AddFontDefault(&config);
  }
  const auto add_title = [&] {
    if (has_text) fonts.AddFontFromFileTTF(HOLOMORPH_FONT_FILE, 2 * size);
  };
  if (!std::filesystem::exists(HOLOMORPH_ICON_FONT_FILE)) {
    add_title();
    return;
  }
  ImFontConfig merge;
  merge.MergeMode = true;
  merge.GlyphMinAdvanceX = size * 1.2f;
  merge.GlyphOffset = {0, 0};
  fonts.AddFontFromFileTTF(HOLOMORPH_ICON_FONT_FILE, size, &merge, icons);
  add_title();
}

}  // namespace

namespace {

/// Makes the interface white on black, with borders around fields and one bright selection color.
void add_contrast(ImGuiStyle& style) {
  ImVec4* c = style.Colors;
  const unsigned accent = 0x00dcff;
  style.FrameBorderSize = style.PopupBorderSize = style.WindowBorderSize = 1;
  for (const int back :
       {ImGuiCol_WindowBg, ImGuiCol_MenuBarBg, ImGuiCol_PopupBg, ImGuiCol_FrameBg, ImGuiCol_Button,
        ImGuiCol_ChildBg, ImGuiCol_TitleBg, ImGuiCol_TitleBgActive})
    c[back] = rgb(0x000000);
  for (const int line : {ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_Text})
    c[line] = rgb(0xffffff);
  c[ImGuiCol_TextDisabled] = rgb(0xd0d0d0);
  c[ImGuiCol_CheckMark] = rgb(accent);
  for (const int chosen : {ImGuiCol_Header, ImGuiCol_HeaderHovered, ImGuiCol_HeaderActive,
                           ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive, ImGuiCol_FrameBgHovered,
                           ImGuiCol_FrameBgActive, ImGuiCol_TextSelectedBg})
    c[chosen] = rgb(0x005f8a);
  c[ImGuiCol_SliderGrab] = c[ImGuiCol_SliderGrabActive] = c[ImGuiCol_PlotHistogram] = rgb(0x0090c0);
}

}  // namespace

void apply_theme(double scale, Theme theme) {
  const bool light = theme == Theme::light;
  const float s = static_cast<float>(scale);
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  if (light)
    ImGui::StyleColorsLight(&style);
  else
    ImGui::StyleColorsDark(&style);
  style.WindowRounding = 0;
  style.FrameRounding = 4;
  style.PopupRounding = 6;
  style.GrabRounding = 4;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FramePadding = {8, 5};
  style.ItemSpacing = {8, 7};
  style.WindowPadding = {12, 10};
  style.ScrollbarSize = 12;
  style.ScaleAllSizes(s);
  ImVec4* c = style.Colors;
  const unsigned accent = light ? 0x2f6fde : 0x5b9bff;
  const unsigned window = light ? 0xf4f4f5 : 0x26272b, frame = light ? 0xe1e2e6 : 0x36383e,
                 hover = light ? 0xd3d6dd : 0x44474f;
  c[ImGuiCol_WindowBg] = rgb(window);
  c[ImGuiCol_MenuBarBg] = rgb(light ? 0xe9e9ec : 0x1e1f22);
  c[ImGuiCol_PopupBg] = rgb(light ? 0xffffff : 0x2b2c31);
  c[ImGuiCol_Border] = rgb(light ? 0xc9cad0 : 0x45474f);
  c[ImGuiCol_Text] = rgb(light ? 0x1c1d21 : 0xe6e7ea);
  c[ImGuiCol_TextDisabled] = rgb(light ? 0x63656d : 0x9a9da6);
  c[ImGuiCol_FrameBg] = c[ImGuiCol_Button] = rgb(frame);
  c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_ButtonHovered] = rgb(hover);
  c[ImGuiCol_FrameBgActive] = c[ImGuiCol_ButtonActive] = rgb(accent, 0.55f);
  c[ImGuiCol_CheckMark] = rgb(accent);
  c[ImGuiCol_PlotHistogram] = rgb(accent, 0.5f);  // progress bars
  c[ImGuiCol_SliderGrab] = rgb(accent, 0.55f);    // translucent, to keep the value readable
  c[ImGuiCol_SliderGrabActive] = rgb(accent, 0.75f);
  c[ImGuiCol_ModalWindowDimBg] = rgb(0x000000, 0.5f);
  c[ImGuiCol_Header] = rgb(accent, light ? 0.22f : 0.30f);
  c[ImGuiCol_HeaderHovered] = rgb(accent, light ? 0.30f : 0.40f);
  c[ImGuiCol_HeaderActive] = rgb(accent, 0.5f);
  c[ImGuiCol_Separator] = rgb(light ? 0xd3d4d9 : 0x3a3c43);
  c[ImGuiCol_TextSelectedBg] = rgb(accent, 0.35f);
  if (theme == Theme::contrast) add_contrast(style);
  add_fonts(static_cast<float>(static_cast<int>(16 * scale + 0.5)));
}

ImFont* title_font() {
  return ImGui::GetIO().Fonts->Fonts.back();
}

CanvasColors canvas_colors(Theme theme) {
  const bool light = theme == Theme::light;
  CanvasColors colors;
  colors.canvas = light ? Color{0.82f, 0.82f, 0.84f} : Color{0.10f, 0.105f, 0.115f};
  colors.backdrop = light ? Color{0.93f, 0.93f, 0.94f} : Color{0.19f, 0.195f, 0.21f};
  colors.pose = IM_COL32(42, 190, 110, 255);
  colors.rest = IM_COL32(235, 90, 80, 255);
  colors.pin = IM_COL32(250, 170, 30, 255);
  colors.selected = IM_COL32(255, 255, 255, 255);
  colors.hover = IM_COL32(255, 235, 120, 255);
  colors.outline = IM_COL32(0, 0, 0, 170);
  colors.text = light ? IM_COL32(28, 29, 33, 255) : IM_COL32(230, 231, 234, 255);
  colors.panel = light ? IM_COL32(255, 255, 255, 235) : IM_COL32(43, 44, 49, 240);
  colors.warning = light ? IM_COL32(200, 40, 40, 255) : IM_COL32(255, 110, 100, 255);
  colors.accent = light ? IM_COL32(47, 111, 222, 255) : IM_COL32(91, 155, 255, 255);
  if (theme == Theme::contrast) {
    colors.canvas = {0, 0, 0};
    colors.backdrop = {0.13f, 0.13f, 0.13f};
    colors.pose = IM_COL32(90, 255, 150, 255);
    colors.rest = IM_COL32(255, 140, 120, 255);
    colors.pin = IM_COL32(255, 210, 0, 255);
    colors.hover = IM_COL32(255, 255, 0, 255);
    colors.outline = IM_COL32(0, 0, 0, 255);
    colors.text = IM_COL32(255, 255, 255, 255);
    colors.panel = IM_COL32(0, 0, 0, 255);
    colors.warning = IM_COL32(255, 150, 140, 255);
    colors.accent = IM_COL32(0, 220, 255, 255);
  }
  return colors;
}

void wrapped_text(const std::string& text) {
  const float width = ImGui::GetContentRegionAvail().x;
  const auto fits = [&](const std::string& line) {
    return ImGui::CalcTextSize(line.c_str()).x <= width;
  };
  std::string lines, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && !fits(line + " " + word)) {
      lines += line + "\n";
      line.clear();
    }
    line += line.empty() ? word : " " + word;
  }
  ImGui::TextUnformatted((lines + line).c_str());
}

std::string fitted_text(const std::string& text, float width) {
  std::string fitted = text;
  const auto is_wide = [&] { return ImGui::CalcTextSize(fitted.c_str()).x > width; };
  while (!fitted.empty() && is_wide()) {
    const size_t end = fitted.find_last_of(",;");
    fitted.resize(end == std::string::npos ? 0 : end);
  }
  if (!fitted.empty() || text.empty()) return fitted;
  // Even the first clause does not fit. Keep as many whole characters as fit.
  size_t kept = std::min(text.find_first_of(",;"), text.size());
  if (kept == 0) return "";
  do {
    do --kept;
    while (kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xc0) == 0x80);
    fitted = text.substr(0, kept) + "...";
  } while (kept > 0 && is_wide());
  return kept > 0 ? fitted : "";
}

}  // namespace holomorph
