// What controls lie on: panels, cards, dialogs and menus, with their shadows and fades.
#pragma once

#include <imgui.h>

#include <string>

#include "app/look/theme.h"

namespace holomorph {

/// ImGui flags of a panel: a window without a title that cannot be moved or resized.
inline constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                           ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                           ImGuiWindowFlags_NoSavedSettings |
                                           ImGuiWindowFlags_NoBringToFrontOnFocus;

/// Begins a panel with a background color; end_panel() ends it. `padding` in units.
void begin_panel(const char* name, ImVec2 from, ImVec2 to, ImU32 background, ImVec2 padding,
                 ImGuiWindowFlags flags = 0);
void end_panel();

/// Begins a part of a window that scrolls separately. Arrow keys move into and out of it.
inline bool begin_part(const char* id, ImVec2 size = {0, 0}, bool border = false) {
  return ImGui::BeginChild(id, size, border, ImGuiWindowFlags_NavFlattened);
}

/// Begins a card, a small window over the canvas; end_card() ends it. The card's point `pivot`, in
/// fractions of its size, is placed at `at`, in window px.
void begin_card(const char* name, ImVec2 at, ImVec2 pivot, ImGuiWindowFlags flags = 0);
void end_card();
/// Like begin_card, for a window in front of the panels whose size is set before. End it with
/// end_card().
void begin_floating(const char* name, ImVec2 at, ImVec2 pivot, ImGuiWindowFlags flags = 0);

/// Begins a dialog in the middle of the window, with a flat title, a shadow and darkness behind;
/// call end_dialog() if this returns true. `width` in units; height 0 fits the contents.
bool begin_dialog(const std::string& title, const char* id, float width, float height = 0);
void end_dialog();
/// Begins the row of buttons at the end of a dialog, below a line. `buttons` is their width in px.
void begin_dialog_buttons(float buttons);

/// Opens a list of entries, such as a context menu; call end_menu_popup() if this returns true.
bool begin_menu_popup(const char* id);
void end_menu_popup();
/// A submenu or a menu of the menu bar; call end_menu() if this returns true.
bool begin_menu(const char* label, bool enabled = true);
void end_menu();
/// An entry of a menu. Returns whether it was chosen.
bool menu_entry(const std::string& label, const std::string& keys, bool checked,
                bool enabled = true);
void menu_separator();

/// The key that was pressed to end the current dialog: Escape, or Enter for its default button.
/// None if a list in the dialog, a text field or the item with the keyboard focus takes the key.
/// Call this once per frame, after drawing the dialog's items.
enum class DialogKey { none, escape, enter };
DialogKey dialog_key();

}  // namespace holomorph
