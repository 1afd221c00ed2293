// The one table of actions: menus, toolbar, tooltips, keys, help and tests all read it.
#pragma once

#include "edit/input.h"
#include "edit/workspace.h"

namespace holomorph {

struct Action {
  std::string id, label;
  const char* icon;  ///< a glyph of the icon font, or ""
  const char* menu;  ///< the menu that lists it
  std::vector<Shortcut> keys;
  bool (*enabled)(const Workspace&);
  void (*run)(Workspace&);                      ///< null for what a key does while it is held
  bool (*checked)(const Workspace&) = nullptr;  ///< for what can be on or off
};

/// The table, in menu order, with the keys in use; see keymap.h.
const std::vector<Action>& actions();
std::vector<Action>& mutable_actions();
/// The table with its own keys.
std::vector<Action> actions_as_built();
/// The action of this id; it must exist.
const Action& action_named(const std::string& id);
/// The enabled action that a key press runs, if any.
const Action* action_for(const Shortcut& shortcut, const Workspace& workspace);
/// Runs an enabled action; an Error becomes a toast.
void run(const Action& action, Workspace& workspace);
/// "Undo (Ctrl+Z)".
std::string label_with_keys(const Action& action);
/// How a sentence names an action: by its key, or by its label in quotes where it has none.
std::string key_of(const std::string& id);

}  // namespace holomorph
