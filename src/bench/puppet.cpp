// Benchmarks of drags with pins: a body with eight limbs, of which one is dragged.
#include <algorithm>

#include "bench/measures.h"
#include "core/clock.h"
#include "core/isometric/isometric_space.h"
#include "core/isometric/mesh_display.h"
#include "core/maps/distortion.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"

namespace holomorph::bench {
namespace {

constexpr int kLimbs = 8;

}  // namespace

Points limbed_body() {
  Points outline;
  for (int limb = 0; limb < kLimbs; ++limb) {
    const double middle = 2 * kPi * limb / kLimbs;
    for (const auto& [radius, side] :
         {std::pair(100.0, -0.3), std::pair(200.0, -0.1), std::pair(300.0, -0.05),
          std::pair(300.0, 0.05), std::pair(200.0, 0.1), std::pair(100.0, 0.3)})
      outline.push_back(std::polar(radius, middle + side));
  }
  return outline;
}

namespace {

/// The drag that all figures are about: one limb swings out and back.
Complex dragged_by(double t) {
  return 150 * std::sin(kPi * t) * std::polar(1.0, 2 + 2 * t);
}

/// The energy of As rigid as possible, without the handles.
double rigid_energy(const Mesh& mesh, const VectorXc& f) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto [fz, fzbar] = derivatives_in(mesh, t, f);
    const double bent = std::abs(fz) - 1;
    const auto corner = [&](int k) { return mesh.vertices[static_cast<size_t>(t[k])]; };
    sum += 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0)) *
           (bent * bent + std::norm(fzbar));
  }
  return sum;
}

}  // namespace

RigidFigures rigid_drag(int vertices) {
  Rest rest;
  rest.cage = polygon_cage(limbed_body());
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {vertices}));
  rest.samples = rest.mesh->vertices;
  rest.pins = {{{0, 0}}, {{20, 30}}};
  for (int limb = 0; limb < kLimbs; ++limb)
    rest.pins.push_back({std::polar(280.0, 2 * kPi * limb / kLimbs)});
  const auto deformer = method_named("arap").prepare(rest, nullptr);
  Pose pose{rest.cage, {}};
  for (const RestPin& pin : rest.pins) pose.pins.push_back({pin.position});
  RigidFigures figures;
  std::vector<double> times;
  SampledMap map = deformer->deform(pose, {});
  constexpr int kFrames = 60, kComparedEvery = 3;
  int behind = 0, compared = 0;
  for (int frame = 1; frame <= kFrames; ++frame) {
    pose.pins[3].position =
        rest.pins[3].position + dragged_by(static_cast<double>(frame) / kFrames);
    const double start = now_ms();
    map = deformer->deform(pose, {.draft = true}, map.solution.get());
    times.push_back(now_ms() - start);
    if (frame % kComparedEvery != 0 || frame == kFrames) continue;
    SampledMap converged = map;
    for (int more = 0; more < 60; ++more)
      converged = deformer->deform(pose, {.draft = true}, converged.solution.get());
    const double least = rigid_energy(*rest.mesh, converged.f),
                 above = 100 * (rigid_energy(*rest.mesh, map.f) - least) / least;
    figures.above_percent = std::max(figures.above_percent, above);
    behind += above > 1;
    ++compared;
  }
  std::ranges::nth_element(times, times.begin() + kFrames / 2);
  figures.median_ms = times[kFrames / 2];
  figures.behind_percent = 100.0 * behind / compared;
  return figures;
}

PuppetFigures puppet_drag(int vertices) {
  const Cage cage = polygon_cage(limbed_body());
  const Mesh mesh = domain_mesh(cage, {10000});
  const auto basis = std::make_shared<const BoundaryBasis>(cage, vertices, 6 * vertices);
  IsometricHandles handles;
  handles.stations = {{0, 0}, {20, 30}};
  for (int limb = 0; limb < kLimbs; ++limb)
    handles.stations.push_back(std::polar(280.0, 2 * kPi * limb / kLimbs));
  const Index pins = static_cast<Index>(handles.stations.size());
  handles.turned = pins;
  handles.weights = VectorXd::Ones(pins);
  const IsometricSpace space(basis, mesh, handles, area_samples(mesh, 300), {}, {});
  const MeshDisplay display(*basis, mesh);

  IsometricTarget target;
  target.stations = VectorXc::Zero(pins);
  const IsometricSpace::Settings settings;
  IsometricMap map = space.solved(target, settings);
  PuppetFigures figures;
  std::vector<double> times;
  MeshDisplay::Values shown;
  int behind = 0, compared = 0;
  constexpr int kFrames = 120, kComparedEvery = 10;
  for (int frame = 1; frame <= kFrames; ++frame) {
    const double t = static_cast<double>(frame) / kFrames;
    target.stations[3] = dragged_by(t);
    const double start = now_ms();
    map = space.followed(target, settings, map);
    shown = display.values(map.map);
    times.push_back(now_ms() - start);
    figures.unproved += !map.certificate.holds;
    if (frame % kComparedEvery != 0) continue;
    ++compared;
    const IsometricMap converged = space.solved(target, settings, map.turns);
    constexpr double kClose = 1.05;
    behind += map.solution.total > kClose * converged.solution.total;
  }
  figures.behind_percent = 100.0 * behind / compared;
  figures.longest_ms = *std::ranges::max_element(times);
  std::ranges::nth_element(times, times.begin() + kFrames / 2);
  figures.median_ms = times[kFrames / 2];
  return figures;
}

}  // namespace holomorph::bench
