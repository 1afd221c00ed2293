// Texts in the fonts and colors of the interface.
#pragma once

#include <imgui.h>

#include <string>

#include "app/look/theme.h"

namespace holomorph {

/// Draws text wrapped at white space only. ImGui's own wrapping also breaks lines within numbers
/// such as 1.6.
void wrapped_text(const std::string& text);
/// Draws wrapped, muted text in the caption font.
void caption(const std::string& text);
/// Draws one line of muted text.
void muted_text(const std::string& text);
/// Draws one line in a color.
void colored_text(ImU32 color, const std::string& text);
/// Shortens a text to the leading clauses that fit into a width in px. A clause ends at a comma or
/// semicolon. If even the first clause does not fit, returns its beginning and "...".
std::string fitted_text(const std::string& text, float width);
/// Shortens a text to as many characters as fit, followed by an ellipsis.
std::string shortened_text(const std::string& text, float width);

ImVec2 text_size(Type type, const std::string& text);
/// Draws text with its top left corner at a position, without using up space in the window.
void draw_text(ImDrawList& list, Type type, ImVec2 at, ImU32 color, const std::string& text);
/// Draws text in lines that are at most `width` wide.
void draw_wrapped_text(ImDrawList& list, Type type, ImVec2 at, ImU32 color, const std::string& text,
                       float width);
/// Draws text in the middle of a box.
void draw_centered_text(ImDrawList& list, Type type, ImVec2 from, ImVec2 to, ImU32 color,
                        const std::string& text);
/// Draws an icon with its center at a position, 20 px wide, or 16 px with Type::caption.
void draw_icon(ImDrawList& list, const char* icon, ImVec2 center, ImU32 color,
               Type size = Type::body);

/// Draws a key in a frame, and returns the width that it takes. `top` is the top of a line of
/// `height` px in which it is centered.
float draw_key_cap(ImDrawList& list, ImVec2 top, float height, const std::string& key);
/// Draws a sentence in a line of `height` px. Names of keys in it, such as Shift, are framed.
void draw_hint(ImDrawList& list, ImVec2 top, float height, ImU32 color, const std::string& text);

}  // namespace holomorph
