// Benchmarks of maps without folds, and the comparison of published methods.
#include <algorithm>
#include <cstdio>

#include "bench/known_maps.h"
#include "bench/measures.h"
#include "bench/wavy.h"
#include "core/clock.h"
#include "core/compared/comparison.h"
#include "core/mesh/mesher.h"
#include "scene/prepared_map.h"

namespace holomorph::bench {
namespace {

/// A bar of 16 vertices with three pins. The benchmarks drag one of them until the reference folds.
Deformation pulled_bar() {
  Points bar;
  for (int i = 0; i < 8; ++i) bar.push_back({100.0 * i, 0});
  for (int i = 7; i >= 0; --i) bar.push_back({100.0 * i, 160});
  Deformation deformation = scene_with(bar);
  deformation.method = usual_method(MethodUse::bounds).id;
  for (const Complex z : {Complex(40, 80), Complex(350, 80), Complex(660, 80)})
    deformation.pins.push_back({z, z, {}, {}});
  return deformation;
}

/// Drags this pin of a deformation to `position` of each of the frames.
BoundedDrag drag_of(Deformation deformation, size_t pin,
                    const std::function<Complex(double time)>& position) {
  const auto prepared = prepared_map(deformation, Precision::single, {5000});
  constexpr int kFrames = 300;
  std::vector<double> times;
  BoundedDrag figures;
  SampledMap map;
  for (int frame = 0; frame < kFrames; ++frame) {
    deformation.pins[pin].pose = position(static_cast<double>(frame) / kFrames);
    const double start = now_ms();
    map = prepared->deformer->deform(pose_of(deformation), {false, true}, map.solution.get());
    times.push_back(now_ms() - start);
    figures.unproved += map.status != SampledMap::Status::certified;
  }
  figures.longest_ms = *std::ranges::max_element(times);
  std::ranges::nth_element(times, times.begin() + kFrames / 2);
  figures.median_ms = times[kFrames / 2];
  return figures;
}

}  // namespace

BoundedDrag bar_drag() {
  return drag_of(pulled_bar(), 2, [](double t) {
    return Complex(350, 80) + (310 - 280 * t) * std::polar(1.0, 7 * t);
  });
}

BoundedDrag bounded_drag(const Cage& cage, const std::string& reference) {
  const Method& method = usual_method(MethodUse::bounds);
  Deformation deformation;
  deformation.rest = deformation.pose = cage;
  deformation.method = method.id;
  for (const ParameterSpec& spec : method.parameters)
    if (spec.key == "reference")
      for (size_t i = 0; i < spec.options.size(); ++i)
        if (spec.options[i].id == reference)
          deformation.parameters[spec.key] = static_cast<double>(i);
  const Complex center = box_of(vertices_of(cage)).center();
  constexpr double kReach = 260;
  deformation.pins.push_back({center, center, {}, {}});
  for (int i = 0; i < 4; ++i) {
    const Complex z = center + kReach * std::polar(1.0, 0.3 + kPi / 2 * i);
    deformation.pins.push_back({z, z, {}, {}});
  }
  return drag_of(deformation, 1, [&](double t) {
    return center + (kReach - 240 * t) * std::polar(1.0, 0.3 + 7 * t);
  });
}

double bounded_solve_ms(int vertices, int samples, int runs) {
  const known_maps::Fineness fineness{vertices, samples};
  double slowest = 0;
  for (const known_maps::KnownMap& known : known_maps::all()) {
    const known_maps::Projection projection(known, {}, known_maps::Norm::l1, true, fineness);
    slowest = std::max(slowest,
                       median_ms(runs, [&] { projection.space->nearest(projection.reference); }));
  }
  return slowest;
}

double bounded_cold_ms(int runs) {
  Deformation deformation = pulled_bar();
  const auto prepared = prepared_map(deformation, Precision::single, {5000});
  deformation.pins[2].pose = Complex(350, 80) + 120.0 * std::polar(1.0, 3.0);
  SampledMap map;
  return median_ms(runs, [&] { map = prepared->deformer->deform(pose_of(deformation), {}); });
}

void compare_on_folded_bar(const std::function<void(const Result&)>& report) {
  Deformation deformation = pulled_bar();
  deformation.pins[2].pose = {180, 110};
  Rest rest = rest_of(deformation, Precision::full);
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(deformation.rest, {800}));
  compare(rest, pose_of(deformation), [&](const ComparedMap& row) {
    char detail[160];
    std::snprintf(detail, sizeof detail,
                  "max k %.4f, tau %.4f, %d flipped triangles, turning number %.3f, %d steps%s",
                  row.max_k, row.max_tau, row.flipped_triangles, row.turning_number, row.iterations,
                  row.settled ? "" : ", not converged");
    report({{std::string(kCompared) + row.label, "ms"}, row.milliseconds, 1, detail});
  });
}

}  // namespace holomorph::bench
