// Collects the rows from one file per menu. Each row gives an action's name, when it is enabled and
// what it does.
#include "edit/actions/actions.h"

#include <algorithm>

#include "core/error.h"
#include "edit/actions/groups.h"

namespace holomorph {
namespace {

std::vector<std::string> names_of(const std::vector<Shortcut>& keys) {
  std::vector<std::string> names;
  for (const Shortcut& key : keys) names.push_back(text_of(key));
  return names;
}

}  // namespace

ActionTable::ActionTable() {
  for (const auto group : {file_actions, edit_actions, cage_actions, layer_actions, time_actions,
                           view_actions, held_actions})
    for (Action& action : group()) {
      check(action.enabled, "every action says when it is enabled");
      rows_.push_back(std::move(action));
    }
  as_built_ = rows_;
}

const Action& ActionTable::named(const std::string& id) const {
  const auto found = std::ranges::find(rows_, id, &Action::id);
  check(found != rows_.end(), "the table of actions has a row with the requested id");
  return *found;
}

const Action* ActionTable::for_key(const Shortcut& key, const Workspace& workspace) const {
  for (const Action& action : rows_)
    if (std::ranges::find(action.keys, key) != action.keys.end() && action.run &&
        action.enabled(workspace))
      return &action;
  return nullptr;
}

const Action* ActionTable::owner_of(const Shortcut& key) const {
  for (const Action& action : rows_)
    if (std::ranges::find(action.keys, key) != action.keys.end()) return &action;
  return nullptr;
}

std::string ActionTable::key_of(const std::string& id) const {
  const Action& action = named(id);
  return action.keys.empty() ? "'" + action.label + "'" : text_of(action.keys[0]);
}

const std::vector<Shortcut>& ActionTable::built_in(const std::string& id) const {
  const auto found = std::ranges::find(as_built_, id, &Action::id);
  check(found != as_built_.end(), "built_in: the id of an action");
  return found->keys;
}

std::vector<std::string> ActionTable::use_keys(const KeyNames& changes) {
  std::vector<std::string> unknown;
  std::vector<std::pair<std::string, std::vector<Shortcut>>> known;
  rows_ = as_built_;
  for (const auto& [id, names] : changes) {
    if (std::ranges::find(rows_, id, &Action::id) == rows_.end()) {
      unknown.push_back(id);
      continue;
    }
    std::vector<Shortcut> keys;
    for (const std::string& name : names)
      if (const auto key = shortcut_named(name))
        keys.push_back(*key);
      else
        unknown.push_back(name);
    known.push_back({id, std::move(keys)});
  }
  // The user's choice takes precedence: a key that the user assigns is removed from the action that
  // has it by default.
  for (const auto& [id, keys] : known)
    if (named(id).keys != keys) set_keys(id, keys);
  return unknown;
}

KeyNames ActionTable::changed_keys() const {
  KeyNames changes;
  for (const Action& action : rows_)
    if (has_own_keys(action)) changes[action.id] = names_of(action.keys);
  return changes;
}

KeyNames ActionTable::all_keys() const {
  KeyNames keys;
  for (const Action& action : rows_) keys[action.id] = names_of(action.keys);
  return keys;
}

std::vector<std::string> ActionTable::set_keys(const std::string& id,
                                               const std::vector<Shortcut>& keys) {
  std::vector<std::string> unbound;
  for (Action& action : rows_) {
    if (action.id == id) continue;
    const size_t removed = std::erase_if(action.keys, [&](const Shortcut& key) {
      return std::ranges::find(keys, key) != keys.end();
    });
    if (removed > 0) unbound.push_back(action.label);
  }
  const auto found = std::ranges::find(rows_, id, &Action::id);
  check(found != rows_.end(), "set_keys: the id of an action");
  found->keys = keys;
  return unbound;
}

std::vector<std::string> ActionTable::reset_keys(const std::string& id) {
  return set_keys(id, built_in(id));
}

void run(const Action& action, Workspace& workspace) {
  if (!action.run || !action.enabled(workspace)) return;
  try {
    action.run(workspace);
  } catch (const Error& error) {
    workspace.messages.complain(error);
  }
}

void run(const std::string& id, Workspace& workspace) {
  run(workspace.actions.named(id), workspace);
}

std::string label_with_keys(const Action& action) {
  if (action.keys.empty()) return action.label;
  return action.label + " (" + text_of(action.keys[0]) + ")";
}

}  // namespace holomorph
