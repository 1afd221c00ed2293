// Fonts, sizes and colors.
#pragma once

#include <imgui.h>

#include <string>

#include "core/maps/heat.h"
#include "scene/preferences.h"

namespace holomorph {

/// Sets ImGui's fonts and style.
void apply_theme(double scale, Theme theme);

/// The large font for titles.
ImFont* title_font();

/// Draws text on as many lines as it needs. It breaks only at white space, whereas ImGui's own
/// wrapping also breaks within numbers such as 1.6.
void wrapped_text(const std::string& text);
/// Shortens a text to as many of its clauses, which commas and semicolons end, as fit into a width
/// in px. If not even the first clause fits, returns its beginning and "...".
std::string fitted_text(const std::string& text, float width);

/// Colors of the canvas and of what is drawn over it.
struct CanvasColors {
  Color canvas, backdrop;
  ImU32 pose, rest, pin, selected, hover, outline, text, panel, warning, accent;
};
CanvasColors canvas_colors(Theme theme);

}  // namespace holomorph
