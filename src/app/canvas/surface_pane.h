// The surface in space next to the canvas, with the posed picture on it.
#pragma once

#include "app/canvas/canvas.h"
#include "app/canvas/overlay.h"
#include "edit/tools/orbit.h"
#include "render/surface_renderer.h"
#include "scene/flattened_surface.h"

namespace holomorph {

/// Shows the scene's surface and refits it when the outline changes. Owns the camera and the
/// renderer. Drawing needs a current OpenGL context.
class SurfacePane {
 public:
  /// `wake` is called on another thread when a surface has been read.
  explicit SurfacePane(std::function<void()> wake) : wake_(std::move(wake)) {}
  /// Draws the pane between the canvas and the inspector. The scene must have a surface.
  void draw(Workspace& workspace, Canvas& canvas, const OverlayStyle& style);
  bool hovered() const { return hovered_; }
  static const char* hint() {
    return "Drag to turn; right-drag to move; wheel to zoom; double-click to see all of it";
  }
  const OrbitCamera& camera() const { return camera_; }
  bool has_picture() const { return fitted_surface_.has_value(); }

 private:
  /// OpenGL objects, created when the pane is drawn for the first time.
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
  std::shared_ptr<FlattenedSurface> read_surface_;  ///< result of reading_
  std::unique_ptr<Job> reading_;
  std::vector<std::unique_ptr<Job>> abandoned_;  ///< canceled, but not ended yet
  std::optional<SurfaceReference> shown_;
  std::filesystem::file_time_type read_;  ///< modification time of the file that was read
  Points outline_;                        ///< the outline that fitted_surface_ was fitted to
  std::optional<FlattenedSurface> flat_;  ///< the unfitted surface; none if unreadable
  std::optional<FlattenedSurface> fitted_surface_;
  Box box_;  ///< the part of the plane that the texture shows
  OrbitCamera camera_;
  double fitted_ = 0;    ///< aspect ratio for which the camera was fitted; 0: not fitted yet
  bool moved_ = false;   ///< the user has moved the camera
  std::string problem_;  ///< why the surface shows no picture
  bool hovered_ = false;
};

}  // namespace holomorph
