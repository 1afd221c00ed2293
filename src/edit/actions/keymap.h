// The keys of actions as the user wants them: changes to the action table's own.
#pragma once

#include "edit/actions/actions.h"
#include "scene/preferences.h"

namespace holomorph {

/// Gives all actions the table's keys but for these. What names no action or no key is left out;
/// returns those.
std::vector<std::string> use_keys(const KeyNames& changes);
/// The keys that differ from the table's own, and all of them.
KeyNames changed_keys();
KeyNames all_keys();

/// Gives an action these keys alone and takes them from all others. Returns the labels of those
/// that have lost one.
std::vector<std::string> set_keys(const std::string& id, const std::vector<Shortcut>& keys);
/// Gives an action the table's keys again.
std::vector<std::string> reset_keys(const std::string& id);
bool has_own_keys(const Action& action);
/// The action that has a key, whether it can be done now or not; null without one.
const Action* owner_of(const Shortcut& key);

/// "Ctrl+Shift+Z, Ctrl+Y"; signs that are reached with and without Shift are named once.
std::string keys_text(const Action& action);

/// A mouse gesture in words: what to do, and what it does.
struct Gesture {
  const char *what, *does;
};
const std::vector<Gesture>& gestures();

/// All keys and gestures as a Markdown table.
std::string keys_markdown();

}  // namespace holomorph
