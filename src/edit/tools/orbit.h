// A camera around a surface in space.
#pragma once

#include "core/mesh/surface.h"

namespace holomorph {

/// Looks at a point; y stays up. Angles are radians. Value type.
struct OrbitCamera {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  double yaw = 0, pitch = 0;  ///< of the camera seen from the target: 0, 0 is on +z
  double distance = 3;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of what is seen
  double radius = 1;                                 ///< around that

  bool operator==(const OrbitCamera&) const = default;

  /// All of a surface in a picture of this width / height, a little from the side of what most of
  /// its triangles face.
  static OrbitCamera around(const Surface& surface, double aspect);
  /// Turns with the pointer; half the height of the view, in px, is a quarter turn. Stops when it
  /// looks straight down or up.
  void turn_px(Complex delta, double height);
  /// What is in the target's distance follows the pointer.
  void pan_px(Complex delta, double height);
  /// Nearer by a factor, within bounds.
  void zoom(double factor);

  /// Surface to camera: a motion; the camera is at the origin and looks along -z.
  Eigen::Matrix4d to_view() const;
  /// From there to OpenGL's clip coordinates.
  Eigen::Matrix4d to_clip(double aspect) const;
};

}  // namespace holomorph
