// Drags of maps without folds. A pin is pulled past the middle until the followed map folds.
#include <algorithm>

#include "bench/measures.h"
#include "core/clock.h"
#include "core/methods/linear.h"
#include "scene/prepared_map.h"

namespace holomorph::bench {

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
  const auto prepared = prepared_map(deformation, Precision::single, {5000});
  constexpr int kFrames = 300;
  std::vector<double> times;
  BoundedDrag figures;
  SampledMap map;
  for (int frame = 0; frame < kFrames; ++frame) {
    const double t = static_cast<double>(frame) / kFrames;
    deformation.pins[1].pose = center + (kReach - 240 * t) * std::polar(1.0, 0.3 + 7 * t);
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

}  // namespace holomorph::bench
