// Benchmarks of drags of an elastic sheet, with the drawn mesh and the proof.
#include <algorithm>

#include "bench/measures.h"
#include "core/clock.h"
#include "scene/prepared_map.h"
#include "system/memory.h"

namespace holomorph::bench {
namespace {

/// A photograph of 12 megapixels in its frame, with ten pins.
Deformation photograph() {
  Deformation deformation =
      with_cage(Deformation{}, Points{{0, 0}, {4000, 0}, {4000, 3000}, {0, 3000}});
  deformation.frame = Frame::slide;
  for (int k = 0; k < 10; ++k) {
    const Complex z(2000 + 1200 * std::cos(1.9 * k), 1500 + 900 * std::sin(2.3 * k + 0.4));
    deformation.pins.push_back({z, z, {}, {}});
  }
  return deformation;
}

/// A body with eight limbs, and pins in all of them and in the middle.
Deformation limbs() {
  Points outline;
  for (const Complex& z : limbed_body()) outline.push_back(z);
  Deformation deformation = with_cage(Deformation{}, outline);
  for (const Complex z : {Complex(0, 0), {20, 30}}) deformation.pins.push_back({z, z, {}, {}});
  for (int limb = 0; limb < 8; ++limb) {
    const Complex z = std::polar(280.0, 2 * kPi * limb / 8);
    deformation.pins.push_back({z, z, {}, {}});
  }
  return deformation;
}

}  // namespace

SheetFigures sheet_drag(SheetScene scene) {
  Deformation deformation = scene == SheetScene::photograph ? photograph() : limbs();
  deformation.method = "sheet";
  const double size = box_of(vertices_of(deformation.rest)).diagonal(),
               reach = scene == SheetScene::photograph ? 0.12 : 0.25;
  SheetFigures figures;
  return_freed_memory();
  const double before_mb = resident_mb();
  const auto prepared = prepared_map(deformation, Precision::single, MeshOptions{});
  figures.preparation_ms = prepared->milliseconds;
  const Complex from = deformation.pins[3].rest;
  Pose pose = pose_of(deformation);
  SampledMap map = prepared->deformer->deform(pose, {});
  std::vector<double> times;
  constexpr int kFrames = 300;
  for (int frame = 1; frame <= kFrames; ++frame) {
    const double t = static_cast<double>(frame) / kFrames;
    pose.pins[3].position = from + reach * size * std::sin(kPi * t) * std::polar(1.0, 2 + 2 * t);
    const double start = now_ms();
    map =
        prepared->deformer->deform(pose, {.derivatives = true, .draft = true}, map.solution.get());
    times.push_back(now_ms() - start);
    figures.unproved += map.status != SampledMap::Status::certified;
    if (frame != kFrames / 2) continue;
    Pose released = pose;
    for (size_t i = 0; i < released.pins.size(); ++i) released.pins[i].turn = map.turns[i];
    std::vector<double> finals;
    SampledMap last;
    for (int run = 0; run < 3; ++run) {
      const double begin = now_ms();
      last = prepared->deformer->deform(released, {.derivatives = true});
      finals.push_back(now_ms() - begin);
    }
    std::ranges::sort(finals);
    figures.final_ms = finals[1];
    figures.unproved += last.status != SampledMap::Status::certified;
  }
  figures.megabytes = resident_mb() - before_mb;
  figures.longest_ms = *std::ranges::max_element(times);
  std::ranges::nth_element(times, times.begin() + kFrames / 2);
  figures.median_ms = times[kFrames / 2];
  return figures;
}

}  // namespace holomorph::bench
