#include "bench/table.h"

#include "bench/measures.h"
#include "bench/wavy.h"

namespace holomorph::bench {
namespace {

using Goal = std::optional<double>;
using Value = std::function<double(int runs)>;

/// Larger inputs, and the measurement of one that is twice as large.
struct Larger {
  std::string what = {};
  Value measured = {};
};

Benchmark one(std::string name, std::string unit, Goal goal, int runs, Value value,
              Larger larger = {}) {
  return {{{std::move(name), std::move(unit), goal}},
          runs,
          [value = std::move(value)](int count) { return std::vector{value(count)}; },
          std::move(larger.what),
          std::move(larger.measured)};
}

Benchmark is_long(Benchmark benchmark) {
  benchmark.is_long = true;
  return benchmark;
}

/// A drag of 300 frames of a map without folds on a mesh of 5000 vertices.
Benchmark bounded(const std::string& what, Goal median, Goal longest,
                  const std::function<BoundedDrag()>& drag) {
  const std::string name = "bounded: drag, " + what;
  return {{{name + ", 5k mesh vertices, with proof, median of 300 frames", "ms", median},
           {name + ", the longest frame", "ms", longest},
           {name + ", frames without a proof", "", 0}},
          1,
          [drag](int) {
            const BoundedDrag figures = drag();
            return std::vector{figures.median_ms, figures.longest_ms, 1.0 * figures.unproved};
          }};
}

Benchmark puppet(int vertices, Goal median, Goal longest) {
  const std::string name = "puppet: drag, " + std::to_string(vertices) + " vertices";
  return {{{name + ", 10 pins, 10k mesh vertices, with proof, median of 120 frames", "ms", median},
           {name + ", the longest frame", "ms", longest},
           {name + ", frames without a proof", "", 0},
           {name + ", frames more than 5 % above the converged value", "%", 5}},
          1,
          [vertices](int) {
            const PuppetFigures figures = puppet_drag(vertices);
            return std::vector{figures.median_ms, figures.longest_ms, 1.0 * figures.unproved,
                               figures.behind_percent};
          }};
}

Benchmark sheet(const std::string& what, SheetScene scene) {
  const std::string name = "sheet: " + what + ", 10 pins, 8k mesh vertices";
  return {{{name + ", preparation", "ms", 300},
           {name + ", drag with proof, median of 300 frames", "ms", 8},
           {name + ", the longest frame", "ms", 16},
           {name + ", a final map", "ms", 300},
           {name + ", memory", "MB", 50},
           {name + ", maps without a proof", "", 0}},
          1,
          [scene](int) {
            const SheetFigures figures = sheet_drag(scene);
            return std::vector{figures.preparation_ms, figures.median_ms, figures.longest_ms,
                               figures.final_ms,       figures.megabytes, 1.0 * figures.unproved};
          }};
}

Benchmark rigid(const std::string& size, int vertices, Goal median) {
  const std::string name = "rigid: drag, " + size + " mesh vertices";
  return {{{name + ", 10 pins, median of 60 frames", "ms", median},
           {name + ", energy of a frame above the converged one, at most", "%", 1},
           {name + ", frames with more than 1 % above it", "%", 0}},
          1,
          [vertices](int) {
            const RigidFigures figures = rigid_drag(vertices);
            return std::vector{figures.median_ms, figures.above_percent, figures.behind_percent};
          }};
}

Benchmark outlines(const std::string& how, Goal missed, Goal median, bool published) {
  const std::string name = "outline: 30 random pairs" + how;
  return {{{name + ", pairs not reached", "pairs", missed},
           {name + ", median time from a cold start", "ms", median}},
          1,
          [published](int) {
            const OutlineFigures figures = outline_figures(published);
            return std::vector{kOutlinePairs - figures.reached, figures.median_ms};
          }};
}

Cage points(int count) {
  return polygon_cage(wavy(count, {500, 500}, 350));
}
Cage cubics(int count) {
  return wavy_curves(count, 3, 0.2);
}

Value preparing(const char* method, int vertices) {
  return [=](int runs) { return prepare_method_ms(method, vertices, runs); };
}

}  // namespace

std::vector<Benchmark> benchmarks() {
  const Kernel avx2 = avx2_or_portable();
  return {
      one("open: 2000 x 2000 picture, 32-vertex cage, resident memory without a window", "MB", 300,
          1, [](int) { return memory_mb(); }),
      one("coordinates: float, order 0, AVX2, 15k points x 100 edges, per point and edge", "ns", 4,
          15, [=](int runs) { return coordinates_ns<float>(avx2, 0, runs); }),
      one("coordinates: double, order 0, AVX2, 15k points x 100 edges, per point and edge", "ns",
          {}, 15, [=](int runs) { return coordinates_ns<double>(avx2, 0, runs); }),
      one("coordinates: float, order 0, portable", "ns", {}, 9,
          [](int runs) { return coordinates_ns<float>(Kernel::portable, 0, runs); }),
      one("coordinates: double, order 0, portable", "ns", {}, 9,
          [](int runs) { return coordinates_ns<double>(Kernel::portable, 0, runs); }),
      one("coordinates: float, order 0, widest instructions", "ns", {}, 15,
          [](int runs) { return coordinates_ns<float>(Kernel::automatic, 0, runs); }),
      one("coordinates: double, order 0, widest instructions", "ns", {}, 15,
          [](int runs) { return coordinates_ns<double>(Kernel::automatic, 0, runs); }),
      one("coordinates: float, order 1, AVX2", "ns", {}, 9,
          [=](int runs) { return coordinates_ns<float>(avx2, 1, runs); }),
      one("coordinates: double, order 1, AVX2", "ns", {}, 9,
          [=](int runs) { return coordinates_ns<double>(avx2, 1, runs); }),
      one("coordinates: float, AVX2, 15k random points in any order x 32 edges", "ns", 6, 15,
          random_coordinates_ns),
      one("coordinates: std::log of a complex ratio alone, in double (for comparison)", "ns", {}, 9,
          scalar_log_ns),
      one("coordinates: float, AVX2, degree 3 relative to degree 1, the same edges", "times", 3, 9,
          [](int runs) { return raised_coordinates_ns(3, runs) / raised_coordinates_ns(1, runs); }),
      one("prepare: curved to curved, 20 cubic segments, 10k vertices, mesh and coordinates", "ms",
          300, 5, curved_prepare_ms),
      {{{"curved rest via a polygon, as Lin and Chen: 10k vertices, only the inverse (for "
         "comparison)",
         "ms"},
        {"curved rest via a polygon: samples of the domain that it does not reach (for comparison)",
         "%"}},
       1,
       [](int) {
         const PolygonRoute route = polygon_route();
         return std::vector{route.milliseconds, route.missing_percent};
       }},
      one("inverse: 10000 preimages, 20 cubic segments", "ms", 60, 5, inverse_ms),
      one("map: 10^6 new points, 32 edges, with derivatives", "ms", {}, 5, million_points_ms),
      one("ST-map: 2000 x 2000, with preparation, slowest method", "ms", 3000, 1,
          [](int) { return st_map_ms(); }),
      one("unwarp: 2000 x 2000, with preparation, slowest method", "ms", 3000, 1,
          [](int) { return unwarp_ms(); }),
      one("prepare: mesh of 15k vertices, 100-vertex cage", "ms", {}, 9, mesh_ms),
      one("prepare: coordinates 15k x 100, fresh memory", "ms", 10, 15, coordinates_ms),
      one("prepare: mesh and coordinates together", "ms", 150, 9,
          [](int runs) { return prepare_ms(100, runs); },
          {"points", [](int runs) { return prepare_ms(200, runs); }}),
      one("prepare: mean value, 256 points, 9k vertices, without the mesh", "ms", {}, 9,
          preparing("mean_value", 256), {"points", preparing("mean_value", 512)}),
      one("prepare: mean value, 1000 points, 9k vertices, without the mesh", "ms", 8000, 3,
          preparing("mean_value", 1000)),
      one("prepare: harmonic, 128 points, 9k vertices, without the mesh", "ms", {}, 3,
          preparing("harmonic", 128), {"points", preparing("harmonic", 256)}),
      one("prepare: harmonic, 256 points, 9k vertices, without the mesh", "ms", 500, 1,
          preparing("harmonic", 256)),
      one("prepare: angles, 128 points, 9k vertices, without the mesh", "ms", {}, 1,
          preparing("angles", 128), {"points", preparing("angles", 256)}),
      one("prepare: angles, 256 points, 9k vertices, without the mesh", "ms", 500, 1,
          preparing("angles", 256)),
      one("prepare: strokes, 256 points, 9k vertices, without the mesh", "ms", 500, 3,
          preparing("strokes", 256)),
      is_long(one("prepare: strokes, 1000 points, 9k vertices, without the mesh", "ms", 8000, 1,
                  preparing("strokes", 1000))),
      one("prepare: pins, 256 points, 9k vertices, without the mesh", "ms", 500, 3,
          preparing("pins", 256), {"points", preparing("pins", 512)}),
      one("pins: one more pin at 15k vertices, 100-vertex cage", "ms", 20, 15, add_pin_ms),
      one("drag: pose to vertex positions, 15k x 100", "ms", 1, 51, frame_ms),
      bounded("50 vertices, 300 samples", 16, 33, bar_drag),
      bounded("48 points, 5 pins", 6, 16, [] { return bounded_drag(points(48), "pins"); }),
      bounded("20 cubics, 5 pins", 10, 20, [] { return bounded_drag(cubics(20), "pins"); }),
      bounded("40 cubics, 5 pins", 16, 33, [] { return bounded_drag(cubics(40), "pins"); }),
      bounded("128 points, 5 pins", 33, 50, [] { return bounded_drag(points(128), "pins"); }),
      is_long(
          bounded("256 points, 5 pins", 66, 100, [] { return bounded_drag(points(256), "pins"); })),
      bounded("48 points, as rigid as possible, 5 pins", 12, 25,
              [] { return bounded_drag(points(48), "arap"); }),
      one("bounded: cold L1 solve and proof, 50 vertices, 300 samples, slowest of six maps", "ms",
          16, 5, [](int runs) { return bounded_solve_ms(50, 300, runs); }),
      one("bounded: cold L1 solve and proof, 150 vertices, 1000 samples, slowest of six maps", "ms",
          150, 3, [](int runs) { return bounded_solve_ms(150, 1000, runs); }),
      one("bounded: a folded pose from a cold start, end to end", "ms", {}, 9, bounded_cold_ms),
      sheet("a body with eight limbs", SheetScene::limbs),
      sheet("a photograph of 4000 x 3000 in its frame", SheetScene::photograph),
      puppet(50, 9, 14),
      puppet(100, 14, 20),
      is_long(puppet(225, 40, 60)),
      rigid("9k", 8000, 8),
      is_long(rigid("80k", 72000, 33)),
      outlines("", 1, 150, false),
      outlines(" as published (for comparison)", {}, {}, true),
      one("outline: iterations to 1.01 of the final distance, 100 vertices, slowest of 30 pairs",
          "ms", 16, 3, outline_iterations_ms),
      one("outline: hard pairs (disk to star, square to E and others), slowest of six", "ms", 2000,
          1, [](int) { return hard_outline_ms(); }),
      one("strokes: drag, 5 strokes of 20 samples, only the solve", "ms", 2, 101, strokes_drag_ms),
      one("angles: prepare, 20 corners, 10k vertices", "ms", 500, 5, angles_prepare_ms),
      one("angles: drag of a corner, 40 angles, 10k vertices", "ms", 2, 51, angles_drag_ms),
      one("angles: drag, all angles recomputed", "ms", {}, 51, angles_pose_ms),
      one("keyframes: a frame between two keyframes, 20k triangles, with handles", "ms", 16.6, 51,
          playback_ms),
      one("keyframes: a bar bent by 270 degrees, worst area in between", "%", 2.5, 1,
          [](int) { return inbetween_loss_percent(false); }),
      one("keyframes: the same, positions blended linearly (for comparison)", "%", {}, 1,
          [](int) { return inbetween_loss_percent(true); }),
      one("drag: page faults in a frame, worst method", "", 0, 1,
          [](int) { return drag_page_faults(); }),
      {{{"layers: drag of a pin, one layer of 100 keyframes, without drawing", "ms"},
        {"layers: drag of a pin, 16 layers relative to one", "times", 1.1}},
       1,
       [](int) {
         const double alone = layered_drag_ms(1);
         return std::vector{alone, layered_drag_ms(16) / alone};
       }},
      one("layers: scrubbing, 16 layers of 100 keyframes, without drawing", "ms", 33, 1,
          [](int) { return layered_scrub_ms(16); }),
      is_long(one("layers: scrubbing, 32 layers of 100 keyframes, without drawing", "ms", {}, 1,
                  [](int) { return layered_scrub_ms(32); })),
      one("export: 2000 x 2000, 32-vertex cage, pose to pixels, two cores", "ms", 22, 15,
          [](int runs) { return export_ms(2000, 32, runs, 2); }),
      one("export: 2000 x 2000, 32-vertex cage, pose to pixels, one core", "ms", {}, 9,
          [](int runs) { return export_ms(2000, 32, runs, 1); },
          {"sides", [](int runs) { return export_ms(4000, 32, runs, 1); }}),
      one("export: 4000 x 4000, 128-vertex cage, pose to pixels, two cores", "ms", 100, 9,
          [](int runs) { return export_ms(4000, 128, runs, 2); }),
      one("open: a PSD file of 200 MB with four layers", "ms", 3000, 1,
          [](int) { return open_psd_ms(); }),
      one("film: 1000 x 1000, puppet, a frame of 100 before encoding, with preparation", "ms", 40,
          1, [](int) { return film_frame_ms("puppet"); }),
      one("film: 1000 x 1000, cage, a frame of 100 before encoding, with preparation", "ms", 40, 1,
          [](int) { return film_frame_ms("cage"); }),
      one("film: one frame, 200 keyframes, puppet", "x 4 keyframes", 1.2, 3, many_keys_ratio),
      one("auto-cage: 2000 x 2000 picture", "ms", {}, 5, auto_cage_ms),
  };
}

}  // namespace holomorph::bench
