// Small drawings that show what a method does: one figure of round limbs, moved by each.
#pragma once

#include <imgui.h>

#include <string>

namespace holomorph {

/// Draws the picture of a method, or of "place", with its center at a position. `scale` 1 fits into
/// 72 x 56 px at 100 % interface scale. `ink` is the color of the figure; its handles are in the
/// accent color, with rims in the color of the `surface` behind.
void draw_method_picture(ImDrawList& list, const std::string& method, ImVec2 center, float scale,
                         ImU32 ink, ImU32 surface);

}  // namespace holomorph
