// Events wait in a queue. Three frames follow each event, because ImGui needs two to settle a
// layout.
#include "app/screen.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "app/look/imgui_versions.h"
#include "app/look/items.h"
#include "app/look/theme.h"

namespace holomorph {
namespace {

constexpr int kFramesPerEvent = 3;

}  // namespace

Screen::Screen() {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.ConfigDragClickToInputText = true;
  set_up_input(io);
}

Screen::~Screen() {
  ImGui::DestroyContext();
}

/// The key code of the character that a physical key prints.
int Screen::printed_key(int key, int scancode) const {
  switch (key) {
    case GLFW_KEY_TAB:
      return static_cast<int>(Key::tab);
    case GLFW_KEY_ESCAPE:
      return static_cast<int>(Key::escape);
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return static_cast<int>(Key::enter);
    case GLFW_KEY_BACKSPACE:
      return static_cast<int>(Key::backspace);
    case GLFW_KEY_DELETE:
      return static_cast<int>(Key::del);
    case GLFW_KEY_LEFT:
      return static_cast<int>(Key::left);
    case GLFW_KEY_RIGHT:
      return static_cast<int>(Key::right);
    case GLFW_KEY_UP:
      return static_cast<int>(Key::up);
    case GLFW_KEY_DOWN:
      return static_cast<int>(Key::down);
    case GLFW_KEY_PAGE_UP:
      return static_cast<int>(Key::page_up);
    case GLFW_KEY_PAGE_DOWN:
      return static_cast<int>(Key::page_down);
    case GLFW_KEY_HOME:
      return static_cast<int>(Key::home);
    case GLFW_KEY_END:
      return static_cast<int>(Key::end);
    case GLFW_KEY_INSERT:
      return static_cast<int>(Key::insert);
    case GLFW_KEY_SPACE:
      return static_cast<int>(Key::space);
    default:
      break;
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12)
    return static_cast<int>(Key::f1) + key - GLFW_KEY_F1;
  // Keys of the number row count as digits, even in French layouts, which need Shift for digits.
  // Keys that print letters of other alphabets keep GLFW's code.
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return key;
  if (const char printed = character_on(key, scancode))
    return std::toupper(static_cast<unsigned char>(printed));
  return key > ' ' && key < 127 ? key : 0;
}

void Screen::set_style(double ui_scale, Theme theme, bool reduce_motion) {
  wanted_scale_ = ui_scale;
  scale_ = ui_scale > 0 ? ui_scale : std::clamp(display_scale(), 0.75, 4.0);
  theme_ = theme;
  reduce_motion_ = reduce_motion;
  if (apply_theme(scale_, theme, reduce_motion)) upload_fonts();
  wake();
}

bool Screen::wait(double longest) {
  poll(owed_frames_ > 0 ? 0 : longest);
  if (woken_.exchange(false)) owed_frames_ = kFramesPerEvent;
  if (owed_frames_ <= 0) return false;
  --owed_frames_;
  return true;
}

void Screen::wake() {
  woken_ = true;
  interrupt();
}

void Screen::begin_frame(bool navigates) {
  if (std::exchange(moved_display_, false)) set_style(wanted_scale_, theme_, reduce_motion_);
  begin_drawing();
  pump_events();
  ImGuiIO& io = ImGui::GetIO();
  const bool presses = is_down(Key::enter) || is_down(Key::space);
  held_before_navigation_ = presses && (held_before_navigation_ || !navigates);
  if (!navigates) enter_activates_ = false;
  navigates = navigates && !held_before_navigation_;
  io.ConfigFlags = navigates ? ImGuiConfigFlags_NavEnableKeyboard : ImGuiConfigFlags_None;
  const auto held = [&](int left, int right) {
    return held_.contains(left) || held_.contains(right);
  };
  HeldModifiers modifiers;
  modifiers.ctrl = held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
  modifiers.shift = held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
  modifiers.alt = held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT) || alt_;
  modifiers.super = held(GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER);
  send_modifiers(io, modifiers);
  // ImGui gets Tab while the user types into a field or navigates. Otherwise actions get it.
  const bool tab = held_.contains(GLFW_KEY_TAB);
  if (tab && !tab_was_held_) tab_is_meant_ = (io.WantTextInput || navigates) && !modifiers.ctrl;
  tab_was_held_ = tab;
  send_key(io, GLFW_KEY_TAB, tab && tab_is_meant_);
  // ImGui itself activates buttons only with Space. This adds Enter.
  if (navigates && enter_activates_) activate_item(io);
  // The second press comes two frames after the first at the earliest, which may be slow ones. The
  // time between frames would not do, because the window sleeps there.
  constexpr double kDoubleClickSeconds = 0.45;
  io.MouseDoubleClickTime = static_cast<float>(kDoubleClickSeconds + 2 * frame_seconds_);
  frame_start_ = now_ms();
  ImGui::NewFrame();
  ImGui::PushItemFlag(ImGuiItemFlags_NoTabStop, true);  // see TabStop
  advance_theme();
  forget_item_boxes();
}

void Screen::end_frame() {
  ImGui::PopItemFlag();
  ImGui::Render();
  present();
  frame_seconds_ = (now_ms() - frame_start_) / 1000;
}

void Screen::add(const Event& event) {
  events_.push_back(event);
  wake();
}
void Screen::add_drop(const Path& path) {
  drops_.push_back(path);
  wake();
}
void Screen::ask_to_close() {
  close_ = true;
  wake();
}
void Screen::moved_to_display() {
  moved_display_ = true;
  wake();
}

