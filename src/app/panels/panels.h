// The panels around the canvas. Each is a function that draws the panel and changes the workspace.
#pragma once

#include "app/look/surfaces.h"
#include "app/panels/layer_panel.h"
#include "app/panels/panel_focus.h"
#include "app/panels/start_card.h"
#include "app/samples.h"
#include "app/thumbnails.h"
#include "app/window.h"
#include "edit/actions/actions.h"
#include "edit/tools/tool.h"
#include "scene/preferences.h"
#include "scene/recovery.h"

namespace holomorph {

/// What a panel can request from the editor besides actions.
struct PanelAnswer {
  std::optional<Path> open;     ///< a recent file
  std::optional<Path> sample;   ///< a scene to start from
  std::optional<Path> recover;  ///< an autosave
  std::optional<Path> discard;  ///< an autosave to delete
  bool style_changed = false;   ///< the theme, scale or motion in the preferences has changed
  bool preferences_changed = false;
  std::string hint;  ///< explains the entry of a menu under the pointer
};

/// Sizes of the panels in window px.
struct PanelSizes {
  double menu, toolbar, options, inspector, status;
  double timeline = 0;    ///< set by the editor
  bool two_rows = false;  ///< the timeline's numbers form a second row below its buttons
  /// At the current interface scale and window size.
  static PanelSizes now();
};

/// A theme or size of the interface, and the preferences that result from choosing it.
struct Look {
  std::string group, label;
  Preferences preferences;
};
std::vector<Look> looks(const Preferences& now);

/// Draws the menu bar. If `focus` is given, moves the keyboard focus to the first menu. Returns
/// recent files to open and changes of the style.
PanelAnswer draw_menu_bar(Workspace& workspace, Preferences& preferences, Thumbnails& thumbnails,
                          PanelFocus* focus);
/// Draws the canvas's context menu, which a right click opens.
PanelAnswer draw_context_menu(Workspace& workspace, Preferences& preferences,
                              Thumbnails& thumbnails);
void draw_tool_bar(Workspace& workspace, const PanelSizes& sizes);
void draw_options_bar(Workspace& workspace, const PanelSizes& sizes);

/// What the inspector shows besides the workspace.
struct InspectorParts {
  LayerPanel& layers;
  Thumbnails& thumbnails;
  Preferences& preferences;
  const HeatScale& heat;
  StartCard* start_card;  ///< to draw in the place of the selection; may be null
  const OverlayStyle& style;
};
/// Returns whether a section was opened or closed.
PanelAnswer draw_inspector(Workspace& workspace, const InspectorParts& parts,
                           const PanelSizes& sizes);

/// The parts of the status bar that do not come from the workspace.
struct StatusLine {
  std::string hint;
  std::optional<Complex> cursor,
      cursor_at_rest;  ///< the pointer's position, and its preimage under the map
  bool draft = false;  ///< a drag is in progress, or the map is not ready
};
void draw_status_bar(Workspace& workspace, const StatusLine& status, const PanelSizes& sizes);

PanelAnswer draw_welcome(Workspace& workspace, const Preferences& preferences, Samples& samples,
                         const std::vector<Recovery>& recoverable, Thumbnails& thumbnails,
                         const PanelSizes& sizes);

/// Draws a row with the thumbnail and name of a recent file and its folder. Returns whether it was
/// clicked.
bool recent_row(int number, const Path& file, Thumbnails& thumbnails);
/// Draws a thumbnail on a checkerboard in a square box with its upper left corner at `at`.
void draw_thumbnail(ImDrawList& list, const Texture* texture, ImVec2 at, float side,
                    float rounding);
/// Draws a checkerboard.
void draw_checkerboard(ImDrawList& list, ImVec2 from, ImVec2 to, float cell);

/// Draws a clickable row whose text comes from a file. ImGui identifies the row by `number`, which
/// must be unique in the window, instead of by its text. Returns whether the row was clicked.
bool text_row(int number, const std::string& text, bool selected, ImVec2 size = {0, 0},
              ImGuiSelectableFlags flags = 0);

inline constexpr const char* kDetailHint =
    "How closely the next cage made from the picture follows it. An opaque picture gets its "
    "rectangle.";

/// Draws a card that names a missing picture and offers to find it.
void draw_missing_picture(Workspace& workspace);

}  // namespace holomorph
