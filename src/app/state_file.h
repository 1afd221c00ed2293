// The editor's state as JSON, for scripts that drive the editor with real input events.
#pragma once

#include "edit/workspace.h"
#include "scene/preferences.h"

namespace holomorph {

/// The part of the editor's state that is not in the workspace.
struct PartsState {
  bool gesture = false;  ///< a tool is in use
  int compared_rows = 0;
  bool on_surface = false;       ///< the surface in space shows the picture
  double yaw = 0, distance = 0;  ///< position of the surface's camera
  double slowest_ms = 0;         ///< longest frame so far, from its first event to its last pixel
  double slowest_work_ms = 0;    ///< longest time between drawing since the last press of a button
  bool settling = false;         ///< the view will move in the next frame
  bool pending = false;          ///< input events are queued for later frames
  int taken = 0;                 ///< presses and releases of keys and buttons handled so far
  std::pair<double, double> pointer = {};  ///< position of the pointer in the last frame
  bool asking = false;                     ///< a dialog has the keyboard focus
  std::string question = {};               ///< title of the question dialog about files
  bool in_panel = false;                   ///< a panel has the keyboard focus
  Theme theme = Theme::dark;
  double scale = 1;                            ///< scale of the interface
  bool exporting = false;                      ///< a job, such as an export, is running
  bool moving = false;                         ///< a fade or a switch of the interface is moving
  bool solving = false, last_picture = false;  ///< the sign, or the last picture, is shown
};

class StateFile {
 public:
  explicit StateFile(Path path) : path_(std::move(path)) {}
  /// Writes the state if it has changed since the last write. The plane point (x, y) is at the
  /// window position px = left + width / 2 + (x - center_x) zoom, py = top + height / 2 - (y -
  /// center_y) zoom.
  void write(const Workspace& workspace, const PartsState& parts);

 private:
  Path path_;
  std::string last_;
};

}  // namespace holomorph