void Screen::hold(bool all, std::function<bool(Complex px)> waits) {
  holds_all_ = all;
  press_waits_ = std::move(waits);
}

bool Screen::is_left_press(const Event& event) {
  return event.kind == Event::Type::button && event.code == GLFW_MOUSE_BUTTON_LEFT &&
         event.action == GLFW_PRESS;
}

bool Screen::waits(const Event& event) {
  if (holds_all_) return true;
  if (!is_left_press(event) || !press_waits_ || !press_waits_({event.x, event.y})) return false;
  // Only a frame with the pointer there tells whether the press is for the canvas.
  if (mouse_x_ != event.x || mouse_y_ != event.y) wake();
  mouse_x_ = event.x;
  mouse_y_ = event.y;
  return true;
}

bool Screen::holds_escape() const {
  return held_back_ && std::ranges::any_of(events_, [](const Event& event) {
           return event.kind == Event::Type::key && event.code == GLFW_KEY_ESCAPE &&
                  event.action == GLFW_PRESS;
         });
}

void Screen::discard_held() {
  if (!held_back_) return;
  for (const Event& event : std::exchange(events_, {})) {
    if (event.action != GLFW_RELEASE) continue;
    if (event.kind == Event::Type::button && event.code < 3) mouse_down_[event.code] = false;
    if (event.kind != Event::Type::key) continue;
    held_.erase(event.code);
    send_key(ImGui::GetIO(), event.code, false);
  }
}

Points Screen::held_presses() const {
  Points positions;
  if (held_back_)
    for (const Event& event : events_)
      if (is_left_press(event)) positions.emplace_back(event.x, event.y);
  return positions;
}

/// Passes events to ImGui until a button changes, which may open or close what later events are
/// for, or until a key is released that was pressed in this frame, because ImGui must see it
/// pressed. ImGui 1.86 sees only the state at the start of a frame; on slow displays, a click
/// followed by a move would land at the later position.
void Screen::pump_events() {
  ImGuiIO& io = ImGui::GetIO();
  bool button_changed = false;
  std::vector<int> pressed;
  const auto taken = [&] {
    const Event::Type kind = events_.front().kind;
    if (kind == Event::Type::button || kind == Event::Type::key) ++taken_;
    events_.pop_front();
  };
  held_back_ = false;
  for (; !events_.empty() && !button_changed; taken()) {
    const Event& event = events_.front();
    // A key may choose another tool, or undo something.
    if (is_left_press(event) && !pressed.empty()) break;
    held_back_ = waits(event);
    if (held_back_) break;
    if (event.kind == Event::Type::move || event.kind == Event::Type::button) {
      mouse_x_ = event.x;
      mouse_y_ = event.y;
      if (event.kind == Event::Type::move) continue;
      button_changed = true;
      if (event.code < 3) mouse_down_[event.code] = event.action == GLFW_PRESS;
    } else if (event.kind == Event::Type::key) {
      if (event.action == GLFW_RELEASE &&
          std::find(pressed.begin(), pressed.end(), event.code) != pressed.end())
        break;
      if (event.action != GLFW_RELEASE) pressed.push_back(event.code);
      if (event.code == GLFW_KEY_ENTER || event.code == GLFW_KEY_KP_ENTER)
        enter_activates_ = event.action == GLFW_PRESS    ? !ImGui::IsAnyItemActive()
                           : event.action == GLFW_REPEAT ? enter_activates_
                                                         : false;
      if (event.action == GLFW_RELEASE)
        held_.erase(event.code);
      else
        held_[event.code] = printed_key(event.code, event.scancode);
      if (event.code != GLFW_KEY_TAB) send_key(io, event.code, event.action != GLFW_RELEASE);
      take_key(event);
    } else if (event.kind == Event::Type::character) {
      io.AddInputCharacter(static_cast<unsigned>(event.code));
      queue_character(static_cast<unsigned>(event.code));
    } else {
      send_wheel(io, event.x, event.y);
    }
  }
  if (!events_.empty() && !held_back_) wake();
  send_pointer(io, {static_cast<float>(mouse_x_),
                    static_cast<float>(mouse_y_),
                    {mouse_down_[0], mouse_down_[1], mouse_down_[2]}});
}

void Screen::take_key(const Event& event) {
  if (event.action == GLFW_RELEASE) return;
  const int printed = printed_key(event.code, event.scancode);
  const bool ctrl = (event.mods & GLFW_MOD_CONTROL) != 0;
  // Without Ctrl, + and ? are handled as characters, so it does not matter which keys print them.
  if (printed == 0 || (!ctrl && (printed == '+' || printed == '?'))) return;
  Shortcut shortcut;
  shortcut.key = printed;
  shortcut.mods = {ctrl, (event.mods & GLFW_MOD_SHIFT) != 0, (event.mods & GLFW_MOD_ALT) != 0};
  keys_.push_back({shortcut, event.action == GLFW_REPEAT});
}

void Screen::queue_character(unsigned code) {
  if (code == '?' || code == '+') keys_.push_back({Shortcut(static_cast<char>(code)), false});
}

std::vector<KeyPress> Screen::take_keys() {
  return std::exchange(keys_, {});
}
std::vector<Path> Screen::take_drops() {
  return std::exchange(drops_, {});
}
bool Screen::take_close() {
  return std::exchange(close_, false);
}

bool Screen::is_down(const Shortcut& key) const {
  return std::any_of(held_.begin(), held_.end(),
                     [&](const auto& entry) { return entry.second == key.key; });
}

}  // namespace holomorph
