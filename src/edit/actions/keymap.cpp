// The table in use is the one of actions(); the one that the program was built with is kept beside
// it.
#include "edit/actions/keymap.h"

#include <algorithm>

namespace holomorph {
namespace {

const std::vector<Shortcut>& own_keys(const std::string& id) {
  static const std::vector<Action> table = actions_as_built();
  return std::ranges::find(table, id, &Action::id)->keys;
}

std::vector<std::string> names_of(const std::vector<Shortcut>& keys) {
  std::vector<std::string> names;
  for (const Shortcut& key : keys) names.push_back(text_of(key));
  return names;
}

}  // namespace

std::vector<std::string> use_keys(const KeyNames& changes) {
  std::vector<std::string> unknown;
  std::vector<std::pair<std::string, std::vector<Shortcut>>> wanted;
  for (Action& action : mutable_actions()) action.keys = own_keys(action.id);
  for (const auto& [id, names] : changes) {
    const auto action = std::ranges::find(mutable_actions(), id, &Action::id);
    if (action == mutable_actions().end()) {
      unknown.push_back(id);
      continue;
    }
    std::vector<Shortcut> keys;
    for (const std::string& name : names)
      if (const auto key = shortcut_named(name))
        keys.push_back(*key);
      else
        unknown.push_back(name);
    wanted.push_back({id, std::move(keys)});
  }
  // What is changed is meant: a key that the table gives to another action is lost there.
  for (const auto& [id, keys] : wanted)
    if (action_named(id).keys != keys) set_keys(id, keys);
  return unknown;
}

KeyNames changed_keys() {
  KeyNames changes;
  for (const Action& action : actions())
    if (has_own_keys(action)) changes[action.id] = names_of(action.keys);
  return changes;
}

KeyNames all_keys() {
  KeyNames keys;
  for (const Action& action : actions()) keys[action.id] = names_of(action.keys);
  return keys;
}

std::vector<std::string> set_keys(const std::string& id, const std::vector<Shortcut>& keys) {
  std::vector<std::string> robbed;
  for (Action& action : mutable_actions()) {
    if (action.id == id) continue;
    const size_t taken = std::erase_if(action.keys, [&](const Shortcut& key) {
      return std::ranges::find(keys, key) != keys.end();
    });
    if (taken > 0) robbed.push_back(action.label);
  }
  std::ranges::find(mutable_actions(), id, &Action::id)->keys = keys;
  return robbed;
}

std::vector<std::string> reset_keys(const std::string& id) {
  return set_keys(id, own_keys(id));
}

bool has_own_keys(const Action& action) {
  return action.keys != own_keys(action.id);
}

const Action* owner_of(const Shortcut& key) {
  for (const Action& action : actions())
    if (std::ranges::find(action.keys, key) != action.keys.end()) return &action;
  return nullptr;
}

std::string keys_text(const Action& action) {
  std::string text;
  for (const Shortcut& key : action.keys) {
    Shortcut plain = key;
    plain.mods.shift = false;
    const bool named = key.mods.shift && key.key < 'A' &&
                       std::ranges::find(action.keys, plain) != action.keys.end();
    if (!named) text += (text.empty() ? "" : ", ") + text_of(key);
  }
  return text;
}

const std::vector<Gesture>& gestures() {
  static const std::vector<Gesture> all{
      {"Drag a point or pin", "move it; Shift keeps the axis"},
      {"Drag on empty canvas", "select with a box; Shift adds"},
      {"Double-click an edge", "insert a cage point"},
      {"Alt-click a point or pin", "delete it"},
      {"Drag the box of what is selected",
       "inside it moves, its grips scale, the knob turns; Shift free or 15 degrees, Alt from the "
       "middle"},
      {"Ctrl-drag points, pins, strokes", "record their motion as keyframes, by the clock"},
      {"Ctrl-click a cage point", "smooth or corner; drag its tangents, Alt breaks them"},
      {"Drag the ring of a selected pin", "turn the picture around it; Shift: 15 degree steps"},
      {"Wheel on the ring", "scale the picture around the pin"},
      {"Drag a stroke", "move it; at an end, or with Ctrl, bend it"},
      {"Shift-drag with a stroke selected", "draw its new place"},
      {"Drag the outline (outline tool)", "bend it; with Ctrl move all of it"},
      {"Drag a corner's ring or arm (angle tool)",
       "turn it; open or shut it; Shift: 15 degree steps"},
      {"Drag an edge (angle tool)", "let it bend, or keep it straight"},
      {"Drag on the timeline", "go to a time; move a key, Alt between frames"},
      {"Middle drag, Space-drag", "pan"},
      {"Wheel", "zoom at the cursor"},
      {"Right click", "menu of what is under the cursor"},
      {"Ctrl-click a number field", "type into it"},
      {"Enter, Backspace, Esc", "while drawing: close, take a point back, cancel"}};
  return all;
}

namespace {

/// As code, a bar being no border of the table.
std::string table_cell(const std::string& text) {
  std::string cell = "`";
  for (const char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell + "`";
}

}  // namespace

std::string keys_markdown() {
  std::string text = "| Mouse | |\n|---|---|\n";
  for (const Gesture& gesture : gestures())
    text += std::string("| ") + gesture.what + " | " + gesture.does + " |\n";
  text += "\n| Keys | |\n|---|---|\n";
  for (const Action& action : actions())
    if (!action.keys.empty())
      text += "| " + table_cell(keys_text(action)) + " | " + action.label + " |\n";
  return text;
}

}  // namespace holomorph
