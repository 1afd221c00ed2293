// What the editor shows, as JSON, for scripts that drive it with real input.
#pragma once

#include "edit/workspace.h"
#include "scene/preferences.h"

namespace holomorph {

/// What the editor's parts know besides the workspace.
struct PartsState {
  bool gesture = false;  ///< a tool's
  int compared_rows = 0;
  bool on_surface = false;       ///< the picture is on the surface in space
  double yaw = 0, distance = 0;  ///< of the camera there
  double slowest_ms = 0;         ///< frame so far, from its first event to its last pixel
  bool settling = false;         ///< the next frame shows another part of the plane
  bool pending = false;          ///< keys and clicks wait for the next frames
  int taken = 0;                 ///< keys and buttons that have gone down or up
  bool asking = false;           ///< a dialog takes the keys
  std::string question = {};     ///< its title, where it asks about files
  bool in_panel = false;         ///< a panel does
  Theme theme = Theme::dark;
  double scale = 1;        ///< of the interface
  bool exporting = false;  ///< a film
};

class StateFile {
 public:
  explicit StateFile(Path path) : path_(std::move(path)) {}
  /// Writes the state when it differs from what the file was last given. Plane points are found in
  /// the window by  px = left + width / 2 + (x - center_x) zoom,  py = top + height / 2 - (y -
  /// center_y) zoom.
  void write(const Workspace& workspace, const PartsState& parts);

 private:
  Path path_;
  std::string last_;
};

}  // namespace holomorph
