// GLFW's callbacks queue events for the next frames, with the position of the pointer when they
// happened.
#include "app/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>

#include "core/clock.h"
#include "core/error.h"
#include "render/renderer.h"

namespace holomorph {

bool has_display() {
  for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY"})
    if (const char* value = std::getenv(variable); value && *value) return true;
  return false;
}

Window* Window::self(GLFWwindow* window) {
  return static_cast<Window*>(glfwGetWindowUserPointer(window));
}

Window::Window(int width, int height, const Preferences& preferences) {
  open(width, height);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  receive_input();
  receive_state();
  ImGui_ImplGlfw_InitForOpenGL(window_, false);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  ImGui_ImplOpenGL3_CreateDeviceObjects();  // otherwise the first frame builds the fonts again
  set_style(preferences.ui_scale, preferences.theme, preferences.reduce_motion);
}

void Window::open(int width, int height) {
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
}

void Window::receive_input() {
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
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    for (int i = 0; i < count; ++i) self(w)->add_drop(paths[i]);
  });
}

void Window::receive_state() {
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
    ImGui_ImplGlfw_WindowFocusCallback(w, focused);
    self(w)->wake();
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { self(w)->wake(); });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { self(w)->wake(); });
  glfwSetWindowContentScaleCallback(
      window_, [](GLFWwindow* w, float, float) { self(w)->moved_to_display(); });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) {
    glfwSetWindowShouldClose(w, GLFW_FALSE);
    self(w)->ask_to_close();
  });
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

double Window::now_ms() const {
  return holomorph::now_ms();
}

void Window::poll(double longest) {
  if (longest > 0)
    glfwWaitEventsTimeout(longest);
  else
    glfwPollEvents();
}

void Window::interrupt() {
  glfwPostEmptyEvent();
}

void Window::begin_drawing() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
}

void Window::present() {
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window_);
}

double Window::display_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return static_cast<double>(std::max(x, y));
}

void Window::upload_fonts() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();  // the next line rebuilds it from the new fonts
  ImGui_ImplOpenGL3_CreateFontsTexture();
  ImGui::GetIO().Fonts->ClearTexData();  // the driver has its own copy
}

char Window::character_on(int key, int scancode) const {
  const char* name = glfwGetKeyName(key, scancode);
  const bool ascii = name && name[0] > ' ' && name[0] < 127 && name[1] == 0;
  return ascii ? name[0] : '\0';
}

std::pair<double, double> Window::pointer() const {
  if (pointer_) return *pointer_;
  double x = 0, y = 0;
  glfwGetCursorPos(window_, &x, &y);
  return {x, y};
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
