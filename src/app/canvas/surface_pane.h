// The surface in space beside the canvas, with the posed picture on it.
#pragma once

#include "app/canvas/canvas.h"
#include "app/canvas/overlay.h"
#include "edit/tools/orbit.h"
#include "render/surface_renderer.h"
#include "scene/flattened_surface.h"

namespace holomorph {

/// Follows the scene's surface and outline; owns the camera and what draws. Needs a current OpenGL
/// context once it is drawn.
class SurfacePane {
 public:
  /// `wake` is called on another thread when a surface has been read.
  explicit SurfacePane(std::function<void()> wake) : wake_(std::move(wake)) {}
  /// Draws the pane between the canvas and the inspector. The scene must have a surface.
  void draw(Workspace& workspace, Canvas& canvas, const OverlayStyle& style);
  bool hovered() const { return hovered_; }
  static const char* hint() {
    return "Drag turns, right drag moves, the wheel comes nearer; double-click shows all";
  }
  const OrbitCamera& camera() const { return camera_; }
  bool has_picture() const { return laid_.has_value(); }

 private:
  /// What GL needs, made with the first drawing.
  struct Drawing {
    SurfaceRenderer renderer;
    Framebuffer flat, space;
  };

  void read(const Workspace& workspace);
  void follow(const Workspace& workspace);
  void draw_header(Workspace& workspace, float scale);
  void choose_flattening(Workspace& workspace, float width);
  void draw_surface(const Workspace& workspace, Canvas& canvas, const OverlayStyle& style);
  void navigate(float height);

  std::function<void()> wake_;
  std::unique_ptr<Drawing> drawing_;
  std::shared_ptr<FlattenedSurface> found_;  ///< what is being read
  std::unique_ptr<Job> reading_;
  std::vector<std::unique_ptr<Job>> abandoned_;  ///< cancelled; they end when they notice
  std::optional<SurfaceReference> shown_;
  std::filesystem::file_time_type read_;  ///< its file's time when it was read
  Points outline_;                        ///< that `laid_` was laid along
  std::optional<FlattenedSurface> flat_;  ///< as it was flattened; none when it cannot be read
  std::optional<FlattenedSurface> laid_;
  Box box_;  ///< of the plane, that the texture shows
  OrbitCamera camera_;
  double fitted_ = 0;    ///< aspect of the view that the camera shows all in; 0: it is to be fitted
  bool moved_ = false;   ///< the user has moved the camera
  std::string problem_;  ///< why there is no picture on it
  bool hovered_ = false;
};

}  // namespace holomorph
