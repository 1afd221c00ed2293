// Benchmarks of mapping random outlines onto random outlines, and of dragging strokes.
#include <algorithm>

#include "bench/hard_outlines.h"
#include "bench/measures.h"
#include "bench/outlines.h"
#include "core/clock.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "core/outline/outline_match.h"

namespace holomorph::bench {
namespace {

struct Pair {
  Cage cage;
  Points outline;
};

Pair pair_of(unsigned seed) {
  return {polygon_cage(outlines::random(seed, seed % 2, 50)),
          outlines::random(seed + 100, seed % 3 == 0, 400)};
}

}  // namespace

OutlineFigures outline_figures(bool published) {
  OutlineSettings settings;
  if (published) {
    settings.published = true;
    settings.vertices = 100;
    settings.most_iterations = 200;
  }
  OutlineFigures figures;
  std::vector<double> times;
  for (unsigned seed = 1; seed <= kOutlinePairs; ++seed) {
    const Pair pair = pair_of(seed);
    const double start = now_ms();
    const OutlineMatch match = matched({pair.cage, pair.outline, {}, {}}, settings);
    times.push_back(now_ms() - start);
    figures.reached +=
        match.zeros == 0 && match.hausdorff < 0.01 * Polyline(pair.outline, true).diameter();
  }
  std::nth_element(times.begin(), times.begin() + kOutlinePairs / 2, times.end());
  figures.median_ms = times[kOutlinePairs / 2];
  return figures;
}

double outline_iterations_ms(int runs) {
  OutlineSettings settings;
  settings.vertices = 100;
  settings.smoothness = 0.0101;  // just above the limit, which disables refinement
  double slowest = 0;
  for (unsigned seed = 1; seed <= kOutlinePairs; ++seed) {
    const Pair pair = pair_of(seed);
    OutlineFit fit(pair.cage, pair.outline, {}, settings);
    const double all = median_ms(runs, [&] { fit.solve({}); });
    const double last = fit.after(fit.iterations()).rms;
    int needed = 0;
    while (fit.after(needed).rms > 1.01 * last) ++needed;
    slowest = std::max(slowest, all * needed / std::max(fit.iterations(), 1));
  }
  return slowest;
}

double hard_outline_ms() {
  const auto shapes = outlines::hard_shapes();
  const auto shape = [&](const std::string& name) {
    return std::ranges::find(shapes, name, &std::pair<std::string, Points>::first)->second;
  };
  double longest = 0;
  for (const auto& [from, to] :
       {std::pair("disk", "star"), std::pair("square", "E"), std::pair("disk", "hourglass"),
        std::pair("star", "comb"), std::pair("E", "H"), std::pair("comb", "disk")}) {
    const double start = now_ms();
    matched({polygon_cage(shape(from)), shape(to), {}, {}}, {});
    longest = std::max(longest, now_ms() - start);
  }
  return longest;
}

double strokes_drag_ms(int runs) {
  Rest rest;
  Points round;
  for (int i = 0; i < 50; ++i) round.push_back(std::polar(300.0, 2 * kPi * i / 50));
  rest.cage = polygon_cage(round);
  // L. A stroke of this length has 20 samples, all inside the cage.
  const double length = perimeter(round) / (2 * kPi);
  for (int i = 0; i < 5; ++i)
    rest.strokes.push_back({{-0.5 * length, 60.0 * (i - 2)}, {0.5 * length, 60.0 * (i - 2)}});
  const auto deformer = usual_method(MethodUse::strokes).prepare(rest, nullptr);
  SampledMap map;
  std::vector<double> times;
  Pose pose{rest.cage, {}};
  for (int frame = 0; frame < runs; ++frame) {
    pose.strokes = rest.strokes;
    for (Complex& z : pose.strokes[2]) z += std::polar(40.0, 0.2 * frame);
    const double start = now_ms();
    map = deformer->deform(pose, {false, true}, map.solution.get());
    times.push_back(now_ms() - start);
  }
  std::nth_element(times.begin(), times.begin() + runs / 2, times.end());
  return times[static_cast<size_t>(runs / 2)];
}

}  // namespace holomorph::bench
