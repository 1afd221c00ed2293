// The window "Keys and mouse" (F1), in which the user finds, changes, exports and imports keys.
#pragma once

#include "app/dialogs/file_chooser.h"
#include "edit/actions/keymap.h"

namespace holomorph {

class KeysWindow {
 public:
  /// `changed` is called when keys have changed.
  KeysWindow(Workspace& workspace, FileChooser& chooser, std::function<void()> changed)
      : workspace_(workspace), chooser_(chooser), changed_(std::move(changed)) {}

  void show() { open_ = opening_ = true; }
  bool open() const { return open_; }
  /// Whether the next key is to be assigned to an action.
  bool waits_for_key() const { return !waiting_.empty(); }
  /// Assigns a key. If the key belongs to another action, it must be pressed twice.
  void take(const Shortcut& key);
  void draw();

 private:
  void draw_row(const Action& action);
  /// Both functions return whether anything matches the search.
  bool draw_keys();
  bool draw_gestures();
  void export_keys();
  void import_keys();
  void assign(const std::vector<Shortcut>& keys);
  void stop_waiting();
  void report_lost_keys(const std::vector<std::string>& labels);

  Workspace& workspace_;
  FileChooser& chooser_;
  std::function<void()> changed_;
  std::string search_, waiting_;         ///< waiting_: id of the action whose key is being chosen
  bool adds_key_ = false;                ///< the new key is added to the action's present keys
  std::optional<Shortcut> pending_key_;  ///< belongs to another action; must be pressed again
  bool open_ = false, opening_ = false, was_waiting_ = false;
};

}  // namespace holomorph
