// The GLFW window with its OpenGL context: the screen that people see.
#pragma once

#include <optional>

#include "app/screen.h"

struct GLFWwindow;

namespace holomorph {

/// Owns the window and its OpenGL context, which is current while the window exists.
class Window final : public Screen {
 public:
  /// The size is in window px. Throws Error{failed} if there is no display or no OpenGL 3.3.
  Window(int width, int height, const Preferences& preferences);
  ~Window() override;

  double now_ms() const override;
  void set_title(const std::string& title) override;
  int width() const override;
  int height() const override;
  int framebuffer_width() const override;
  int framebuffer_height() const override;

 private:
  static Window* self(GLFWwindow* window);
  void open(int width, int height);
  void receive_input();
  void receive_state();
  /// Position of the pointer after the latest event, in window px.
  std::pair<double, double> pointer() const;

  void poll(double longest) override;
  void interrupt() override;
  void begin_drawing() override;
  void present() override;
  double display_scale() const override;
  void upload_fonts() override;
  char character_on(int key, int scancode) const override;

  GLFWwindow* window_ = nullptr;
  std::optional<std::pair<double, double>> pointer_;  ///< position at the latest event, window px
};

/// Whether a display is set. No window can be opened without one.
bool has_display();

}  // namespace holomorph
