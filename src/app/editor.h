// The editor: a screen around a workspace.
#pragma once

#include "app/canvas/canvas.h"
#include "app/canvas/navigation.h"
#include "app/canvas/split_line.h"
#include "app/canvas/surface_pane.h"
#include "app/dialogs/keys_window.h"
#include "app/dialogs/palette.h"
#include "app/files.h"
#include "app/last_picture_view.h"
#include "app/panels/comparison_panel.h"
#include "app/panels/first_steps.h"
#include "app/panels/panel_focus.h"
#include "app/panels/panels.h"
#include "app/panels/start_card.h"
#include "app/panels/timeline_panel.h"
#include "app/panels/toasts.h"
#include "app/run_editor.h"
#include "app/samples.h"
#include "app/screen.h"
#include "app/thumbnails.h"
#include "edit/key_focus.h"
#include "edit/tools/tool.h"

namespace holomorph {

/// Runs each frame, from input to pixels, in the order described in src/README.md.
class Editor {
 public:
  /// Reports a file that cannot be read in the window. The screen must outlive the editor.
  Editor(Screen& screen, Preferences preferences, const EditorOptions& options);

  /// Waits for input for a moment and draws a frame if one is due. Returns false once the user has
  /// quit.
  bool step();

 private:
  friend class EditorState;  // of the tests

  void frame();
  void layout(const PanelSizes& sizes);

  /// A view of this size that shows the whole picture, next to the start card if there is one.
  Viewport fitted(Viewport view) const;
  static bool is_same_view(const Viewport& a, const Viewport& b);

  /// Fits the view to the posed picture of a newly opened scene, unless the user has already
  /// started to work. Waits for the map, which determines the picture's extent.
  void show_whole_map();
  void handle_events();
  static bool has_popup();
  WindowFocus window_focus() const;
  void handle_panel_key(const Shortcut& key);

  /// Whether a key of this action is down. Used for actions that last while a key is held.
  bool is_held(const char* id) const;
  void take_key(const Shortcut& key);

  /// During a gesture, only actions that allow it can run, such as changes of the view. Undo takes
  /// back part of the gesture.
  void handle_key_in_gesture(const Shortcut& key);
  Input read_input();
  bool press_waits(Complex px) const;
  ToolOverlay gesture();
  void navigate(Input& input);
  Tool& current_tool() const;
  void use_tool(Input input);
  void open_context_menu(const Input& input);
  void answer(Request request);
  void answer(const PanelAnswer& wanted);
  void document_replaced();
  void update_title();
  void draw_canvas();
  void draw_panels(const Input& input, PanelSizes sizes);

  /// Draws the cards and the inspector, whose lower part cards take if the canvas has no room.
  void draw_cards(const OverlayStyle& style, PanelSizes sizes);
  StatusLine status_of(const Input& input);

  Preferences preferences_;
  Screen& screen_;
  Canvas canvas_;
  Workspace workspace_;
  std::vector<std::unique_ptr<Tool>> tools_;
  ToolId last_tool_ = ToolId::select;
  Samples samples_{[this] { screen_.wake(); }};
  Toasts toasts_;
  Thumbnails thumbnails_{[this] { screen_.wake(); }};
  StartCard start_card_{[this] { screen_.wake(); }};
  FirstSteps first_steps_;
  std::string title_;
  bool fit_ = false, opened_ = false, halved_ = false, was_active_ = false, restyle_ = false,
       menu_was_open_ = false, goes_to_menu_ = false, moving_ = false;
  double watched_ms_ = 0;
  Navigation navigation_;
  SplitLine split_line_;
  ComparisonPanel comparison_;
  SurfacePane surface_pane_{[this] { screen_.wake(); }};
  TimelinePanel timeline_;
  LastPictureView last_picture_{[this] { screen_.wake(); }};
  LayerPanel layers_;
  Files files_;
  KeysWindow keys_;
  Palette palette_;
  PanelFocus panel_focus_;
};

}  // namespace holomorph
