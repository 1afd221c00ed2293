// The colors, sizes and fonts of the interface. No other file contains color values of panels.
#pragma once

#include <imgui.h>

#include "core/maps/heat.h"
#include "scene/preferences.h"

namespace holomorph {

/// The colors of a theme by their use.
struct ThemeColors {
  ImU32 canvas, chrome, panel, field, raised, hover, pressed;
  ImU32 line, edge;  ///< between sections; around fields
  ImU32 control;     ///< outlines of boxes, drawn figures
  ImU32 text, muted, faint;
  ImU32 accent, accent_fill, on_accent, accent_tint;  ///< text, fills, text on fills, chosen rows
  ImU32 warning, error, error_fill, success;
  ImU32 page_a, page_b;  ///< the checkerboard behind transparency
};

/// The displayed colors. While the theme changes, they lie between those of the two themes.
const ThemeColors& theme_colors();
/// Whether surfaces are separated by lines instead of shadows and gray levels.
bool has_high_contrast();
bool is_light();

/// Sets ImGui's style, and loads the fonts if the scale has changed. Returns whether it did.
/// Colors change gradually, except in the first call and with `reduce_motion`.
bool apply_theme(double scale, Theme theme, bool reduce_motion);
/// Call this once per frame. Advances the change of the colors.
void advance_theme();

/// A length in window px: `units` at 100 % interface scale, rounded to whole px.
float px(double units);

enum class Type { body, strong, title, display, caption };
ImFont* font(Type type);
/// Draws the next texts in another font while it exists.
struct ScopedFont {
  explicit ScopedFont(Type type) { ImGui::PushFont(font(type)); }
  ~ScopedFont() { ImGui::PopFont(); }
  ScopedFont(const ScopedFont&) = delete;
  ScopedFont& operator=(const ScopedFont&) = delete;
};

/// The color with its alpha multiplied by a factor, and by ImGui's current alpha.
ImU32 faded(ImU32 color, float alpha = 1);
/// A color between two colors.
ImU32 blended(ImU32 from, ImU32 to, float t);
ImVec4 color_of(ImU32 color);

/// Eases the appearance of something identified by `id`. Returns nearly 0 in the first frame in
/// which it is drawn, and 1 after 150 ms or with reduced motion. Starts again if it was absent for
/// a frame.
float appearance(ImGuiID id);
/// Moves a displayed value in 0 to 1 to its goal within 150 ms.
float eased(ImGuiID id, bool on);
/// Whether something moves, so that another frame is needed. Resets the answer.
bool take_motion();

/// Draws a soft shadow around a box, outside of it only, and without clipping. `blur` in px at the
/// interface's scale; `alpha` is halved in the light theme. Draws nothing with high contrast.
void draw_shadow(ImDrawList& list, ImVec2 from, ImVec2 to, float blur, float alpha);

/// Colors of the canvas and of what is drawn over it.
struct CanvasColors {
  Color canvas, page_a, page_b;
  ImU32 pose, rest, pin, stroke, curve;  ///< the cage posed and at rest, pins, strokes, outlines
  ImU32 unreached;                       ///< lines from pins to targets that they do not reach
  ImU32 selected, hover;
  ImU32 fold, overlap;
  ImU32 outline;  ///< under each line, so that it shows on any picture
  ImU32 text, panel, warning, accent;
};
CanvasColors canvas_colors();

}  // namespace holomorph
