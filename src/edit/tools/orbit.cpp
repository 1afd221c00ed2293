// A perspective camera with a vertical field of view of 30 degrees.
#include "edit/tools/orbit.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace holomorph {
namespace {

constexpr double kHalfAngle = kPi / 12;
constexpr double kSteepest = 0.499 * kPi;

Eigen::Matrix3d turned(double yaw, double pitch) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(pitch, Vector3d::UnitX()) * AngleAxisd(-yaw, Vector3d::UnitY()))
      .toRotationMatrix();
}

}  // namespace

OrbitCamera OrbitCamera::around(const Surface& surface, double aspect) {
  constexpr double kAside = 0.45, kAbove = 0.2;  // seen from the front, a relief looks flat
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : surface.vertices) box.extend(p);
  Eigen::Vector3d facing = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : surface.triangles) {
    const auto at = [&](int v) { return surface.vertices[static_cast<size_t>(v)]; };
    facing += (at(b) - at(a)).cross(at(c) - at(a));
  }
  OrbitCamera camera;
  camera.target = camera.middle = box.center();
  camera.radius = 1e-9;
  for (const Eigen::Vector3d& p : surface.vertices)
    camera.radius = std::max(camera.radius, (p - camera.target).norm());
  if (facing.norm() > 0) {
    facing.normalize();
    camera.yaw = std::atan2(facing.x(), facing.z());
    camera.pitch = std::asin(std::clamp(facing.y(), -1.0, 1.0));
  }
  camera.yaw -= kAside;
  camera.pitch = std::clamp(camera.pitch + kAbove, -kSteepest, kSteepest);
  const double half = std::atan(std::tan(kHalfAngle) * std::min(1.0, aspect));
  camera.distance = camera.radius / std::sin(half);
  return camera;
}

void OrbitCamera::turn_px(Complex delta, double height) {
  const double per_px = kPi / std::max(height, 1.0);
  yaw = std::remainder(yaw - per_px * delta.real(), 2 * kPi);
  pitch = std::clamp(pitch + per_px * delta.imag(), -kSteepest, kSteepest);
}

void OrbitCamera::pan_px(Complex delta, double height) {
  const double per_px = 2 * distance * std::tan(kHalfAngle) / std::max(height, 1.0);
  target += turned(yaw, pitch).transpose() *
            Eigen::Vector3d(-per_px * delta.real(), per_px * delta.imag(), 0);
  // Limit panning to keep the surface between the clipping planes.
  const Eigen::Vector3d off = target - middle;
  if (off.norm() > 2 * radius) target = middle + 2 * radius * off.normalized();
}

void OrbitCamera::zoom(double factor) {
  distance = std::clamp(distance / factor, 0.2 * radius, 40 * radius);
}

Eigen::Matrix4d OrbitCamera::to_view() const {
  const Eigen::Matrix3d turn = turned(yaw, pitch);
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.topLeftCorner<3, 3>() = turn;
  view.topRightCorner<3, 1>() = -turn * target - Eigen::Vector3d(0, 0, distance);
  return view;
}

Eigen::Matrix4d OrbitCamera::to_clip(double aspect) const {
  const double near = std::max(distance - 3 * radius, 0.01 * distance), far = distance + 3 * radius,
               height = 1 / std::tan(kHalfAngle);
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = height / aspect;
  clip(1, 1) = height;
  clip(2, 2) = (near + far) / (near - far);
  clip(2, 3) = 2 * near * far / (near - far);
  clip(3, 2) = -1;
  return clip;
}

}  // namespace holomorph
