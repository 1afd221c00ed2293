// The one table of actions: menus, toolbar, tooltips, keys, help and tests all read it.
#pragma once

#include "edit/input.h"
#include "scene/preferences.h"

namespace holomorph {

struct Workspace;

/// A row of the table. Rows name their fields; what is missing has the default.
struct Action {
  std::string id, label;
  const char* hint = "";  ///< what it does, where the label does not say all of it
  const char* icon = "";  ///< a glyph of the icon font
  const char* menu = "";  ///< the menu that lists it
  std::vector<Shortcut> keys = {};
  bool (*enabled)(const Workspace&) = nullptr;
  void (*run)(Workspace&) = nullptr;            ///< null for what a key does while it is held
  bool (*checked)(const Workspace&) = nullptr;  ///< for what can be on or off
  bool during_gesture = false;                  ///< its keys also act while a tool is in use
};

/// The rows in menu order, with the keys in use: those that the program was built with, and the
/// user's changes to them. A value that a workspace owns.
class ActionTable {
 public:
  /// With the built-in keys.
  ActionTable();

  const std::vector<Action>& rows() const { return rows_; }
  /// The action of this id; it must exist.
  const Action& named(const std::string& id) const;
  /// The enabled action that a key press runs; null without one.
  const Action* for_key(const Shortcut& key, const Workspace& workspace) const;
  /// The action that has a key, whether it is enabled or not; null without one.
  const Action* owner_of(const Shortcut& key) const;
  /// How a sentence names an action: by its key, or by its label in quotes where it has none.
  std::string key_of(const std::string& id) const;

  /// Gives all actions their built-in keys except for these changes. Changes that name no action or
  /// no key are left out and returned.
  std::vector<std::string> use_keys(const KeyNames& changes);
  /// The keys that differ from the built-in ones, and all of them.
  KeyNames changed_keys() const;
  KeyNames all_keys() const;
  /// Gives an action exactly these keys and removes them from all others. Returns the labels of
  /// those that lost one.
  std::vector<std::string> set_keys(const std::string& id, const std::vector<Shortcut>& keys);
  /// Gives an action its built-in keys again; the same otherwise.
  std::vector<std::string> reset_keys(const std::string& id);
  bool has_own_keys(const Action& action) const { return action.keys != built_in(action.id); }

 private:
  const std::vector<Shortcut>& built_in(const std::string& id) const;

  std::vector<Action> rows_, as_built_;
};

/// Runs an enabled action; an Error becomes a toast.
void run(const Action& action, Workspace& workspace);
/// The same for the action of this id.
void run(const std::string& id, Workspace& workspace);
/// "Undo (Ctrl+Z)".
std::string label_with_keys(const Action& action);

}  // namespace holomorph
