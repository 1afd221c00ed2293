// The font atlas: Roboto in five styles, the program's icons, and a blurred square for shadows.
#pragma once

#include <imgui.h>

#include <utility>

namespace holomorph {

/// Builds the atlas with one font for each Type. Icons are 20 px wide, and 16 px in the caption
/// font, at 100 % scale. Reads the font files of the distribution; without them, ImGui's own font
/// takes their place.
void load_fonts();
/// Texture coordinates of the square whose edges are blurred from its corners to its center.
std::pair<ImVec2, ImVec2> shadow_texture();

}  // namespace holomorph
