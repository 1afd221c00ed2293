// Shows the last picture of a scene while it is being opened, and keeps it for the next time.
#pragma once

#include <imgui.h>

#include <functional>

#include "edit/workspace.h"
#include "render/texture.h"
#include "scene/last_pictures.h"
#include "system/job.h"

namespace holomorph {

/// Needs a current OpenGL context.
class LastPictureView {
 public:
  /// `wake` is called on another thread when a picture has been kept.
  explicit LastPictureView(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Looks for the picture of a scene that has just been opened.
  void opened(const Workspace& workspace);
  /// Call this once per frame. Keeps a picture of the scene if it took long to solve.
  void update(const Workspace& workspace);
  /// Whether a picture takes the place of the layers.
  bool shows() const { return texture_.has_value(); }
  /// Whether the sign "Solving" is shown.
  bool solving() const { return solving_; }
  /// Draws the picture, or the sign, over the canvas.
  void draw(const Workspace& workspace) const;

 private:
  void keep(const Workspace& workspace);

  std::function<void()> wake_;
  bool waits_ = false, solving_ = false;
  double opened_ms_ = 0;
  double slowest_ms_ = 0;  ///< time in which maps were prepared and solved, at most
  std::string kept_hash_;  ///< of the file whose picture was kept last
  std::optional<Texture> texture_;
  Box box_;
  std::unique_ptr<Job> job_;
};

}  // namespace holomorph
