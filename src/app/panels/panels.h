// The panels around the canvas: each is a function that draws itself and changes the workspace.
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

/// A window that is part of the frame: it has no title and stays where it is put.
inline constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                           ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                           ImGuiWindowFlags_NoSavedSettings |
                                           ImGuiWindowFlags_NoBringToFrontOnFocus;

/// A part of a window that scrolls on its own, into which keys go as into the rest.
inline bool begin_part(const char* id, ImVec2 size = {0, 0}, bool border = false) {
  return ImGui::BeginChild(id, size, border, ImGuiWindowFlags_NavFlattened);
}

/// What a panel can ask of the editor beyond actions.
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
  bool two_rows = false;  ///< of the timeline's buttons and numbers
  static PanelSizes at(double scale);
};

/// What the interface can look like: a theme or a size, and the preferences with it.
struct Look {
  std::string group, label;
  Preferences preferences;
};
std::vector<Look> looks(const Preferences& now);

/// One menu per name in the action table; the first one gets `focus`, if that is given. Returns
/// recent files to open and style changes.
PanelAnswer draw_menu_bar(Workspace& workspace, Preferences& preferences, PanelFocus* focus);
void draw_toolbar(Workspace& workspace, double scale);
void draw_inspector(Workspace& workspace, LayerPanel& layers, const HeatScale& heat, double scale,
                    Theme theme);

/// What the status bar says besides the workspace.
struct StatusLine {
  std::string hint;
  std::optional<Complex> cursor,
      cursor_at_rest;  ///< the pointer's place, and where that comes from
  bool draft = false;  ///< a drag is going on or the map is being prepared
  bool by_operator = false;
};
void draw_status_bar(Workspace& workspace, const StatusLine& status, double scale);

PanelAnswer draw_welcome(Workspace& workspace, const Preferences& preferences,
                         const std::vector<Sample>& samples,
                         const std::vector<Recovery>& recoverable, double scale);

/// What a right click on the canvas offers.
void draw_context_menu(Workspace& workspace);

/// Says what the item that was drawn last does, with its keys.
void tooltip_of(const Action& action);

/// A small window over the canvas, whose middle of an edge or corner (`pivot`, in parts of it) is
/// at a place of the window; end_card ends it.
void begin_card(const char* name, ImVec2 at, ImVec2 pivot, double scale);
void end_card();

/// Whether Escape is for the dialog that is being drawn: not for a list that it has open. To be
/// asked once a frame, after its items.
bool escape_pressed();

/// A row to click whose text comes from a file: whatever it says, the row has an identity of its
/// own, a number that is its own in the window.
bool text_row(int number, const std::string& text, bool selected, ImVec2 size = {0, 0},
              ImGuiSelectableFlags flags = 0);

/// ImGui's combo, which Escape closes.
bool begin_combo(const char* label, const char* preview);

/// How many points the next cage from the picture has.
void points_slider(Workspace& workspace, float width);

/// The ways to a cage for a picture without one. Returns how high it stands, in px; 0 where there
/// is nothing to offer.
float draw_cage_offer(Workspace& workspace, double scale);

/// Says which picture is missing and asks for it, so high above the canvas' lower edge.
void draw_missing_picture(Workspace& workspace, double scale, float above);

}  // namespace holomorph
