// Each benchmark is one entry in the table kEntries.
#include "bench/bench.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <random>

#include "bench/known_maps.h"
#include "bench/measures.h"
#include "bench/wavy.h"
#include "core/cauchy/cauchy.h"
#include "core/clock.h"
#include "core/compared/comparison.h"
#include "core/error.h"
#include "core/maps/distortion.h"
#include "core/maps/inverse.h"
#include "core/mesh/mesher.h"
#include "core/methods/linear.h"
#include "raster/picture.h"
#include "raster/raster.h"
#include "raster/unwarp.h"
#include "scene/auto_cage.h"
#include "scene/keyframes.h"
#include "scene/live_map.h"
#include "scene/timed_map.h"

namespace holomorph::bench {
namespace {

Deformation scene_with(const Points& polygon) {
  Deformation deformation;
  deformation.rest = deformation.pose = polygon_cage(polygon);
  for (Points& segment : deformation.pose.segments)
    segment[0] += 20.0 * std::sin(segment[0].imag() / 100);
  return deformation;
}

/// The number of vertices to request for a mesh of about 15000.
constexpr int kRequestedVertices = 13000;

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

double resident_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::atof(line.c_str() + 6) / 1024;
  return 0;
}

struct Entry {
  const char* name;
  const char* unit;
  std::optional<double> goal;
  int runs;
  double (*measure)(int runs);
  const char* larger = "";                       ///< what is twice as large in the next measurement
  double (*measure_larger)(int runs) = nullptr;  ///< shows how the result grows
};

double coordinates_ns(Kernel kernel, int order, int runs) {
  const Points cage = wavy(100, {500, 500}, 350);
  const Mesh mesh = domain_mesh(cage, {kRequestedVertices});
  PlanarMatrix<float> out;
  const double ms = median_ms(runs, [&] {
    planar_coordinates<float>(polygon_cage(cage), mesh.vertices, order, kernel, out);
  });
  return ms * 1e6 / (static_cast<double>(mesh.vertices.size()) * 100);
}

/// Points in the cage in random order, per point and edge.
double random_coordinates_ns(int runs) {
  const Points cage = wavy(32, {500, 500}, 350);
  std::mt19937 random(1);
  Points points;
  while (points.size() < 15000) {
    const auto unit = [&] { return 1000.0 * static_cast<double>(random()) / 4294967296.0; };
    const double x = unit(), y = unit();
    if (encloses(PolygonView(cage), {x, y})) points.push_back({x, y});
  }
  PlanarMatrix<float> out;
  const double ms = median_ms(runs, [&] {
    planar_coordinates<float>(polygon_cage(cage), points, 0,
                              has_avx2() ? Kernel::avx2 : Kernel::portable, out);
  });
  return ms * 1e6 / (static_cast<double>(points.size()) * 32);
}

/// Points in a picture of 1000 x 1000 pixels, and their derivatives, as Python gets them.
double million_points_ms(int runs) {
  TimedMap map(scene_with(wavy(32, {500, 500}, 350)));
  const TimedFrame frame = map.frame({});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 1000);
  std::array<Points, 2> points;
  for (Points& each : points)
    for (int i = 0; i < 1'000'000; ++i) each.push_back({place(random), place(random)});
  size_t call = 0;  // at() keeps what it prepared for the last points, so the points alternate
  return median_ms(runs, [&] { map.values_in_cage(frame, points[call++ % 2]); });
}

double scalar_log_ns(int runs) {
  const Points cage = wavy(100, {500, 500}, 350);
  const Mesh mesh = domain_mesh(cage, {1500});
  volatile double sum = 0;  // volatile keeps the compiler from removing the loop
  const double ms = median_ms(runs, [&] {
    for (const Complex& z : mesh.vertices)
      for (size_t e = 0; e < cage.size(); ++e)
        sum = std::log((cage[(e + 1) % cage.size()] - z) / (cage[e] - z)).imag();
  });
  return ms * 1e6 / (static_cast<double>(mesh.vertices.size()) * 100);
}

