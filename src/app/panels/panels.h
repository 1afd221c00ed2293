// The panels around the canvas. Each is a function that draws the panel and changes the workspace.
#pragma once

#include "app/panels/layer_panel.h"
#include "app/panels/panel_focus.h"
#include "app/samples.h"
#include "app/theme.h"
#include "app/window.h"
#include "edit/actions/actions.h"
#include "edit/tools/tool.h"
#include "scene/preferences.h"
#include "scene/recovery.h"

namespace holomorph {

/// ImGui flags of a panel: a window without a title that cannot be moved or resized.
inline constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                           ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                           ImGuiWindowFlags_NoSavedSettings |
                                           ImGuiWindowFlags_NoBringToFrontOnFocus;

/// Begins a part of a window that scrolls separately. Arrow keys move into and out of it.
inline bool begin_part(const char* id, ImVec2 size = {0, 0}, bool border = false) {
  return ImGui::BeginChild(id, size, border, ImGuiWindowFlags_NavFlattened);
}

/// What a panel can request from the editor besides actions.
struct PanelAnswer {
  std::optional<Path> open;     ///< a recent file
  std::optional<Path> sample;   ///< a scene to start from
  std::optional<Path> recover;  ///< an autosave
  std::optional<Path> discard;  ///< an autosave to delete
  bool style_changed = false;   ///< the theme or scale in the preferences has changed
  bool preferences_changed = false;
};

/// Sizes of the panels in window px.
struct PanelSizes {
  double menu, toolbar, inspector, status, timeline;
  bool two_rows = false;  ///< the timeline's numbers form a second row below its buttons
  static PanelSizes at(double scale);
};

/// A theme or size of the interface, and the preferences that result from choosing it.
struct Look {
  std::string group, label;
  Preferences preferences;
};
std::vector<Look> looks(const Preferences& now);

/// Draws the menu bar. If `focus` is given, moves the keyboard focus to the first menu. Returns
/// recent files to open and changes of the style.
PanelAnswer draw_menu_bar(Workspace& workspace, Preferences& preferences, PanelFocus* focus);
void draw_toolbar(Workspace& workspace, double scale);
void draw_inspector(Workspace& workspace, LayerPanel& layers, const HeatScale& heat, double scale,
                    Theme theme);

/// The parts of the status bar that do not come from the workspace.
struct StatusLine {
  std::string hint;
  std::optional<Complex> cursor,
      cursor_at_rest;  ///< the pointer's position, and its preimage under the map
  bool draft = false;  ///< a drag is in progress, or the map is not ready
  bool by_operator = false;
};
void draw_status_bar(Workspace& workspace, const StatusLine& status, double scale);

PanelAnswer draw_welcome(Workspace& workspace, const Preferences& preferences,
                         const std::vector<Sample>& samples,
                         const std::vector<Recovery>& recoverable, double scale);

/// Draws the canvas's context menu, which a right click opens.
void draw_context_menu(Workspace& workspace);

/// Shows a text as a tooltip, in lines of moderate length, if the pointer is on the last drawn
/// item.
void tooltip(const std::string& text);
/// Shows an action's label, keys and hint as a tooltip if the pointer is on the last drawn item.
void tooltip_of(const Action& action);

/// Begins a card, a small window over the canvas; end_card() ends it. The card's point `pivot`, in
/// fractions of its size, is placed at `at`, in window px.
void begin_card(const char* name, ImVec2 at, ImVec2 pivot, double scale);
void end_card();

/// Whether Escape was pressed to close the current dialog rather than a list that is open in it.
/// Call this once per frame, after drawing the dialog's items.
bool escape_pressed();

/// Draws a clickable row whose text comes from a file. ImGui identifies the row by `number`, which
/// must be unique in the window, instead of by its text. Returns whether the row was clicked.
bool text_row(int number, const std::string& text, bool selected, ImVec2 size = {0, 0},
              ImGuiSelectableFlags flags = 0);

/// Like ImGui::BeginCombo, but Escape closes the list.
bool begin_combo(const char* label, const char* preview);

/// Draws the slider that sets how closely the next cage made from the picture follows it.
void detail_slider(Workspace& workspace, float width);
/// Draws the slider that sets which empty regions become holes of the next cage.
void hole_slider(Workspace& workspace, float width);

/// If the picture has no cage, draws a card that offers ways to make one. Returns the height of the
/// card at the bottom of the canvas in px, or 0 if no card was drawn.
float draw_cage_offer(Workspace& workspace, double scale);

/// Draws a card that names a missing picture and offers to find it. The card is at least `above` px
/// above the canvas's lower edge.
void draw_missing_picture(Workspace& workspace, double scale, float above);

}  // namespace holomorph
