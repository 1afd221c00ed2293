// An OpenGL render target that can be used as a texture afterward.
#pragma once

namespace holomorph {

/// Owns a color texture with mipmaps, and a depth and stencil buffer. Needs a current OpenGL
/// context.
class Framebuffer {
 public:
  Framebuffer();
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  /// Redirects drawing into this framebuffer until release(). A change of size discards the
  /// content. Throws Error{failed} if the driver cannot provide this size.
  void bind(int width, int height);
  /// Redirects drawing to the window again, and computes the mipmaps.
  void release();

  unsigned texture() const { return color_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  unsigned framebuffer_ = 0, color_ = 0, depth_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace holomorph
