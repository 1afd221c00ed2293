// The coordinate systems of a bent drawing.
#pragma once

#include <vector>

#include "core/geometry/affine.h"
#include "core/maps/deformer.h"
#include "scene/formats/svg_document.h"

namespace holomorph {

/// Where the user units of copied elements lie. Elements with strokes, gradients or filters have
/// frames of their own. A frame is moved by the average of the map at some points of its content,
/// which is written as the element's transform.
class DrawingFrames {
 public:
  static constexpr size_t kResult = 0;  ///< the frame of the result

  /// A new frame inside another one. The node gets the transform. `to_picture` maps its user units
  /// to the picture's pixels, y down.
  size_t add(pugi::xml_node node, const Affine& to_picture, size_t parent);
  /// Adds a point of the content of a frame, and of those around it, in the picture's pixels. Of
  /// many points, only some are kept.
  void sample(size_t frame, Complex at);
  /// Finds where the frames lie. `map` takes points of the picture to the result, y down in both.
  void place(const PointValues& map);
  /// Whether the average is far from the map where some gradient is. Call place() before.
  bool should_bend_gradients() const { return should_bend_gradients_; }
  /// From a frame's user units to the result. Call place() before.
  const Affine& placement(size_t frame) const { return frames_[frame].placement; }
  /// Writes the transforms of all nodes. Call place() before.
  void write_transforms();

 private:
  struct Frame {
    size_t parent = 0;
    pugi::xml_node node = {};
    Affine to_picture = {};
    Points samples = {};
    Affine placement = {};
    size_t offered = 0, step = 1;  ///< every step-th point that is offered becomes a sample
  };
  std::vector<Frame> frames_{{}};  ///< parents come first
  bool should_bend_gradients_ = false;
};

}  // namespace holomorph
