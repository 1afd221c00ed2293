// Combines layers with opacities and blending modes, away from the window.
#pragma once

#include "render/program.h"

namespace holomorph {

/// How a layer is combined with those below it.
struct Ink {
  int blending = 0;  ///< the number of the mode; see shaders/composite.frag
  double opacity = 1;
  bool clipped = false;  ///< changes the colors below, but not their alpha
};

/// Layers are drawn one by one into a texture of the window's size, and combined. Needs a current
/// OpenGL context. Call begin(), then begin_layer() and end_layer() for each layer from bottom to
/// top, then finish(). Layers may be put into groups.
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
  /// Combines the layer with those below it.
  void end_layer(const Ink& ink);
  /// Starts a group of layers that are combined with each other first. Groups cannot be nested.
  void begin_group();
  /// Combines the group, as one layer, with what is below it.
  void end_group(const Ink& ink);
  /// Draws the result over the window's content, within this rectangle in framebuffer px with its
  /// origin at the lower left.
  void finish(int left, int bottom, int width, int height);

 private:
  struct Target {
    unsigned framebuffer = 0, texture = 0;
  };
  void resize(int width, int height);
  static void clear(const Target& target);
  void combine(const Target& into, const Ink& ink);

  Program program_;
  Target under_, over_, result_, below_group_;
  unsigned array_ = 0, stencil_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace holomorph
