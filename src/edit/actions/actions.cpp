// The table is made of one file for each menu, in `actions/`. Each row is a sentence: what it is
// called, when it can be done, what it does.
#include "edit/actions/actions.h"

#include "core/error.h"
#include "edit/actions/groups.h"

namespace holomorph {

std::vector<Action> actions_as_built() {
  std::vector<Action> rows;
  for (const auto group : {file_actions, edit_actions, cage_actions, layer_actions, time_actions,
                           view_actions, held_actions})
    for (Action& action : group()) rows.push_back(std::move(action));
  return rows;
}

std::vector<Action>& mutable_actions() {
  static std::vector<Action> all = actions_as_built();
  return all;
}

const std::vector<Action>& actions() {
  return mutable_actions();
}

const Action& action_named(const std::string& id) {
  for (const Action& action : actions())
    if (action.id == id) return action;
  check(false, "an action is asked for that the table does not have");
  return actions()[0];
}

const Action* action_for(const Shortcut& shortcut, const Workspace& workspace) {
  for (const Action& action : actions())
    for (const Shortcut& key : action.keys)
      if (key == shortcut && action.run && action.enabled(workspace)) return &action;
  return nullptr;
}

void run(const Action& action, Workspace& workspace) {
  if (!action.run || !action.enabled(workspace)) return;
  try {
    action.run(workspace);
  } catch (const Error& error) {
    workspace.messages.complain(error);
  }
}

std::string label_with_keys(const Action& action) {
  if (action.keys.empty()) return action.label;
  return action.label + " (" + text_of(action.keys[0]) + ")";
}

std::string key_of(const std::string& id) {
  const Action& action = action_named(id);
  return action.keys.empty() ? "'" + action.label + "'" : text_of(action.keys[0]);
}

}  // namespace holomorph
