// The canvas between the panels: passes what the workspace shows to the painters of its layers.
#pragma once

#include <map>

#include "app/canvas/layer_painter.h"
#include "edit/workspace.h"
#include "render/framebuffer.h"

namespace holomorph {

/// What may change from frame to frame: the size of the window, colors, and the ratio of
/// framebuffer px to window px.
struct CanvasFrame {
  int window_width = 1, window_height = 1;  ///< framebuffer px
  double ratio = 1;
  Color background, backdrop;
};

/// Tint of the onion skin: warm for the keyframe before the current time, cold for the `later` one.
Color onion_color(bool later);

/// Owns the painters of all layers. Needs a current OpenGL context.
class Canvas {
 public:
  /// `wake` is called on another thread when there is something new to draw.
  explicit Canvas(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// To be called when the workspace has another document.
  void forget() { forgets_ = true; }
  /// To be called between frames. Makes room on the GPU for a picture that is ready, which can take
  /// as long as a frame. Returns whether it did.
  bool allocate_texture();
  /// Uploads what has changed since the last frame, then draws. The maps must be up to date.
  void draw(Workspace& workspace, const CanvasFrame& frame);

  /// A box of the plane, enlarged so that draw_map draws it as a whole number of pixels.
  static Box whole_pixels(const Box& box);
  /// Draws the edited layer's posed map alone. The box, one that whole_pixels has returned, fills
  /// the framebuffer; `clay` shows where the picture is transparent. Changes must have been
  /// uploaded by draw.
  void draw_map(const Workspace& workspace, const Box& box, Framebuffer& into, Color clay);

  /// The edited layer's painter, for its heat map and how it is drawn. Valid once draw has been
  /// called.
  const LayerPainter& edited() const { return *edited_; }

 private:
  /// Draws the part of the canvas between two fractions of its width.
  void draw_part(Workspace& workspace, const CanvasFrame& at, double from, double to,
                 bool original);
  LayerPainter& painter_of(const Layer& layer);
  void update_picture(Workspace& workspace, const Layer& layer);

  std::map<int, std::unique_ptr<LayerPainter>> painters_;  ///< by the layers' ids
  LayerPainter* edited_ = nullptr;
  bool forgets_ = false;  ///< in the next frame; edited() may still be called in this one
  std::function<void()> wake_;
};

}  // namespace holomorph
