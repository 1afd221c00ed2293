// What the editor is drawn on: receives input, makes frames, and sleeps when idle. `Window` is the
// screen that people see. Tests use one that draws nothing.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "edit/input.h"
#include "scene/preferences.h"
#include "system/file.h"

namespace holomorph {

struct KeyPress {
  Shortcut key;
  bool repeats = false;  ///< sent by auto-repeat while the key is held
};

/// Passes input to ImGui, a frame at a time. Owns the ImGui context, so there can be one screen at
/// a time.
class Screen {
 public:
  Screen();
  virtual ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// Waits until a frame must be drawn, but at most `longest` seconds. Returns whether to draw one.
  /// Each event and each call of wake() causes several frames.
  bool wait(double longest);
  /// Makes wait() return. May be called from any thread.
  void wake();
  /// Holds input in the next frame, in order and with the positions where it happened: all of it,
  /// or from the first press of the left button on for which `waits` is true. The pointer already
  /// is where that press happened.
  void hold(bool all, std::function<bool(Complex px)> waits);
  /// Whether input was held in the last frame.
  bool holds() const { return held_back_; }
  /// Whether Escape is among the input that is held.
  bool holds_escape() const;
  /// Forgets the input that is held. Keys and buttons that were released meanwhile are up.
  void discard_held();
  /// The positions of the presses of the left button that are held.
  Points held_presses() const;
  /// Starts a frame of the user interface. The caller then draws until end_frame(). Each frame
  /// handles at most one press or release of a mouse button, at the position where it happened,
  /// even if frames are slow. With `navigates`, the arrow keys, Tab, Space and Enter operate the
  /// dialog or panel that has ImGui's focus. If Enter or Space is already held, navigation starts
  /// when it is released.
  void begin_frame(bool navigates);
  void end_frame();

  /// Sets fonts and sizes for a scale (0: the display's scale) and the colors of a theme.
  void set_style(double ui_scale, Theme theme, bool reduce_motion);
  double scale() const { return scale_; }
  Theme theme() const { return theme_; }

  /// Key presses since the last call.
  std::vector<KeyPress> take_keys();
  /// Files dropped on the window since the last call.
  std::vector<Path> take_drops();
  /// Whether the user has tried to close the window since the last call. The window stays open
  /// until the program closes it.
  bool take_close();
  /// Whether a key is held. Keys are identified by the character that the keyboard layout prints.
  bool is_down(const Shortcut& key) const;
  /// Whether events are queued for later frames.
  bool has_events() const { return !events_.empty(); }
  /// Number of presses and releases of keys and mouse buttons handled so far.
  int taken() const { return taken_; }
  /// With `held`, Alt counts as held from the next frame on, even if the key is not pressed.
  void set_alt_override(bool held) { alt_ = held; }
  bool alt_override() const { return alt_; }

  /// Milliseconds on a clock that never jumps.
  virtual double now_ms() const = 0;
  virtual void set_title(const std::string& title) = 0;
  /// In window px.
  virtual int width() const = 0;
  virtual int height() const = 0;
  virtual int framebuffer_width() const = 0;
  virtual int framebuffer_height() const = 0;

 protected:
  struct Event {
    enum class Type { move, button, key, character, scroll } kind;
    double x = 0, y = 0;  ///< pointer position in window px, or scrolled lines
    int code = 0, scancode = 0, action = 0, mods = 0;  ///< as GLFW has them
  };
  void add(const Event& event);
  void add_drop(const Path& path);
  void ask_to_close();
  /// The display's scale may have changed.
  void moved_to_display();

 private:
  /// Calls `add` for the events that have arrived. Waits for the first one at most `longest`
  /// seconds, or until `interrupt` is called, on any thread.
  virtual void poll(double longest) = 0;
  virtual void interrupt() = 0;
  /// Sets ImGui's sizes and time for the next frame.
  virtual void begin_drawing() = 0;
  virtual void present() = 0;
  virtual double display_scale() const = 0;
  virtual void upload_fonts() = 0;
  /// The character that a key prints in the user's keyboard layout, or 0.
  virtual char character_on(int key, int scancode) const = 0;

  int printed_key(int key, int scancode) const;
  void pump_events();
  static bool is_left_press(const Event& event);
  bool waits(const Event& event);
  void take_key(const Event& event);
  void queue_character(unsigned code);

  std::atomic<bool> woken_{false};
  int owed_frames_ = 3, taken_ = 0;
  double frame_start_ = 0, frame_seconds_ = 0;  ///< of the last frame
  double scale_ = 1, wanted_scale_ = 0;
  bool reduce_motion_ = false;
  Theme theme_ = Theme::dark;
  bool alt_ = false, close_ = false, moved_display_ = false;
  bool tab_was_held_ = false, tab_is_meant_ = false;  ///< meant: for a text field or to navigate
  bool enter_activates_ = false;         ///< Enter is held and was pressed outside a text field
  bool held_before_navigation_ = false;  ///< Enter or Space was already held when navigation began
  std::vector<KeyPress> keys_;
  std::map<int, int> held_;  ///< GLFW code of each held key -> the character printed on it
  std::deque<Event> events_;
  bool holds_all_ = false, held_back_ = false;
  std::function<bool(Complex px)> press_waits_;
  double mouse_x_ = -1e9, mouse_y_ = -1e9;
  bool mouse_down_[3] = {false, false, false};
  std::vector<Path> drops_;
};

}  // namespace holomorph
