// Callbacks queue events. Three frames follow each event, because ImGui needs two to settle a
// layout.
#include "app/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "app/look/items.h"
#include "app/look/theme.h"
#include "core/error.h"
#include "render/renderer.h"

namespace holomorph {
namespace {

constexpr int kFramesPerEvent = 3;

Window* self(GLFWwindow* window) {
  return static_cast<Window*>(glfwGetWindowUserPointer(window));
}

/// The key code of the character that a physical key prints in the user's keyboard layout.
int printed_key(int key, int scancode) {
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
  const char* name = glfwGetKeyName(key, scancode);
  const bool ascii = name && name[0] > ' ' && name[0] < 127 && name[1] == 0;
  if (ascii) return std::toupper(static_cast<unsigned char>(name[0]));
  return key > ' ' && key < 127 ? key : 0;
}

}  // namespace

bool has_display() {
  for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY"})
    if (const char* value = std::getenv(variable); value && *value) return true;
  return false;
}

Window::Window(int width, int height, double ui_scale, Theme theme, bool reduce_motion) {
  std::string reason = "unknown reason";
  glfwSetErrorCallback(nullptr);
  if (!glfwInit()) throw Error(ErrorKind::failed, "cannot open a window: there is no display");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_STENCIL_BITS, 8);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "holomorph");  // the name in the desktop file
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "holomorph");
  for (const int samples :
       {4, 0}) {  // some drivers have no multisampling; software drivers are too slow for it
    glfwWindowHint(GLFW_SAMPLES, samples);
    window_ = glfwCreateWindow(width, height, "Holomorph", nullptr, nullptr);
    if (!window_) continue;
    glfwMakeContextCurrent(window_);
    if (samples == 0 || !is_software_driver()) break;
    glfwDestroyWindow(window_);
  }
  if (!window_) {
    const char* text = nullptr;
    glfwGetError(&text);
    reason = text ? text : reason;
    glfwTerminate();
    throw Error(ErrorKind::failed, "cannot open a window with OpenGL 3.3: " + reason);
  }
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  using Type = Event::Type;
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    self(w)->add({Type::key, 0, 0, key, scancode, action, mods});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned code) {
    self(w)->add({Type::character, 0, 0, static_cast<int>(code)});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
    // Use the position at the press. glfwGetCursorPos would return the current position.
    const auto [x, y] = self(w)->pointer();
    self(w)->add({Type::button, x, y, button, 0, action});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
    self(w)->add({Type::scroll, x, y});
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
    self(w)->pointer_ = {x, y};
    self(w)->add({Type::move, x, y});
  });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int entered) {
    if (!entered) self(w)->add({Type::move, -1e9, -1e9});
  });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
    ImGui_ImplGlfw_WindowFocusCallback(w, focused);
    self(w)->wake();
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { self(w)->wake(); });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { self(w)->wake(); });
  glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* w, float, float) {
    self(w)->moved_display_ = true;
    self(w)->wake();
  });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) {
    glfwSetWindowShouldClose(w, GLFW_FALSE);
    self(w)->close_ = true;
    self(w)->wake();
  });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    for (int i = 0; i < count; ++i) self(w)->drops_.push_back(paths[i]);
    self(w)->wake();
  });

  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().ConfigDragClickToInputText = true;
  ImGui_ImplGlfw_InitForOpenGL(window_, false);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  ImGui_ImplOpenGL3_CreateDeviceObjects();  // otherwise the first frame builds the fonts again
  set_style(ui_scale, theme, reduce_motion);
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::set_style(double ui_scale, Theme theme, bool reduce_motion) {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  wanted_scale_ = ui_scale;
  scale_ = ui_scale > 0 ? ui_scale : std::clamp<double>(std::max(x, y), 0.75, 4.0);
  theme_ = theme;
  reduce_motion_ = reduce_motion;
  if (apply_theme(scale_, theme, reduce_motion)) {
    ImGui_ImplOpenGL3_DestroyFontsTexture();  // the next line rebuilds it from the new fonts
    ImGui_ImplOpenGL3_CreateFontsTexture();
    ImGui::GetIO().Fonts->ClearTexData();  // the driver has its own copy
  }
  wake();
}

bool Window::wait(double longest) {
  if (owed_frames_ > 0)
    glfwPollEvents();
  else
    glfwWaitEventsTimeout(longest);
  if (woken_.exchange(false)) owed_frames_ = kFramesPerEvent;
  if (owed_frames_ <= 0) return false;
  --owed_frames_;
  return true;
}

