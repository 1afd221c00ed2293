// The canvas between the panels. Passes the workspace's state to one painter per layer.
#pragma once

#include <map>

#include "app/canvas/layer_painter.h"
#include "edit/workspace.h"
#include "render/compositor.h"
#include "render/framebuffer.h"

namespace holomorph {

/// Settings that may change from frame to frame: the size of the window, the ratio of framebuffer
/// px to window px, and colors.
struct CanvasFrame {
  int window_width = 1, window_height = 1;  ///< framebuffer px
  double ratio = 1;
  Color background, page_a, page_b;  ///< the canvas and the checkerboard
  double cell = 8, shadow = 0;       ///< width of the cells; softness of the shadow; window px
  float shadow_alpha = 0;
  bool page_alone = false;  ///< without the layers
};

/// Tint of an onion skin: blue for a keyframe after the current time (`later`), otherwise orange.
Color onion_color(bool later);

/// Owns the painters of all layers. Needs a current OpenGL context.
class Canvas {
 public:
  /// `wake` is called on another thread when there is something new to draw.
  explicit Canvas(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Call this when the workspace has switched to another document.
  void forget() { forgets_ = true; }
  /// Allocates GPU memory for a picture that is ready, which can take as long as a frame. Returns
  /// whether there was such a picture. Call this between frames.
  bool allocate_texture();
  /// Uploads what has changed since the last frame, then draws. The maps must be up to date.
  void draw(Workspace& workspace, const CanvasFrame& frame);

  /// Enlarges a box of the plane to a whole number of pixels at the scale that draw_map uses.
  static Box whole_pixels(const Box& box);
  /// Draws only the edited layer's posed map. A surface can therefore show whatever the canvas can.
  /// The box fills the framebuffer and must come from whole_pixels. Transparent parts of the
  /// picture show `clay`. Call draw first, because it uploads changes.
  void draw_map(const Workspace& workspace, const Box& box, Framebuffer& into, Color clay);

  /// The edited layer's painter, for its heat map and the way in which it is drawn. Valid after the
  /// first call of draw.
  const LayerPainter& edited() const { return *edited_; }

 private:
  /// Draws the part of the canvas between the fractions `from` and `to` of its width.
  void draw_part(Workspace& workspace, const CanvasFrame& at, double from, double to,
                 bool original);
  LayerPainter& painter_of(const Layer& layer);
  void update_picture(Workspace& workspace, const Layer& layer);

  std::map<int, std::unique_ptr<LayerPainter>> painters_;  ///< by layer id
  std::unique_ptr<Compositor> compositor_;                 ///< made when a layer needs it
  LayerPainter* edited_ = nullptr;
  bool forgets_ = false;  ///< delete the painters in the next frame; edited() is valid until then
  std::function<void()> wake_;
};

}  // namespace holomorph
