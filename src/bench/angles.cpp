// Benchmarks of angle maps and keyframe playback.
#include <numeric>
#include <optional>

#include "bench/measures.h"
#include "core/angles/angle_map.h"
#include "core/angles/boundary_angles.h"
#include "core/mesh/inbetween.h"
#include "core/mesh/mesher.h"
#include "scene/keyframes.h"
#include "scene/live_map.h"

namespace holomorph::bench {
namespace {

/// A star with 20 vertices. All of them are corners, so there are 40 angles.
Points star() {
  Points star;
  for (int i = 0; i < 20; ++i)
    star.push_back(Complex(500, 500) + std::polar(i % 2 ? 300.0 : 400.0, 2 * kPi * i / 20));
  return star;
}

constexpr int kAngleMeshVertices = 8700;  ///< vertices to request for a mesh of about 10000

Deformation star_scene() {
  Deformation deformation;
  deformation.rest = deformation.pose = polygon_cage(star());
  deformation.method = usual_method(MethodUse::corners).id;
  for (Index v = 0; v < deformation.rest.size(); ++v) deformation.corners.push_back({v, {}, {}});
  deformation.corners[3].pose = {0.2, 0.3, 1};
  return deformation;
}

}  // namespace

double angles_prepare_ms(int runs) {
  const Cage cage = polygon_cage(star());
  const Mesh mesh = domain_mesh(cage, {kAngleMeshVertices});
  std::vector<Index> all(20);
  std::iota(all.begin(), all.end(), 0);
  return median_ms(runs, [&] {
    const auto coordinates =
        std::make_shared<const HilbertCoordinates>(cage, corner_values(cage, all));
    AngleMap(mesh, coordinates, mesh.vertices, Precision::single);
  });
}

double angles_drag_ms(int runs) {
  Deformation deformation = star_scene();
  const auto prepared = prepared_map(deformation, Precision::single, {kAngleMeshVertices});
  SampledMap map;
  return median_ms(runs, [&] {
    deformation.corners[7].pose.before += 1e-3;
    deformation.corners[7].pose.after += 1e-3;
    map = prepared->deformer->deform(pose_of(deformation), {false, true}, map.solution.get());
  });
}

double angles_pose_ms(int runs) {
  Deformation deformation = star_scene();
  const auto prepared = prepared_map(deformation, Precision::single, {kAngleMeshVertices});
  SampledMap map;
  return median_ms(runs, [&] { map = prepared->deformer->deform(pose_of(deformation), {}); });
}

double playback_ms(int runs) {
  Deformation deformation = star_scene();
  deformation = with_key(std::move(deformation), 0);
  deformation.corners[10].pose = {1, 1.2, 1};
  deformation = with_key(std::move(deformation), 1);
  const std::shared_ptr<PreparedMap> prepared =
      prepared_map(deformation, Precision::single, {kAngleMeshVertices});
  Motion motion;
  motion.follow(deformation, false, prepared);
  double time = 0;
  return median_ms(runs, [&] {
    time = time < 0.9 ? time + 0.01 : 0.01;
    const VectorXc f = motion.map_at(time);
    motion.deformation_at(deformation, time, f);
  });
}

double inbetween_loss_percent(bool linear_blend) {
  const auto mesh = std::make_shared<const Mesh>(
      domain_mesh(Points{{0, 0}, {600, 0}, {600, 100}, {0, 100}}, {3000}));
  const auto rolled = [&](double angle) {
    const double a = angle / 600;
    VectorXc f(static_cast<Index>(mesh->vertices.size()));
    for (Index i = 0; i < f.size(); ++i) {
      const Complex z = mesh->vertices[static_cast<size_t>(i)] - Complex(0, 50);
      f[i] = a == 0 ? z : (std::exp(kI * a * z) - 1.0) / (kI * a);
    }
    return f;
  };
  const auto area = [&](const VectorXc& f) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh->triangles) sum += 0.5 * cross(f[b] - f[a], f[c] - f[a]);
    return sum;
  };
  const VectorXc flat = rolled(0), bent = rolled(1.5 * kPi);
  const Inbetween between(mesh);
  const Inbetween::Shape a = between.shape_of(flat),
                         b = between.shape_after(a, between.shape_of(bent), {Complex(1, 50), 0});
  double worst = 0;
  for (int k = 1; k < 20; ++k) {
    const double u = k / 20.0;
    VectorXc f = (1 - u) * flat + u * bent;
    if (!linear_blend) between.blend({a, b}, u, f);
    const double wanted = std::pow(area(flat), 1 - u) * std::pow(area(bent), u);
    worst = std::max(worst, std::abs(area(f) / wanted - 1));
  }
  return 100 * worst;
}

}  // namespace holomorph::bench
