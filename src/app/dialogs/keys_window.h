// Keys and mouse (F1): searched, changed and exchanged.
#pragma once

#include "app/dialogs/file_chooser.h"
#include "edit/actions/keymap.h"

namespace holomorph {

class KeysWindow {
 public:
  /// `changed` is called when the keys are other ones.
  KeysWindow(Workspace& workspace, FileChooser& chooser, std::function<void()> changed)
      : workspace_(workspace), chooser_(chooser), changed_(std::move(changed)) {}

  void show() { open_ = opening_ = true; }
  bool open() const { return open_; }
  /// Whether the next key is to be an action's, and takes it.
  bool waits_for_key() const { return !waiting_.empty(); }
  /// A key that is another action's has to be pressed twice.
  void take(const Shortcut& key);
  void draw(double scale);

 private:
  void draw_row(const Action& action, float s);
  /// Each returns whether it has found anything.
  bool draw_keys(float s);
  bool draw_gestures(float s);
  void export_keys();
  void import_keys();
  void assign(const std::vector<Shortcut>& keys);
  void stop_waiting();
  void say_lost(const std::vector<std::string>& labels);

  Workspace& workspace_;
  FileChooser& chooser_;
  std::function<void()> changed_;
  std::string search_, waiting_;   ///< the action whose key is being chosen
  bool adds_ = false;              ///< to the keys that it has
  std::optional<Shortcut> asked_;  ///< another action's key, to be pressed once more
  bool open_ = false, opening_ = false, was_waiting_ = false;
};

}  // namespace holomorph
