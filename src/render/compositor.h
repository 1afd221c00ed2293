// Combines layers with opacities and blending modes, away from the window.
#pragma once

#include "render/program.h"

namespace holomorph {

/// Layers are drawn one by one into a texture of the window's size, and combined. Needs a current
/// OpenGL context. Call begin(), then begin_layer() and end_layer() for each layer from bottom to
/// top, then finish().
class Compositor {
 public:
  Compositor();
  ~Compositor();
  Compositor(const Compositor&) = delete;
  Compositor& operator=(const Compositor&) = delete;

  /// Starts with nothing. Throws Error{failed} if the driver cannot draw into textures of this
  /// size.
  void begin(int width, int height);
  /// Directs drawing into an empty, transparent layer.
  void begin_layer();
  /// Combines the layer with those below it. `blending` is the number of the mode; see
  /// shaders/composite.frag.
  void end_layer(int blending, double opacity);
  /// Draws the result over the window's content, within this rectangle in framebuffer px with its
  /// origin at the lower left.
  void finish(int left, int bottom, int width, int height);

 private:
  struct Target {
    unsigned framebuffer = 0, texture = 0;
  };
  void resize(int width, int height);
  void combine(const Target& into, int blending, double opacity);

  Program program_;
  Target under_, over_, result_;
  unsigned array_ = 0, stencil_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace holomorph
