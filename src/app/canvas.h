// The picture between the panels: what the workspace shows, handed to the renderer.
#pragma once

#include "edit/workspace.h"
#include "render/framebuffer.h"
#include "render/renderer.h"

namespace holomorph {

/// Colours and the display's ratio of framebuffer to window px, which change from frame to frame.
struct CanvasFrame {
  int window_width = 1, window_height = 1;  ///< of the framebuffer
  double ratio = 1;
  Color background, backdrop;
};

/// Of the pictures of keys beside the time: warm before, cold after.
Color onion_color(bool later);

/// Owns the renderer and what it was last given. Needs a current OpenGL context.
class Canvas {
 public:
  /// The workspace has another document: its picture is uploaded with the next frame.
  void replace_picture() { picture_changed_ = true; }
  /// Uploads what changed since the last frame and draws. The map must be up to date.
  void draw(Workspace& workspace, const CanvasFrame& frame);

  /// A box of the plane, enlarged to the whole pixels that draw_map makes of it.
  static Box whole_pixels(const Box& box);
  /// Draws the posed map alone, such a box filling the picture, with `clay` where the picture is
  /// transparent. What changed must have been uploaded by draw.
  void draw_map(const Workspace& workspace, const Box& box, Framebuffer& into, Color clay);

  const HeatScale& heat_scale() const { return heat_scale_; }
  /// Per mesh vertex; empty without a heat map.
  const Eigen::VectorXd& heat_values() const { return heat_values_; }
  /// Whether the shader places the vertices itself.
  bool by_operator() const { return by_operator_; }

 private:
  /// What is the same wherever the map is drawn.
  Frame frame_of(const Workspace& workspace) const;
  void update_heat(const Workspace& workspace);
  void upload_picture(Workspace& workspace);
  void upload_map(const LiveMap& map);

  Renderer renderer_;
  Eigen::VectorXd heat_values_;
  HeatScale heat_scale_;
  unsigned uploaded_ = 0;
  bool timed_ = false;  ///< what was uploaded is no sum of controls
  bool picture_changed_ = true, by_operator_ = false;
};

}  // namespace holomorph
