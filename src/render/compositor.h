// Combines layers with opacities and blending modes, away from the window.
#pragma once

#include <array>
#include <optional>

#include "render/program.h"

namespace holomorph {

/// How a layer is combined with those below it.
struct Ink {
  int blending = 0;  ///< the number of the mode; see shaders/composite.frag
  double opacity = 1;
  bool clipped = false;  ///< changes the colors of the nearest unclipped layer below, not its alpha
};

/// Layers are drawn one by one into a texture of the window's size, and combined. Needs a current
/// OpenGL context. Call begin(), then begin_layer() and end_layer() for each layer from bottom to
/// top, then finish(). What lies behind all layers comes first: for each part of it, the layers
/// whose gaps it fills, keep(), the part, and fill_gaps().
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
  /// Adds the layer to those below it. The first one must not be clipped.
  void end_layer(const Ink& ink);
  /// Keeps the result, and starts again with nothing.
  void keep();
  /// Cuts the result to the gaps of the kept one, adds it to what lies behind all layers, and
  /// starts again with nothing. Together, the two have the larger alpha of both.
  void fill_gaps(int blending);
  /// Draws the result and what lies behind it over the window's content. The rectangle is in
  /// framebuffer px with its origin at the lower left.
  void finish(int left, int bottom, int width, int height);

 private:
  struct Target {
    unsigned framebuffer = 0, texture = 0;
  };
  std::array<Target*, 6> targets() { return {&under_, &base_, &over_, &result_, &kept_, &behind_}; }
  void resize(int width, int height);
  void allocate(const Target& target);
  static void clear(const Target& target);
  void blend(Target& under, const Target& over, const Ink& ink);
  void combine(const Target& into, const Target& under, const Target& over, const Ink& ink);
  /// Combines the last layer that is not clipped, with those clipped to it, with what is below it.
  void end_base();

  Program program_;
  Target under_, base_, over_, result_, kept_, behind_;
  bool has_behind_ = false, fills_gaps_ = false;  ///< kept_ and behind_ are allocated
  std::optional<Ink> base_ink_;                   ///< none: nothing has been drawn into base_
  unsigned array_ = 0, stencil_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace holomorph
