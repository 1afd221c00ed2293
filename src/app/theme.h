// Fonts, sizes and colours.
#pragma once

#include <imgui.h>

#include "core/heat.h"

namespace holomorph {

/// Sets ImGui's fonts and style.
void apply_theme(double scale, bool light);

/// The large font of titles.
ImFont* title_font();

/// Colours of what is drawn over the canvas.
struct CanvasColors {
  Color canvas, backdrop;
  ImU32 pose, rest, pin, selected, hover, outline, text, panel, warning, accent;
};
CanvasColors canvas_colors(bool light);

}  // namespace holomorph
