// The texts of the keys window and of its export.
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
      {"Drag a point or pin", "move it; with Shift, along one axis"},
      {"Drag on empty canvas", "select with a box; with Shift, add to the selection"},
      {"Double-click an edge", "insert a cage point"},
      {"Alt-click a point, pin or stroke", "delete it"},
      {"Drag the box around the selection",
       "inside, move; a grip, scale; the knob, rotate. With Shift, scale freely or rotate in steps "
       "of 15 degrees; with Alt, scale about the middle"},
      {"Ctrl-drag points, pins, strokes, rings, arms or edges",
       "record their motion in real time as keyframes"},
      {"Ctrl-drag the ring of a pin outward", "enlarge the disk that the pin holds"},
      {"Ctrl-click a cage point",
       "make it smooth or a corner; drag its tangents to bend the curve; with Alt, one at a time"},
      {"Drag the ring of a selected pin",
       "rotate the picture around it; with Shift, in steps of 15 degrees"},
      {"Wheel on the ring", "scale the picture around the pin"},
      {"Drag a stroke", "move it; at an end or with Ctrl, bend it"},
      {"Shift-drag with a stroke selected", "draw the stroke again"},
      {"Drag the outline (outline tool)", "bend it; with Ctrl, move all of it"},
      {"Drag a corner's ring or arm (angle tool)",
       "turn the corner, or open and close it; with Shift, in steps of 15 degrees"},
      {"Drag an edge (angle tool)", "downward, let it bend; upward, keep it straight"},
      {"Drag the timeline's ruler", "go to a time; with Alt, between frames"},
      {"Wheel on the timeline's ruler", "zoom in time; with Shift, pan; double-click to see all"},
      {"Drag keyframes", "move them; with Alt, between frames; with Ctrl, copy them"},
      {"Drag in the timeline's rows", "select keyframes with a box; with Shift, add to them"},
      {"Drag a bar of the keyframes' box", "stretch their time"},
      {"Drag a film on the timeline", "move it; at its ends, trim it; with Alt, between frames"},
      {"Drag with the middle button or Space", "pan"},
      {"Wheel", "zoom at the pointer"},
      {"Right-click", "open the menu of what is under the pointer"},
      {"Ctrl-click a number field", "type into it"},
      {"Enter, Backspace, Esc", "while drawing: close the shape, remove the last point, cancel"}};
  return all;
}

namespace {

/// The text as Markdown code, with vertical bars escaped because they would end the cell.
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
