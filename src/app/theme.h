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

/// Draws text wrapped at white space only. ImGui's own wrapping also breaks lines within numbers
/// such as 1.6.
void wrapped_text(const std::string& text);
/// Shortens a text to the leading clauses that fit into a width in px. A clause ends at a comma or
/// semicolon. If even the first clause does not fit, returns its beginning and "...".
std::string fitted_text(const std::string& text, float width);

/// Colors of the canvas and of what is drawn over it.
struct CanvasColors {
  Color canvas, backdrop;
  ImU32 pose, rest, pin, selected, hover, outline, text, panel, warning, accent;
};
CanvasColors canvas_colors(Theme theme);

}  // namespace holomorph
