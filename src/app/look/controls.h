// Labels, buttons, switches, lists and fields, drawn over ImGui's behavior. In a panel, labels form
// a column at the left. Controls are ImGui items, so they keep its keyboard focus and disabled
// states. They are drawn over in the colors of the theme.
#pragma once

#include <imgui.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/look/items.h"

namespace holomorph {

/// The width of the column of labels in the current panel or dialog, px. 80 at first.
float label_width();
struct ScopedLabelWidth {
  explicit ScopedLabelWidth(float width);
  ~ScopedLabelWidth();
  ScopedLabelWidth(const ScopedLabelWidth&) = delete;
  ScopedLabelWidth& operator=(const ScopedLabelWidth&) = delete;

 private:
  float before_;
};

/// Draws a label in the column of labels. The next item follows in the same row.
void row_label(const std::string& label, const std::string& hint = "");

/// A switch, for settings that act immediately. Returns whether it was toggled.
bool toggle_switch(const std::string& name, bool on);
/// A label and a switch.
bool switch_row(const std::string& label, bool on, const std::string& hint = "");
/// A box with a check mark and a label at its right, for dialogs.
bool check_box(const std::string& label, bool& on);

/// Two or three alternatives next to each other. Returns the one that was clicked.
std::optional<size_t> segmented(const std::string& name, const std::vector<std::string>& options,
                                std::optional<size_t> chosen, float width = 0);
/// A list that opens below a field. If it returns true, draw the rows and call end_dropdown().
bool begin_dropdown(const std::string& name, const std::string& preview, float width = 0);
/// A row of a dropdown.
bool dropdown_row(const std::string& label, bool chosen, bool enabled = true);
void end_dropdown();

enum class ButtonKind { secondary, primary, danger, flat, flat_danger };
/// `width` 0 fits the label, which may begin with an icon; -1 fills the row.
bool button(const std::string& label, ButtonKind kind = ButtonKind::secondary, float width = 0);
/// A button of less height, for toolbars and rows.
bool small_button(const std::string& label, ButtonKind kind = ButtonKind::secondary);
/// A square button with an icon. `on` gives it an accent tint.
bool icon_button(const std::string& name, const char* icon, const std::string& tip, bool on = false,
                 float size = 0, Type icon_size = Type::body);
/// A button for an action, with its icon, tooltip, and state. Runs the action if it is clicked.
void action_icon_button(const std::string& id, Workspace& workspace);

/// Begins a section of the inspector: a title of 36 px with a state at its right and a chevron.
/// Returns whether the section is open. `open` is where that is kept.
bool begin_section(const std::string& title, const std::string& state, ImU32 state_color,
                   bool& open);

/// A single-line field for text. Returns whether Enter was pressed.
bool text_field(const std::string& name, std::string& text, const char* hint, float width,
                ImGuiInputTextFlags flags = 0);
/// A field with a color. Returns whether it changed.
bool color_field(const std::string& name, std::array<std::uint8_t, 3>& color, float width);

/// A vertical hairline with gaps, in a horizontal bar of this height.
void bar_separator(float height);

}  // namespace holomorph
