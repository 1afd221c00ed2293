// A camera around a surface in space.
#pragma once

#include "core/mesh/surface.h"

namespace holomorph {

/// An orbit camera, which looks at `target` with the y axis up. Angles are in radians. Value type.
struct OrbitCamera {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  double yaw = 0, pitch = 0;  ///< direction from the target to the camera: 0, 0 is +z
  double distance = 3;        ///< from the target to the camera
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< center of the surface's bounding sphere
  double radius = 1;                                 ///< radius of the bounding sphere

  bool operator==(const OrbitCamera&) const = default;

  /// A camera that sees all of a surface in a view with this aspect ratio (width divided by
  /// height). It looks at the side that the surface faces on average, from a slight angle, because
  /// a relief seen from the front looks flat.
  static OrbitCamera around(const Surface& surface, double aspect);
  /// Orbits with the pointer: a drag over half the height of the view, in px, is a quarter turn.
  /// The pitch stops just before the camera looks straight up or down.
  void turn_px(Complex delta, double height);
  /// Pans so that points at the target's distance follow the pointer.
  void pan_px(Complex delta, double height);
  /// Divides the distance by a factor, within bounds that depend on the radius.
  void zoom(double factor);

  /// The rigid motion from surface to camera coordinates. The camera is at the origin and looks
  /// along -z.
  Eigen::Matrix4d to_view() const;
  /// The projection from camera coordinates to OpenGL's clip coordinates.
  Eigen::Matrix4d to_clip(double aspect) const;
};

}  // namespace holomorph
