// The table of actions. Menus (menus.h), toolbar, tooltips, keys, help and tests all read it.
#pragma once

#include "edit/input.h"
#include "scene/preferences.h"

namespace holomorph {

struct Workspace;

/// A row of the table. Rows name the fields that they set; the others keep their defaults.
struct Action {
  std::string id, label;
  const char* hint = "";  ///< for the tooltip; empty if the label says everything
  const char* icon = "";  ///< a glyph of the icon font; empty: none
  std::vector<Shortcut> keys = {};
  const char* needs = "";  ///< for the tooltip while it is disabled; empty if it never is
  bool (*enabled)(const Workspace&) = nullptr;  ///< required; `always` if there is no condition
  void (*run)(Workspace&) = nullptr;            ///< null for actions that last while a key is held
  bool (*checked)(const Workspace&) = nullptr;  ///< null for actions that cannot be on or off
  bool during_gesture = false;                  ///< its keys also work during a tool's gesture
};

/// The rows with their current keys: the built-in keys with the user's changes. Value
/// type, owned by a workspace.
class ActionTable {
 public:
  /// The table with the built-in keys.
  ActionTable();

  const std::vector<Action>& rows() const { return rows_; }
  /// The action with this id, which must exist.
  const Action& named(const std::string& id) const;
  /// The enabled action that a key press runs; null if there is none.
  const Action* for_key(const Shortcut& key, const Workspace& workspace) const;
  /// The action that has this key, enabled or not; null if there is none.
  const Action* owner_of(const Shortcut& key) const;
  /// How messages refer to an action: by its first key, or by its label in quotes if it has no key.
  std::string key_of(const std::string& id) const;

  /// Resets all keys to the built-in ones and applies these changes. Skips and returns names that
  /// are not a known action or key.
  std::vector<std::string> use_keys(const KeyNames& changes);
  /// The keys of the actions whose keys differ from the built-in ones.
  KeyNames changed_keys() const;
  /// The keys of all actions.
  KeyNames all_keys() const;
  /// Sets the keys of an action and removes them from all other actions. Returns the labels of the
  /// actions that lost a key.
  std::vector<std::string> set_keys(const std::string& id, const std::vector<Shortcut>& keys);
  /// Resets the keys of an action to the built-in ones. Calls set_keys and returns its result.
  std::vector<std::string> reset_keys(const std::string& id);
  bool has_own_keys(const Action& action) const { return action.keys != built_in(action.id); }

 private:
  const std::vector<Shortcut>& built_in(const std::string& id) const;

  std::vector<Action> rows_, as_built_;
};

/// Runs an action if it is enabled. An Error becomes a toast.
void run(const Action& action, Workspace& workspace);
/// Runs the action with this id in the same way.
void run(const std::string& id, Workspace& workspace);
/// The label and the first key, such as "Undo (Ctrl+Z)".
std::string label_with_keys(const Action& action);

}  // namespace holomorph