double curved_prepare_ms(int runs) {
  Deformation deformation;
  deformation.rest = wavy_curves(20, 3, 0.2);
  deformation.pose = wavy_curves(20, 3, 0.1);
  return median_ms(runs, [&] { prepared_map(deformation, Precision::single, {8700}); });
}

/// The composition through an intermediate polygon (Lin and Chen 2024, section 4.3): u2 after the
/// inverse of u1, where u1 maps the polygon of the segments' endpoints to the curved rest cage.
/// Measures what percentage of the domain's samples have no preimage under u1, and how long it
/// takes to set up the composition and find the preimages.
struct PolygonRoute {
  double missing_percent = 0, milliseconds = 0;
};

PolygonRoute polygon_route() {
  const Cage rest = wavy_curves(20, 3, 0.2);
  const Mesh domain = domain_mesh(rest, {8700});
  const double start = now_ms();
  const Cage polygon = elevated_to(polygon_cage(vertices_of(rest)), rest);
  const Mesh mesh = domain_mesh(vertices_of(rest), {4000});
  SumMap u1;
  u1.terms.emplace_back(polygon, controls_of(rest) - controls_of(polygon));
  Points image;
  for (const Complex& z : mesh.vertices) image.push_back(u1.at(z).f);
  const InverseMap inverse(polygon, mesh, image, u1);
  int missing = 0;
  for (const Complex& z : domain.vertices) missing += inverse.at(z).empty();
  return {100.0 * missing / static_cast<double>(domain.vertices.size()), now_ms() - start};
}

/// The time that it takes, per point and edge, to compute the coordinates of a straight cage whose
/// pose has this degree.
double raised_coordinates_ns(int degree, int runs) {
  const Cage straight = polygon_cage(wavy(100, {500, 500}, 350));
  Cage raised = straight;
  for (Points& segment : raised.segments) segment.resize(degree);
  raised = elevated_to(straight, raised);
  const Mesh mesh = domain_mesh(straight, {kRequestedVertices});
  PlanarMatrix<float> out;
  const double ms = median_ms(runs, [&] {
    planar_coordinates<float>(raised, mesh.vertices, 0,
                              has_avx2() ? Kernel::avx2 : Kernel::portable, out);
  });
  return ms * 1e6 / (static_cast<double>(mesh.vertices.size()) * 100);
}

/// The time to find 10000 preimages for a pose of 20 cubic segments, without setting up the
/// inverse.
double inverse_ms(int runs) {
  Deformation deformation;
  deformation.rest = polygon_cage(wavy(20, {500, 500}, 350));
  deformation.pose = wavy_curves(20, 3, 0.15);
  TimedMap map(deformation);
  const auto inverse = map.inverse(map.frame({}));
  const Mesh& mesh = map.mesh();
  Points targets;  // a quarter of them near the boundary
  for (size_t i = 0; i < 10000; ++i) {
    const Triangle& t = mesh.triangles[i * 7919 % mesh.triangles.size()];
    const size_t b = i % mesh.boundary.size(), next = (b + 1) % mesh.boundary.size();
    const Complex center = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0,
                  side = mesh.vertices[mesh.boundary[next]] - mesh.vertices[mesh.boundary[b]],
                  edge = mesh.vertices[mesh.boundary[b]] + (0.5 + 1e-4 * kI) * side;
    targets.push_back(inverse->map->at(i % 4 ? center : edge).f);
  }
  return median_ms(runs, [&] { inverse->at(targets); });
}

/// The time of the slowest method for the map at every pixel of a picture of 2000 x 2000, which a
/// cage of 32 points and three pins bend.
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

/// Figures for a drag of 300 frames: the median frame time, the longest frame time, and the number
/// of frames that were not certified.
enum class DragFigure { median, longest, unproved };

double bar_drag(DragFigure figure) {
  Deformation deformation = pulled_bar();
  const auto prepared = prepared_map(deformation, Precision::single, {5000});
  std::vector<double> times;
  int unproved = 0;
  SampledMap map;
  for (int frame = 0; frame < 300; ++frame) {
    const double t = frame / 300.0;
    deformation.pins[2].pose = Complex(350, 80) + (310 - 280 * t) * std::polar(1.0, 7 * t);
    const double start = now_ms();
    map = prepared->deformer->deform(pose_of(deformation), {false, true}, map.solution.get());
    times.push_back(now_ms() - start);
    unproved += map.status != SampledMap::Status::certified;
  }
  if (figure == DragFigure::unproved) return unproved;
  if (figure == DragFigure::longest) return *std::max_element(times.begin(), times.end());
  std::nth_element(times.begin(), times.begin() + 150, times.end());
  return times[150];
}

