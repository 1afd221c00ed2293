// The panels around the canvas: each is a function that draws the panel and changes the workspace.
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

/// The flags of a panel: a window without a title that stays where it is put.
inline constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                           ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                           ImGuiWindowFlags_NoSavedSettings |
                                           ImGuiWindowFlags_NoBringToFrontOnFocus;

/// Begins a part of a window that scrolls on its own. Keys move into it as into the rest.
inline bool begin_part(const char* id, ImVec2 size = {0, 0}, bool border = false) {
  return ImGui::BeginChild(id, size, border, ImGuiWindowFlags_NavFlattened);
}

/// What a panel can ask of the editor besides actions.
struct PanelAnswer {
  std::optional<Path> open;     ///< a recent file
  std::optional<Path> sample;   ///< a scene to start from
  std::optional<Path> recover;  ///< an autosave
  std::optional<Path> discard;  ///< an autosave to delete
  bool style_changed = false;   ///< theme or scale in the preferences
  bool preferences_changed = false;
};

/// Sizes of the panels in window px for a scale of the display.
struct PanelSizes {
  double menu, toolbar, inspector, status, timeline;
  bool two_rows = false;  ///< the timeline's numbers are below its buttons
  static PanelSizes at(double scale);
};

/// A choice for the look of the interface, a theme or a size, and the preferences with that choice.
struct Look {
  std::string group, label;
  Preferences preferences;
};
std::vector<Look> looks(const Preferences& now);

/// Draws the menus, whose names are listed here. If `focus` is given, the first menu takes the
/// keys. Returns recent files to open and changes of the style.
PanelAnswer draw_menu_bar(Workspace& workspace, Preferences& preferences, PanelFocus* focus);
void draw_toolbar(Workspace& workspace, double scale);
void draw_inspector(Workspace& workspace, LayerPanel& layers, const HeatScale& heat, double scale,
                    Theme theme);

/// What the status bar shows that is not in the workspace.
struct StatusLine {
  std::string hint;
  std::optional<Complex> cursor,
      cursor_at_rest;  ///< the pointer's position, and the point that the map takes there
  bool draft = false;  ///< a drag is in progress, or the map is not ready
  bool by_operator = false;
};
void draw_status_bar(Workspace& workspace, const StatusLine& status, double scale);

PanelAnswer draw_welcome(Workspace& workspace, const Preferences& preferences,
                         const std::vector<Sample>& samples,
                         const std::vector<Recovery>& recoverable, double scale);

/// Draws the menu of a right click on the canvas.
void draw_context_menu(Workspace& workspace);

/// Shows what the action of the item drawn last does, with its keys, if the pointer is on it.
void tooltip_of(const Action& action);

/// Begins a small window over the canvas. `pivot`, in fractions of the card's size, is the point of
/// the card that lies at `at`, in window px. end_card() ends the card.
void begin_card(const char* name, ImVec2 at, ImVec2 pivot, double scale);
void end_card();

/// Whether Escape was pressed and is meant for the dialog that is being drawn, not for a list that
/// is open in it. To be called once per frame, after the dialog's items.
bool escape_pressed();

/// A clickable row whose text comes from a file. The row is identified by `number`, which must be
/// unique in the window, and not by its text.
bool text_row(int number, const std::string& text, bool selected, ImVec2 size = {0, 0},
              ImGuiSelectableFlags flags = 0);

/// ImGui's combo box, but Escape closes it.
bool begin_combo(const char* label, const char* preview);

/// Draws the slider for the number of points of the next cage made from the picture.
void points_slider(Workspace& workspace, float width);

/// If the picture has no cage, offers the ways to make one. Returns the height that the card takes
/// up at the bottom of the canvas, in px; 0 if there is nothing to offer.
float draw_cage_offer(Workspace& workspace, double scale);

/// Says which picture is missing and offers to find it. The card stays `above` px or more above the
/// canvas' lower edge.
void draw_missing_picture(Workspace& workspace, double scale, float above);

}  // namespace holomorph
