// What the keys window and its export say.
#include "edit/actions/keymap.h"

#include <algorithm>

namespace holomorph {

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

std::string keys_markdown(const ActionTable& actions) {
  std::string text = "| Mouse | |\n|---|---|\n";
  for (const Gesture& gesture : gestures())
    text += std::string("| ") + gesture.what + " | " + gesture.does + " |\n";
  text += "\n| Keys | |\n|---|---|\n";
  for (const Action& action : actions.rows())
    if (!action.keys.empty())
      text += "| " + table_cell(keys_text(action)) + " | " + action.label +
              (*action.hint ? std::string(": ") + action.hint : "") + " |\n";
  return text;
}

}  // namespace holomorph
