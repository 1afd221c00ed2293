// One layer on the graphics processor.
#pragma once

#include <memory>

#include "render/renderer.h"
#include "scene/formats/image.h"
#include "scene/live_map.h"
#include "system/job.h"

namespace holomorph {

/// Owns a renderer and what it was last given. Needs a current OpenGL context.
class LayerPainter {
 public:
  /// `wake` is called on another thread when there is something new to draw.
  explicit LayerPainter(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// The picture as it is now, or null. Large ones are made ready on another thread and appear bit
  /// by bit. Returns how many times it had to be reduced for this driver, 1 when not at all; 0 when
  /// that has been said or is not known yet.
  int take_picture(std::shared_ptr<const Image> picture);
  /// Makes room for a picture that has been made ready, which takes as long as a frame may. Returns
  /// whether there was one.
  bool make_room();
  /// Whether the next frame will show more of the picture.
  bool grows() const { return grows_; }
  /// The map as it is now, and its heat map if `view` is one.
  void take_map(const LiveMap& map, View view, bool automatic_range);
  /// Draws; view and placement are chosen here from the map that was taken.
  void draw(const LiveMap& map, View view, RenderFrame frame);

  const HeatScale& heat_scale() const { return heat_scale_; }
  /// Per mesh vertex; empty without a heat map.
  const Eigen::VectorXd& heat_values() const { return heat_values_; }
  /// Whether the shader places the vertices itself.
  bool by_operator() const { return by_operator_; }

 private:
  void update_heat(const LiveMap& map, View view, bool automatic_range);

  std::function<void()> wake_;
  Renderer renderer_;
  std::shared_ptr<TextureLevels> ready_;  ///< what making_ready_ makes
  std::unique_ptr<Job> making_ready_;
  bool grows_ = false;
  int factor_ = 0;  ///< not said yet
  std::shared_ptr<const Image> picture_;
  Eigen::VectorXd heat_values_;
  HeatScale heat_scale_;
  std::shared_ptr<const Mesh> mesh_;
  unsigned uploaded_ = 0;  ///< a preparation's number
  bool timed_ = false;     ///< what was uploaded is no sum of controls
  bool by_operator_ = false;
};

}  // namespace holomorph
