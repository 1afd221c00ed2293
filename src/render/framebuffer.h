// A picture that is drawn by OpenGL and then used as a texture.
#pragma once

namespace holomorph {

/// Owns colour with mipmaps, depth and stencil. Needs a current OpenGL context.
class Framebuffer {
 public:
  Framebuffer();
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  /// What is drawn from here on goes into it, until release. A change of size loses its content.
  /// Throws Error{failed} for a size that the driver has no memory for.
  void bind(int width, int height);
  /// What is drawn goes to the window again.
  void release();

  unsigned texture() const { return color_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  unsigned framebuffer_ = 0, color_ = 0, depth_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace holomorph