void Window::wake() {
  woken_ = true;
  glfwPostEmptyEvent();
}

void Window::begin_frame(bool navigates) {
  if (std::exchange(moved_display_, false)) set_style(wanted_scale_, theme_, reduce_motion_);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  pump_events();
  ImGuiIO& io = ImGui::GetIO();
  const bool presses = is_down(Key::enter) || is_down(Key::space);
  held_before_navigation_ = presses && (held_before_navigation_ || !navigates);
  if (!navigates) enter_activates_ = false;
  navigates = navigates && !held_before_navigation_;
  io.ConfigFlags = navigates ? ImGuiConfigFlags_NavEnableKeyboard : ImGuiConfigFlags_None;
  // ImGui gets Tab while the user types into a field or navigates. Otherwise actions get it.
  const bool tabs = (io.WantTextInput || navigates) && !io.KeyCtrl;
  io.KeyMap[ImGuiKey_Tab] = tabs ? GLFW_KEY_TAB : -1;
  // ImGui itself activates buttons only with Space. This adds Enter.
  if (navigates && enter_activates_) io.NavInputs[ImGuiNavInput_Activate] = 1;
  io.KeyAlt = io.KeyAlt || alt_;
  // The second press comes two frames after the first at the earliest, which may be slow ones. The
  // time between frames would not do, because the window sleeps there.
  constexpr double kDoubleClickSeconds = 0.45;
  io.MouseDoubleClickTime = static_cast<float>(kDoubleClickSeconds + 2 * frame_seconds_);
  frame_start_ = glfwGetTime();
  ImGui::NewFrame();
  advance_theme();
  forget_item_boxes();
}

void Window::end_frame() {
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window_);
  frame_seconds_ = glfwGetTime() - frame_start_;
}

std::pair<double, double> Window::pointer() const {
  if (pointer_) return *pointer_;
  double x = 0, y = 0;
  glfwGetCursorPos(window_, &x, &y);
  return {x, y};
}

void Window::add(const Event& event) {
  events_.push_back(event);
  wake();
}

/// Passes events to ImGui until a button changes, which may open or close what later events are
/// for, or until a key is released that was pressed in this frame, because ImGui must see it
/// pressed.
void Window::pump_events() {
  ImGuiIO& io = ImGui::GetIO();
  bool button_changed = false;
  std::vector<int> pressed;
  const auto taken = [&] {
    const Event::Type kind = events_.front().kind;
    if (kind == Event::Type::button || kind == Event::Type::key) ++taken_;
    events_.pop_front();
  };
  for (; !events_.empty() && !button_changed; taken()) {
    const Event& event = events_.front();
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
      ImGui_ImplGlfw_KeyCallback(window_, event.code, event.scancode, event.action, event.mods);
      take_key(event);
    } else if (event.kind == Event::Type::character) {
      ImGui_ImplGlfw_CharCallback(window_, static_cast<unsigned>(event.code));
      queue_character(static_cast<unsigned>(event.code));
    } else {
      ImGui_ImplGlfw_ScrollCallback(window_, event.x, event.y);
    }
  }
  if (!events_.empty()) wake();
  io.MousePos = {static_cast<float>(mouse_x_), static_cast<float>(mouse_y_)};
  for (int button = 0; button < 3; ++button) io.MouseDown[button] = mouse_down_[button];
}

void Window::take_key(const Event& event) {
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

void Window::queue_character(unsigned code) {
  if (code == '?' || code == '+') keys_.push_back({Shortcut(static_cast<char>(code)), false});
}

std::vector<KeyPress> Window::take_keys() {
  return std::exchange(keys_, {});
}
std::vector<Path> Window::take_drops() {
  return std::exchange(drops_, {});
}
bool Window::take_close() {
  return std::exchange(close_, false);
}

bool Window::is_down(const Shortcut& key) const {
  return std::any_of(held_.begin(), held_.end(),
                     [&](const auto& entry) { return entry.second == key.key; });
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

namespace {
template <class Get>
std::pair<int, int> size_of(GLFWwindow* window, Get get) {
  int width = 1, height = 1;
  get(window, &width, &height);
  return {std::max(width, 1), std::max(height, 1)};
}
}  // namespace

int Window::width() const {
  return size_of(window_, glfwGetWindowSize).first;
}
int Window::height() const {
  return size_of(window_, glfwGetWindowSize).second;
}
int Window::framebuffer_width() const {
  return size_of(window_, glfwGetFramebufferSize).first;
}
int Window::framebuffer_height() const {
  return size_of(window_, glfwGetFramebufferSize).second;
}

}  // namespace holomorph
