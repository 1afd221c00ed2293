// Draws one layer with OpenGL.
#pragma once

#include <memory>
#include <mutex>

#include "edit/settling.h"
#include "render/renderer.h"
#include "scene/formats/image.h"
#include "scene/fringe.h"
#include "scene/live_map.h"
#include "system/job.h"

namespace holomorph {

/// Owns a renderer and keeps track of what was uploaded to it. Needs a current OpenGL context.
class LayerPainter {
 public:
  /// `wake` is called on another thread when there is something new to draw.
  explicit LayerPainter(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Sets the current picture, or null. Large pictures are prepared on another thread and appear
  /// gradually, unless they are frames of a film (`moves`). Once per picture or film, when the
  /// factor by which it was reduced for this driver is known, returns that factor (1: not reduced).
  /// All other calls return 0.
  int update_picture(std::shared_ptr<const Image> picture, bool moves = false);
  /// Allocates GPU memory for a prepared picture, which can take as long as a frame. Returns
  /// whether a picture was prepared.
  bool allocate_texture();
  /// Whether the picture covers its rectangle, or there is none. Looked at once for each picture.
  bool is_opaque();
  /// Whether the next frame will show more of the picture.
  bool is_uploading() const { return uploading_; }
  /// Whether the picture is fading to its final map.
  bool is_settling() const { return settling_.moves(); }
  /// Uploads the current map if it has changed. On another thread, finds the faint surroundings of
  /// a cut-out. If `view` is a heat map, also computes its values.
  void update_map(const LiveMap& map, View view, bool automatic_range);
  /// Draws the layer. Adapts the view and placement in `frame` to the uploaded map.
  void draw(const LiveMap& map, View view, RenderFrame frame);

  const HeatScale& heat_scale() const { return heat_scale_; }
  /// One value for each mesh vertex; empty without a heat map.
  const Eigen::VectorXd& heat_values() const { return heat_values_; }
  /// Whether the shader computes the positions of the vertices.
  bool by_operator() const { return by_operator_; }

 private:
  void upload(const LiveMap& map, View view, bool automatic_range);
  void update_fringe(const LiveMap& map, bool moved);
  void update_heat(const LiveMap& map, View view, bool automatic_range);

  std::function<void()> wake_;
  Renderer renderer_;
  std::shared_ptr<TextureLevels> ready_;  ///< result of preparing_
  std::unique_ptr<Job> preparing_;
  bool uploading_ = false;
  int factor_ = 0;  ///< not returned yet; 0: none
  std::shared_ptr<const Image> picture_;
  std::optional<bool> opaque_;  ///< none: the picture has not been looked at
  bool moves_ = false;          ///< the picture is a frame of a film
  /// The fringe of the picture around a mesh; null while it is sought, or if there is none.
  struct FringeAnswer {
    std::mutex mutex;
    std::optional<std::shared_ptr<const Fringe>> fringe;
  };
  std::pair<std::shared_ptr<const Mesh>, std::shared_ptr<const Image>> fringed_;
  std::shared_ptr<const Fringe> fringe_;
  std::shared_ptr<FringeAnswer> fringe_answer_;
  std::unique_ptr<Job> seeks_fringe_;
  bool needs_fringe_ = false;  ///< the search for it has not started yet
  Eigen::VectorXd heat_values_;
  HeatScale heat_scale_;
  std::shared_ptr<const Mesh> mesh_;
  /// What was uploaded last.
  struct Uploaded {
    const LiveMap* map = nullptr;
    unsigned revision = 0;
    View view = View::image;
    bool automatic_range = false;
    bool operator==(const Uploaded&) const = default;
  };
  Uploaded uploaded_;
  unsigned preparation_ = 0;  ///< whose mesh was uploaded; 0: none
  bool timed_ = false;        ///< the uploaded map is interpolated between keyframes
  bool by_operator_ = false;
  Settling settling_;
};

}  // namespace holomorph
