// Benchmarks of pixels: maps at every pixel, pictures, films, and cages around pictures.
#include <cstdlib>
#include <fstream>
#include <functional>

#include "bench/measures.h"
#include "bench/wavy.h"
#include "core/clock.h"
#include "core/methods/linear.h"
#include "raster/picture.h"
#include "raster/raster.h"
#include "raster/unwarp.h"
#include "scene/auto_cage.h"
#include "scene/keyframes.h"
#include "scene/prepared_map.h"
#include "scene/timed_map.h"

namespace holomorph::bench {
namespace {

Image gradient(int side) {
  Image image(side, side);
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c) {
      std::uint8_t* p = image.at(c, r);
      p[0] = static_cast<std::uint8_t>(c), p[1] = static_cast<std::uint8_t>(r),
      p[2] = static_cast<std::uint8_t>(c ^ r);
      p[3] = 255;
    }
  return image;
}

double every_pixel_ms(const std::function<void(const Scene&, const Image&)>& work) {
  const Image image = gradient(2000);
  Deformation deformation = scene_with(wavy(32, {1000, 1000}, 780));
  for (const Complex z : {Complex(600, 900), Complex(1000, 1500), Complex(1300, 800)})
    deformation.pins.push_back({z, z + Complex(60, 40), {}, {}});
  deformation.strokes.push_back(
      {{{700, 700}, {1000, 750}, {1300, 700}}, {{700, 740}, {1000, 730}, {1300, 760}}, {}});
  double slowest = 0;
  for (const Method& method : methods()) {
    deformation.method = method.id;
    const Scene scene = scene_of(deformation);
    const double start = now_ms();
    work(scene, image);
    slowest = std::max(slowest, now_ms() - start);
  }
  return slowest;
}

/// A wavy cage of 32 points and three pins in a picture of 1000 x 1000, with a keyframe every two
/// seconds.
Deformation moving_shape(const char* method, int keys) {
  Deformation deformation = scene_with(wavy(32, {500, 500}, 390));
  deformation.method = method;
  for (const Complex z : {Complex(300, 450), Complex(500, 750), Complex(650, 400)})
    deformation.pins.push_back({z, z, {}, {}});
  for (int key = 0; key < keys; ++key) {
    for (Pin& pin : deformation.pins) pin.pose = pin.rest + 30.0 * std::polar(1.0, 2.0 * key);
    deformation = with_key(std::move(deformation), 2.0 * key);
  }
  return deformation;
}

}  // namespace

double resident_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::atof(line.c_str() + 6) / 1024;
  return 0;
}

double st_map_ms() {
  return every_pixel_ms([](const Scene& scene, const Image& image) {
    TimedMap map(scene);
    st_map_of(map, image);
  });
}

double unwarp_ms() {
  return every_pixel_ms([](const Scene& scene, const Image& image) { unwarped(scene, &image); });
}

double export_ms(int side, int vertices, int runs, int threads) {
  const Image image = gradient(side);
  const Deformation deformation = scene_with(wavy(vertices, {side / 2.0, side / 2.0}, 0.39 * side));
  const auto prepared = prepared_map(deformation, Precision::single, MeshOptions{});
  return median_ms(runs, [&] {
    SampledMap map = prepared->deformer->deform(pose_of(deformation), {});
    RasterJob job;
    job.mesh = prepared->mesh.get();
    job.positions = as_span(map.f);
    job.source = &image;
    job.threads = threads;
    rasterized(job);
  });
}

double film_frame_ms(const char* method) {
  constexpr int kFrames = 100;
  const Image image = gradient(1000);
  Scene scene = scene_of(moving_shape(method, 3));
  const double start = now_ms();
  PictureMaker maker(scene, &image);
  PictureOptions options{};
  options.region = maker.motion_region();
  for (int frame = 0; frame < kFrames; ++frame) {
    options.time = frame / scene.animation.frames_per_second;
    maker.picture(options);
  }
  return (now_ms() - start) / kFrames;
}

double many_keys_ratio(int runs) {
  const Image image = gradient(1000);
  const auto frame_ms = [&](int keys) {
    const Scene scene = scene_of(moving_shape("puppet", keys));
    PictureOptions options;
    options.time = 3;
    return median_ms(runs, [&] { picture_of(scene, &image, options); });
  };
  const double few = frame_ms(4);
  return frame_ms(200) / few;
}

double auto_cage_ms(int runs) {
  Image image(2000, 2000);
  const Points shape = wavy(400, {1000, 1000}, 700);
  for (int r = 0; r < image.height; r += 1)
    for (int c = 0; c < image.width; ++c) {
      const Complex z = Complex(c, 2000 - r) - Complex(1000, 1000);
      image.at(c, r)[3] = std::abs(z) < 700 * (1 + 0.25 * std::sin(5 * std::arg(z))) ? 255 : 0;
    }
  return median_ms(runs, [&] { auto_cage(image); });
}

double memory_mb() {
  const Image image = gradient(2000);
  const Deformation deformation = scene_with(wavy(32, {1000, 1000}, 780));
  const auto prepared = prepared_map(deformation, Precision::single, MeshOptions{});
  SampledMap map = prepared->deformer->deform(pose_of(deformation), {true});
  return resident_mb();
}

}  // namespace holomorph::bench
