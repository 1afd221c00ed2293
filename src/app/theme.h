// Fonts, sizes and colours.
#pragma once

#include <imgui.h>

#include <string>

#include "core/maps/heat.h"
#include "scene/preferences.h"

namespace holomorph {

/// Sets ImGui's fonts and style.
void apply_theme(double scale, Theme theme);

/// The large font of titles.
ImFont* title_font();

/// Text on as many lines as it needs; ImGui's own wrapping breaks within numbers like 1.6, too.
void wrapped_text(const std::string& text);
/// As many clauses of a text, which commas and semicolons end, as fit into a width; where not even
/// the first one does, its beginning and "...".
std::string fitted_text(const std::string& text, float width);

/// Colours of what is drawn over the canvas.
struct CanvasColors {
  Color canvas, backdrop;
  ImU32 pose, rest, pin, selected, hover, outline, text, panel, warning, accent;
};
CanvasColors canvas_colors(Theme theme);

}  // namespace holomorph
