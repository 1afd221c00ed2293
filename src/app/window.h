// The GLFW window and ImGui's life in it: events in, frames out, sleep when nothing happens.
#pragma once

#include <atomic>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "edit/input.h"
#include "scene/preferences.h"
#include "system/file.h"

struct GLFWwindow;

namespace holomorph {

struct KeyPress {
  Shortcut key;
  bool repeats = false;  ///< because it is held
};

/// Owns the window, its OpenGL context and ImGui. Throws Error{failed} without a display or
/// OpenGL 3.3.
class Window {
 public:
  Window(int width, int height, double ui_scale, Theme theme);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Waits until there is something to draw: an event, a wake(), or a frame that is owed after one;
  /// at most `longest` seconds. Returns whether a frame should be drawn.
  bool wait(double longest);
  /// From any thread: makes wait() return.
  void wake();
  /// Starts and ends a frame of the user interface; draw with OpenGL in between. A frame sees at
  /// most one change of the mouse buttons, at the place where it happened, however slow frames are.
  /// In a frame that `navigates`, arrows, Tab, Space and Enter go through the items of the dialog
  /// or panel that has ImGui's focus; Enter and Space once they were let go of.
  void begin_frame(bool navigates);
  void end_frame();

  /// Fonts and sizes for a scale (0: the display's) and colours for a theme.
  void set_style(double ui_scale, Theme theme);
  double scale() const { return scale_; }
  Theme theme() const { return theme_; }

  /// Key presses since the last call.
  std::vector<KeyPress> take_keys();
  /// Files dropped on the window since the last call.
  std::vector<Path> take_drops();
  /// Whether the user asked to close the window; asked once, answered by the program.
  bool take_close();
  /// Whether a key is held, by what the layout prints on it.
  bool is_down(const Shortcut& key) const;
  /// Whether events wait for later frames.
  bool has_events() const { return !events_.empty(); }
  /// How often keys and buttons have gone down or up so far.
  int taken() const { return taken_; }
  /// Whether Alt counts as held from the next frame on, besides when it is.
  void stand_in_for_alt(bool held) { alt_ = held; }
  bool stands_in_for_alt() const { return alt_; }
  void set_title(const std::string& title);

  int width() const;  ///< in window px
  int height() const;
  int framebuffer_width() const;
  int framebuffer_height() const;

 private:
  struct Event {
    enum class Type { move, button, key, character, scroll } kind;
    double x = 0, y = 0;  ///< the pointer in window px, or scrolled lines
    int code = 0, scancode = 0, action = 0, mods = 0;
  };
  void add(const Event& event);
  /// The pointer in window px, as the events so far have it.
  std::pair<double, double> pointer() const;
  void pump_events();
  void take_key(const Event& event);
  void take_character(unsigned code);

  GLFWwindow* window_ = nullptr;
  std::atomic<bool> woken_{false};
  int owed_frames_ = 3, taken_ = 0;
  double scale_ = 1, wanted_scale_ = 0;
  Theme theme_ = Theme::dark;
  bool alt_ = false, close_ = false, moved_display_ = false;
  bool enter_activates_ = false;  ///< held since it was pressed outside a text field
  bool held_over_ = false;        ///< Enter or Space, since before frames navigate
  std::vector<KeyPress> keys_;
  std::map<int, int> held_;  ///< GLFW's code of each key that is down, and what is printed on it
  std::deque<Event> events_;
  std::optional<std::pair<double, double>> pointer_;  ///< in window px, at the last event
  double mouse_x_ = -1e9, mouse_y_ = -1e9;
  bool mouse_down_[3] = {false, false, false};
  std::vector<Path> drops_;
};

/// Whether a window can be opened at all (a display is set).
bool has_display();

}  // namespace holomorph
