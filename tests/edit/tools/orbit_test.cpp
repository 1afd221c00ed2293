// The orbit camera: rigid motions, and points that follow the pointer.
#include "edit/tools/orbit.h"
#include "support/catch.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace holomorph::orbit_test {

namespace {

Surface slope() {
  Surface surface;
  surface.vertices = {{5, 1, 2}, {9, 1, 4}, {9, 6, 4}, {5, 6, 2}};
  surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  return surface;
}

/// Normalized device coordinates: clip coordinates after the perspective division.
Eigen::Vector3d shown(const OrbitCamera& camera, double aspect, const Eigen::Vector3d& p) {
  return (camera.to_clip(aspect) * camera.to_view() * p.homogeneous()).hnormalized();
}

}  // namespace

TEST_CASE("Orbit: the view is a rigid motion with the target straight ahead and y up") {
  OrbitCamera camera;
  camera.target = {3, -1, 2};
  for (const double yaw : {-2.0, 0.0, 0.7, 3.0})
    for (const double pitch : {-1.5, 0.0, 0.4}) {
      camera.yaw = yaw;
      camera.pitch = pitch;
      const Eigen::Matrix4d view = camera.to_view();
      const Eigen::Matrix3d turn = view.topLeftCorner<3, 3>();
      CHECK((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-14);
      CHECK_THAT(turn.determinant(), Catch::WithinAbs(1, 1e-14));
      const Eigen::Vector4d ahead = view * camera.target.homogeneous();
      CHECK((ahead.head<3>() - Eigen::Vector3d(0, 0, -camera.distance)).norm() < 1e-13);
      CHECK(turn.col(1).x() == Approx(0).margin(1e-14));
      CHECK(turn.col(1).y() > 0);
    }
  camera.yaw = camera.pitch = 0;
  CHECK(shown(camera, 1, camera.target + Eigen::Vector3d(0.1, 0, 0)).x() > 0);
  CHECK(shown(camera, 1, camera.target + Eigen::Vector3d(0, 0, 0.1)).z() <
        shown(camera, 1, camera.target).z());  // a nearer point has a smaller depth
}

TEST_CASE("Orbit: the initial view shows all of a surface from its front") {
  const Surface surface = slope();
  for (const double aspect : {0.3, 1.0, 2.5}) {
    const OrbitCamera camera = OrbitCamera::around(surface, aspect);
    for (const Eigen::Vector3d& p : surface.vertices)
      CHECK(shown(camera, aspect, p).cwiseAbs().maxCoeff() < 1);
    const auto at = [&](int i) -> Eigen::Vector2d {
      return shown(camera, aspect, surface.vertices[i]).head<2>();
    };
    const Eigen::Vector2d u = at(1) - at(0), v = at(2) - at(0);
    CHECK(u.x() * v.y() - u.y() * v.x() > 0);
  }
}

TEST_CASE(
    "Orbit: a drag turns the front with the pointer, and panning keeps the target under the "
    "pointer") {
  OrbitCamera camera = OrbitCamera::around(slope(), 1);
  camera.yaw = 0.4;
  camera.pitch = 0.3;
  const double height = 400;
  const Eigen::Vector3d front = camera.to_view().inverse().topLeftCorner<3, 3>().col(2);
  const Eigen::Vector3d nearest = camera.target + 0.5 * camera.radius * front;
  const Eigen::Vector3d before = shown(camera, 1, nearest);
  OrbitCamera turned = camera;
  turned.turn_px({10, 0}, height);
  CHECK(shown(turned, 1, nearest).x() > before.x());
  turned = camera;
  turned.turn_px({0, 10}, height);  // y points down in window pixels
  CHECK(shown(turned, 1, nearest).y() < before.y());
  turned.turn_px({0, 1e5}, height);
  CHECK(turned.pitch < kPi / 2);

  OrbitCamera moved = camera;
  moved.pan_px({30, 50}, height);
  const Eigen::Vector3d at = shown(moved, 1, camera.target);
  // In pixels: a dozen operations on coordinates below 16, each rounded to 2^-50, times the 60
  // pixels per unit.
  constexpr double kRoundingPx = 1e-12;
  CHECK_THAT(at.x() * height / 2, Catch::WithinAbs(30, kRoundingPx));
  CHECK_THAT(at.y() * height / 2, Catch::WithinAbs(-50, kRoundingPx));

  moved.pan_px({1e6, -1e6}, height);  // the surface stays between the clipping planes
  moved.turn_px({200, 0}, height);
  for (const Eigen::Vector3d& p : slope().vertices) CHECK(std::abs(shown(moved, 1, p).z()) < 1);

  OrbitCamera near = camera;
  near.zoom(2);
  CHECK(near.distance == camera.distance / 2);
  near.zoom(1e9);
  CHECK(near.distance > 0);
  CHECK(shown(near, 1, near.target).z() < 1);
  near.zoom(1e-9);
  CHECK(near.distance < 1e3 * camera.radius);
}

}  // namespace holomorph::orbit_test
