// The picture between the panels: what the workspace shows, handed to the layers' painters.
#pragma once

#include <map>

#include "app/canvas/layer_painter.h"
#include "edit/workspace.h"
#include "render/framebuffer.h"

namespace holomorph {

/// Colours and the display's ratio of framebuffer to window px, which change from frame to frame.
struct CanvasFrame {
  int window_width = 1, window_height = 1;  ///< of the framebuffer
  double ratio = 1;
  Color background, backdrop;
};

/// Of the pictures of keys beside the time: warm before, cold after.
Color onion_color(bool later);

/// Owns the painters of all layers. Needs a current OpenGL context.
class Canvas {
 public:
  /// `wake` is called on another thread when there is something new to draw.
  explicit Canvas(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// The workspace has another document.
  void forget() { forgets_ = true; }
  /// To be called between frames: whether there was something to do that takes as long as one.
  bool make_room();
  /// Uploads what changed since the last frame and draws. The maps must be up to date.
  void draw(Workspace& workspace, const CanvasFrame& frame);

  /// A box of the plane, enlarged to the whole pixels that draw_map makes of it.
  static Box whole_pixels(const Box& box);
  /// Draws the edited layer's posed map alone, such a box filling the picture, with `clay` where
  /// the picture is transparent. What changed must have been uploaded by draw.
  void draw_map(const Workspace& workspace, const Box& box, Framebuffer& into, Color clay);

  /// The edited layer's, which draw has drawn: its heat map and how it is drawn.
  const LayerPainter& edited() const { return *edited_; }

 private:
  /// From one part of the canvas' width to another.
  void draw_part(Workspace& workspace, const CanvasFrame& at, double from, double to,
                 bool original);
  LayerPainter& painter_of(const Layer& layer);
  void take_picture(Workspace& workspace, const Layer& layer);

  std::map<int, std::unique_ptr<LayerPainter>> painters_;  ///< by the layers' ids
  LayerPainter* edited_ = nullptr;
  bool forgets_ = false;  ///< with the next frame: this one may still be asked about
  std::function<void()> wake_;
};

}  // namespace holomorph
