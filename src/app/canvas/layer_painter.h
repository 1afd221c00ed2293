// Draws one layer with OpenGL.
#pragma once

#include <memory>

#include "render/renderer.h"
#include "scene/formats/image.h"
#include "scene/live_map.h"
#include "system/job.h"

namespace holomorph {

/// Owns a renderer and remembers what was uploaded to it. Needs a current OpenGL context.
class LayerPainter {
 public:
  /// `wake` is called on another thread when there is something new to draw.
  explicit LayerPainter(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Takes the current picture, or null. Large pictures are prepared on another thread and appear
  /// bit by bit. Returns the factor by which the picture was reduced for this driver: 1 if it was
  /// not reduced, 0 if the factor is not known yet or was returned before.
  int update_picture(std::shared_ptr<const Image> picture);
  /// Makes room for a picture that has been prepared, which can take as long as a frame. Returns
  /// whether there was one.
  bool allocate_texture();
  /// Whether the next frame will show more of the picture.
  bool is_uploading() const { return uploading_; }
  /// Takes the current map, and computes its heat map if `view` is one.
  void update_map(const LiveMap& map, View view, bool automatic_range);
  /// Draws the layer. Sets view and placement of `frame` to suit the map that was taken.
  void draw(const LiveMap& map, View view, RenderFrame frame);

  const HeatScale& heat_scale() const { return heat_scale_; }
  /// One value for each mesh vertex; empty without a heat map.
  const Eigen::VectorXd& heat_values() const { return heat_values_; }
  /// Whether the shader computes the positions of the vertices.
  bool by_operator() const { return by_operator_; }

 private:
  void update_heat(const LiveMap& map, View view, bool automatic_range);

  std::function<void()> wake_;
  Renderer renderer_;
  std::shared_ptr<TextureLevels> ready_;  ///< result of preparing_
  std::unique_ptr<Job> preparing_;
  bool uploading_ = false;
  int factor_ = 0;  ///< not returned yet; 0: none
  std::shared_ptr<const Image> picture_;
  Eigen::VectorXd heat_values_;
  HeatScale heat_scale_;
  std::shared_ptr<const Mesh> mesh_;
  unsigned uploaded_ = 0;  ///< number of the preparation; 0: none
  bool timed_ = false;     ///< the uploaded map is an in-between, not a sum of controls
  bool by_operator_ = false;
};

}  // namespace holomorph