Cage wavy_points(int n) {
  return polygon_cage(wavy(n, {500, 500}, 350));
}

/// The median time to project and prove the slowest of the known maps, from a cold start.
double bounded_solve_ms(known_maps::Fineness fineness, int runs) {
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

double prepare_ms(int points, int runs) {
  const Deformation deformation = scene_with(wavy(points, {500, 500}, 350));
  return median_ms(runs,
                   [&] { prepared_map(deformation, Precision::single, {kRequestedVertices}); });
}

/// The time that a method needs to prepare its map of a cage of this many points, on a mesh of
/// about 9000 vertices that exists already.
double prepare_method_ms(const char* method, int points, int runs) {
  Deformation deformation = scene_with(wavy(points, {500, 500}, 350));
  const auto before = prepared_map(deformation, Precision::single, {7500});
  deformation.method = method;
  for (const Complex z : {Complex(400, 450), Complex(500, 650), Complex(600, 400)})
    deformation.pins.push_back({z, z, {}, {}});
  const Points stroke{{400, 500}, {500, 520}, {600, 500}};
  deformation.strokes.push_back({stroke, stroke, {}});
  return median_ms(runs,
                   [&] { prepared_map(deformation, Precision::single, {7500}, before.get()); });
}

double coordinates_ms(int runs) {
  const Points cage = wavy(100, {500, 500}, 350);
  const Mesh mesh = domain_mesh(cage, {kRequestedVertices});
  return median_ms(runs, [&] { planar_coordinates<float>(polygon_cage(cage), mesh.vertices); });
}

double frame_ms(int runs) {
  const Deformation deformation = scene_with(wavy(100, {500, 500}, 350));
  const auto prepared = prepared_map(deformation, Precision::single, {kRequestedVertices});
  SampledMap map;
  return median_ms(runs, [&] { map = prepared->deformer->deform(pose_of(deformation), {}); });
}

double mesh_ms(int runs) {
  const Points cage = wavy(100, {500, 500}, 350);
  return median_ms(runs, [&] { domain_mesh(cage, {kRequestedVertices}); });
}

double add_pin_ms(int runs) {
  Deformation deformation = scene_with(wavy(100, {500, 500}, 350));
  deformation.method = usual_method(MethodUse::pins).id;
  for (int i = 0; i < 10; ++i)
    deformation.pins.push_back(
        {Complex(500, 500) + std::polar(150.0, 0.6 * i), {500, 500}, {}, {}});
  const auto before = prepared_map(deformation, Precision::single, {kRequestedVertices});
  deformation.pins.push_back({{510, 520}, {510, 520}, {}, {}});
  return median_ms(runs, [&] {
    prepared_map(deformation, Precision::single, {kRequestedVertices}, before.get());
  });
}

/// A wavy cage of 32 points and three pins in a picture of 1000 x 1000, with three keyframes over
/// 100 frames.
Deformation moving_shape(const char* method) {
  Deformation deformation = scene_with(wavy(32, {500, 500}, 390));
  deformation.method = method;
  for (const Complex z : {Complex(300, 450), Complex(500, 750), Complex(650, 400)})
    deformation.pins.push_back({z, z, {}, {}});
  for (int key = 0; key < 3; ++key) {
    for (Pin& pin : deformation.pins) pin.pose = pin.rest + 30.0 * std::polar(1.0, 2.0 * key);
    deformation = with_key(std::move(deformation), 2.0 * key);
  }
  return deformation;
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

/// The time per frame of a film of 100 frames of 1000 x 1000 pixels with three keyframes, on all
/// cores, from preparation to pixels.
double film_frame_ms(const char* method) {
  constexpr int kFrames = 100;
  const Image image = gradient(1000);
  Scene scene = scene_of(moving_shape(method));
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

double memory_mb(int) {
  const Image image = gradient(2000);
  const Deformation deformation = scene_with(wavy(32, {1000, 1000}, 780));
  const auto prepared = prepared_map(deformation, Precision::single, MeshOptions{});
  SampledMap map = prepared->deformer->deform(pose_of(deformation), {true});
  return resident_mb();
}

const Entry kEntries[] = {
    {"open: 2000 x 2000 picture, 32-vertex cage, resident memory without a window", "MB", 300, 1,
     memory_mb},
    {"coordinates: degree 1, order 0, AVX2, 15k points x 100 edges, per point and edge", "ns", 4,
     15,
     [](int runs) {
       return coordinates_ns(has_avx2() ? Kernel::avx2 : Kernel::portable, 0, runs);
     }},
    {"coordinates: 15k random points in any order x 32 edges, AVX2, per point and edge", "ns", 6,
     15, random_coordinates_ns},
    {"coordinates: degree 1, order 0, 15k points x 100 edges, widest instructions",
     "ns",
     {},
     15,
     [](int runs) { return coordinates_ns(Kernel::automatic, 0, runs); }},
    {"coordinates: the same as the first row, portable",
     "ns",
     {},
     9,
     [](int runs) { return coordinates_ns(Kernel::portable, 0, runs); }},
    {"coordinates: order 1, AVX2, per point and edge",
     "ns",
     {},
     9,
     [](int runs) {
       return coordinates_ns(has_avx2() ? Kernel::avx2 : Kernel::portable, 1, runs);
     }},
    {"coordinates: std::log of a complex ratio alone, per point and edge (for comparison)", "ns", 0,
     9, scalar_log_ns},
    {"coordinates: degree 3 relative to degree 1, AVX2, the same edges", "times", 3, 9,
     [](int runs) { return raised_coordinates_ns(3, runs) / raised_coordinates_ns(1, runs); }},
    {"prepare: curved to curved, 20 cubic segments, 10k vertices, mesh and coordinates", "ms", 300,
     5, curved_prepare_ms},
    {"curved rest via a polygon, as Lin and Chen: 10k vertices, only the inverse (for comparison)",
     "ms",
     {},
     1,
     [](int) { return polygon_route().milliseconds; }},
    {"curved rest via a polygon: samples of the domain that it does not reach (for comparison)",
     "%",
     {},
     1,
     [](int) { return polygon_route().missing_percent; }},
    {"inverse: 10000 preimages, 20 cubic segments", "ms", 60, 5, inverse_ms},
    {"map: 10^6 new points, 32 edges, with derivatives", "ms", {}, 9, million_points_ms},
    {"ST-map: 2000 x 2000, with preparation, slowest method", "ms", 3000, 1,
     [](int) {
       return every_pixel_ms([](const Scene& scene, const Image& image) {
         TimedMap map(scene);
         st_map_of(map, image);
       });
     }},
    {"unwarp: 2000 x 2000, with preparation, slowest method", "ms", 3000, 1,
     [](int) {
       return every_pixel_ms(
           [](const Scene& scene, const Image& image) { unwarped(scene, &image); });
     }},
    {"prepare: mesh of 15k vertices, 100-vertex cage", "ms", {}, 9, mesh_ms},
    {"prepare: coordinates 15k x 100, fresh memory", "ms", 10, 15, coordinates_ms},
    {"prepare: mesh and coordinates together", "ms", 150, 9,
     [](int runs) { return prepare_ms(100, runs); }, "points",
     [](int runs) { return prepare_ms(200, runs); }},
    {"prepare: mean value, 256 points, 9k vertices, without the mesh",
     "ms",
     {},
     9,
     [](int runs) { return prepare_method_ms("mean_value", 256, runs); },
     "points",
     [](int runs) { return prepare_method_ms("mean_value", 512, runs); }},
    {"prepare: mean value, 1000 points, 9k vertices, without the mesh", "ms", 8000, 3,
     [](int runs) { return prepare_method_ms("mean_value", 1000, runs); }},
    {"prepare: harmonic, 128 points, 9k vertices, without the mesh",
     "ms",
     {},
     3,
     [](int runs) { return prepare_method_ms("harmonic", 128, runs); },
     "points",
     [](int runs) { return prepare_method_ms("harmonic", 256, runs); }},
    {"prepare: harmonic, 256 points, 9k vertices, without the mesh", "ms", 500, 1,
     [](int runs) { return prepare_method_ms("harmonic", 256, runs); }},
    {"prepare: angles, 128 points, 9k vertices, without the mesh",
     "ms",
     {},
     1,
     [](int runs) { return prepare_method_ms("angles", 128, runs); },
     "points",
     [](int runs) { return prepare_method_ms("angles", 256, runs); }},
    {"prepare: angles, 256 points, 9k vertices, without the mesh", "ms", 500, 1,
     [](int runs) { return prepare_method_ms("angles", 256, runs); }},
    {"prepare: strokes, 256 points, 9k vertices, without the mesh", "ms", 500, 3,
     [](int runs) { return prepare_method_ms("strokes", 256, runs); }},
    {"prepare: strokes, 1000 points, 9k vertices, without the mesh", "ms", 8000, 1,
     [](int runs) { return prepare_method_ms("strokes", 1000, runs); }},
    {"prepare: pins, 256 points, 9k vertices, without the mesh", "ms", 500, 3,
     [](int runs) { return prepare_method_ms("pins", 256, runs); }, "points",
     [](int runs) { return prepare_method_ms("pins", 512, runs); }},
    {"pins: one more pin at 15k vertices, 100-vertex cage", "ms", 20, 15, add_pin_ms},
    {"drag: pose to vertex positions, 15k x 100", "ms", 1, 51, frame_ms},
    {"bounded: drag, 50 vertices, 300 samples, 5k mesh vertices, with proof, median of 300 frames",
     "ms", 16, 1, [](int) { return bar_drag(DragFigure::median); }},
    {"bounded: the same, the longest frame", "ms", 33, 1,
     [](int) { return bar_drag(DragFigure::longest); }},
    {"bounded: the same, frames without a proof", "", 0, 1,
     [](int) { return bar_drag(DragFigure::unproved); }},
    {"bounded: drag, 48 points, 5 pins, 5k mesh vertices, with proof, median of 300 frames", "ms",
     6, 1, [](int) { return bounded_drag(wavy_points(48), "pins").median_ms; }},
    {"bounded: the same, 48 points, the longest frame", "ms", 16, 1,
     [](int) { return bounded_drag(wavy_points(48), "pins").longest_ms; }},
    {"bounded: drag, 20 cubics, 5 pins, 5k mesh vertices, with proof, median of 300 frames", "ms",
     10, 1, [](int) { return bounded_drag(wavy_curves(20, 3, 0.2), "pins").median_ms; }},
    {"bounded: the same, 20 cubics, the longest frame", "ms", 20, 1,
     [](int) { return bounded_drag(wavy_curves(20, 3, 0.2), "pins").longest_ms; }},
    {"bounded: drag, 40 cubics, 5 pins, 5k mesh vertices, with proof, median of 300 frames", "ms",
     16, 1, [](int) { return bounded_drag(wavy_curves(40, 3, 0.2), "pins").median_ms; }},
    {"bounded: the same, 40 cubics, the longest frame", "ms", 33, 1,
     [](int) { return bounded_drag(wavy_curves(40, 3, 0.2), "pins").longest_ms; }},
    {"bounded: drag, 128 points, 5 pins, 5k mesh vertices, with proof, median of 300 frames", "ms",
     33, 1, [](int) { return bounded_drag(wavy_points(128), "pins").median_ms; }},
    {"bounded: the same, 128 points, the longest frame", "ms", 50, 1,
     [](int) { return bounded_drag(wavy_points(128), "pins").longest_ms; }},
    {"bounded: drag, 256 points, 5 pins, 5k mesh vertices, with proof, median of 300 frames", "ms",
     66, 1, [](int) { return bounded_drag(wavy_points(256), "pins").median_ms; }},
    {"bounded: the same, 256 points, the longest frame", "ms", 100, 1,
     [](int) { return bounded_drag(wavy_points(256), "pins").longest_ms; }},
    {"bounded: drag, 48 points, as rigid as possible, 5 pins, 5k mesh vertices, with proof, median "
     "of 300 frames",
     "ms", 12, 1, [](int) { return bounded_drag(wavy_points(48), "arap").median_ms; }},
    {"bounded: the same, 48 points, as rigid as possible, the longest frame", "ms", 25, 1,
     [](int) { return bounded_drag(wavy_points(48), "arap").longest_ms; }},
    {"bounded: frames of these drags without a proof", "", 0, 1,
     [](int) {
       double unproved = bounded_drag(wavy_points(48), "arap").unproved;
       for (const Cage& cage : {wavy_points(48), wavy_curves(20, 3, 0.2), wavy_curves(40, 3, 0.2),
                                wavy_points(128), wavy_points(256)})
         unproved += bounded_drag(cage, "pins").unproved;
       return unproved;
     }},
    {"bounded: cold L1 solve and proof, 50 vertices, 300 samples, slowest of six maps", "ms", 16, 5,
     [](int runs) {
       return bounded_solve_ms({50, 300}, runs);
     }},
    {"bounded: the same, 150 vertices, 1000 samples", "ms", 150, 3,
     [](int runs) {
       return bounded_solve_ms({150, 1000}, runs);
     }},
    {"bounded: a folded pose from a cold start, end to end", "ms", {}, 9, bounded_cold_ms},
    {"puppet: drag, 50 vertices, 10 pins, 10k mesh vertices, with proof, median of 120 frames",
     "ms", 9, 1, [](int) { return puppet_drag(50).median_ms; }},
    {"puppet: the same, the longest frame", "ms", 14, 1,
     [](int) { return puppet_drag(50).longest_ms; }},
    {"puppet: the same, 100 vertices, median", "ms", 14, 1,
     [](int) { return puppet_drag(100).median_ms; }},
    {"puppet: the same, the longest frame of 100 vertices", "ms", 20, 1,
     [](int) { return puppet_drag(100).longest_ms; }},
    {"puppet: the same, 225 vertices, median", "ms", 40, 1,
     [](int) { return puppet_drag(225).median_ms; }},
    {"puppet: the same, the longest frame of 225 vertices", "ms", 60, 1,
     [](int) { return puppet_drag(225).longest_ms; }},
    {"puppet: frames of these drags without a proof", "", 0, 1,
     [](int) {
       return 1.0 * puppet_drag(50).unproved + puppet_drag(100).unproved +
              puppet_drag(225).unproved;
     }},
    {"puppet: frames more than 5 % above the converged value, 100 vertices", "%", 5, 1,
     [](int) { return puppet_drag(100).behind_percent; }},
    {"rigid: drag, 10 pins, 9k mesh vertices, median of 60 frames", "ms", 8, 1,
     [](int) { return rigid_drag(8000).median_ms; }},
    {"rigid: the same, energy of a frame above the converged one, at most", "%", 1, 1,
     [](int) { return rigid_drag(8000).above_percent; }},
    {"rigid: the same, frames with more than 1 % above it", "%", 0, 1,
     [](int) { return rigid_drag(8000).behind_percent; }},
    {"rigid: the same, 80k mesh vertices, median", "ms", 33, 1,
     [](int) { return rigid_drag(72000).median_ms; }},
    {"rigid: the same, energy above the converged one", "%", 1, 1,
     [](int) { return rigid_drag(72000).above_percent; }},
    {"outline: 30 random pairs, pairs not reached", "pairs", 1, 1,
     [](int) { return kOutlinePairs - outline_figures(false).reached; }},
    {"outline: the same, median time from a cold start", "ms", 150, 1,
     [](int) { return outline_figures(false).median_ms; }},
    {"outline: the same as published, pairs not reached (for comparison)",
     "pairs",
     {},
     1,
     [](int) { return kOutlinePairs - outline_figures(true).reached; }},
    {"outline: the same as published, median time",
     "ms",
     {},
     1,
     [](int) { return outline_figures(true).median_ms; }},
    {"outline: iterations to 1.01 of the final distance, 100 vertices, slowest of 30 pairs", "ms",
     16, 3, outline_iterations_ms},
    {"outline: hard pairs (disk to star, square to E and others), slowest of six", "ms", 2000, 1,
     [](int) { return hard_outline_ms(); }},
    {"strokes: drag, 5 strokes of 20 samples, only the solve", "ms", 2, 101, strokes_drag_ms},
    {"angles: prepare, 20 corners, 10k vertices", "ms", 500, 5, angles_prepare_ms},
    {"angles: drag of a corner, 40 angles, 10k vertices", "ms", 2, 51, angles_drag_ms},
    {"angles: the same, all angles recomputed", "ms", {}, 51, angles_pose_ms},
    {"keyframes: a frame between two keyframes, 20k triangles, with handles", "ms", 16.6, 51,
     playback_ms},
    {"keyframes: a bar bent by 270 degrees, worst area in between", "%", 2.5, 1,
     [](int) { return inbetween_loss_percent(false); }},
    {"keyframes: the same, positions blended linearly (for comparison)",
     "%",
     {},
     1,
     [](int) { return inbetween_loss_percent(true); }},
    {"drag: page faults in a frame, worst method", "", 0, 1,
     [](int) { return drag_page_faults(); }},
    {"layers: drag of a pin, one layer of 100 keyframes, without drawing",
     "ms",
     {},
     1,
     [](int) { return layered_drag_ms(1); }},
    {"layers: the same, 16 layers, relative to one", "times", 1.1, 1,
     [](int) { return layered_drag_ms(16) / layered_drag_ms(1); }},
    {"layers: scrubbing, 16 layers of 100 keyframes, without drawing", "ms", 33, 1,
     [](int) { return layered_scrub_ms(16); }, "layers", [](int) { return layered_scrub_ms(32); }},
    {"export: 2000 x 2000, 32-vertex cage, pose to pixels, two cores", "ms", 22, 15,
     [](int runs) { return export_ms(2000, 32, runs, 2); }},
    {"export: the same, one core",
     "ms",
     {},
     9,
     [](int runs) { return export_ms(2000, 32, runs, 1); },
     "sides",
     [](int runs) { return export_ms(4000, 32, runs, 1); }},
    {"export: 4000 x 4000, 128-vertex cage, pose to pixels, two cores", "ms", 100, 9,
     [](int runs) { return export_ms(4000, 128, runs, 2); }},
    {"open: a PSD file of 200 MB with four layers", "ms", 3000, 1,
     [](int) { return open_psd_ms(); }},
    {"film: 1000 x 1000, puppet, a frame of 100 before encoding, with preparation", "ms", 40, 1,
     [](int) { return film_frame_ms("puppet"); }},
    {"film: the same, cage", "ms", 40, 1, [](int) { return film_frame_ms("cage"); }},
    {"auto-cage: 2000 x 2000 picture", "ms", {}, 5, auto_cage_ms},
};

/// The name prefix of the benchmarks that project the same folded bar with each published method.
/// They report the time and properties of the map.
constexpr const char* kCompared = "compared on a folded bar, 800 mesh vertices: ";

std::vector<Result> comparison(const std::function<void(const Result&)>& report) {
  std::vector<Result> results;
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
    results.push_back({kCompared + row.label, "ms", row.milliseconds, {}, 1, detail});
    report(results.back());
  });
  return results;
}

}  // namespace

std::vector<Result> measured(const std::string& filter,
                             const std::function<void(const Result&)>& report) {
  std::vector<Result> results;
  for (const Entry& entry : kEntries) {
    if (std::string(entry.name).find(filter) == std::string::npos) continue;
    results.push_back({entry.name, entry.unit, entry.measure(entry.runs), entry.goal, entry.runs});
    if (entry.measure_larger) {
      char growth[100];
      std::snprintf(growth, sizeof growth, "%.1f times with twice the %s",
                    entry.measure_larger(entry.runs) / results.back().median, entry.larger);
      results.back().detail = growth;
    }
    report(results.back());
  }
  if (std::string(kCompared).find(filter) != std::string::npos)
    for (Result& row : comparison(report)) results.push_back(std::move(row));
  return results;
}

}  // namespace holomorph::bench
