// Method `strokes`: curves on the picture are mapped onto other curves and slide along them.

#include "bench/outlines.h"
#include "core/error.h"
#include "core/geometry/polyline.h"
#include "core/maps/deformer.h"
#include "core/maps/distortion.h"
#include "core/maps/method.h"
#include "core/mesh/mesh.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"

namespace holomorph::strokes_test {

namespace {

Cage bar() {
  return polygon_cage(Points{{0, 0}, {400, 0}, {400, 80}, {0, 80}});
}

/// A line along the bar's middle with `count` points.
Points middle(int count = 20) {
  Points line;
  for (int i = 0; i < count; ++i) line.push_back({30 + 340.0 * i / (count - 1), 40});
  return line;
}

/// An arc as long as `factor` times the middle, bent by `angle`.
Points arc(double factor, double angle, int count = 60) {
  Points line;
  const double radius = factor * 340 / angle;
  for (int i = 0; i < count; ++i) {
    const double at = angle * (static_cast<double>(i) / (count - 1) - 0.5);
    line.push_back(Complex(200, 40 - radius) + radius * Complex(std::sin(at), std::cos(at)));
  }
  return line;
}

Rest rest_of(const Cage& cage, std::vector<Points> strokes, Parameters parameters = {}) {
  Rest rest;
  rest.cage = cage;
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(cage, {1500}));
  rest.samples = rest.mesh->vertices;
  rest.derivative_samples = derivative_samples(*rest.mesh);
  rest.strokes = std::move(strokes);
  rest.parameters = std::move(parameters);
  rest.precision = Precision::full;
  return rest;
}

Pose pose_of(const Rest& rest, std::vector<Points> strokes) {
  Pose pose{rest.cage, {}};
  for (const RestPin& pin : rest.pins) pose.pins.push_back({pin.position});
  pose.strokes = std::move(strokes);
  return pose;
}

SampledMap run(const Rest& rest, const Pose& pose) {
  SampledMap map = method_named("strokes").prepare(rest, nullptr)->deform(pose, {true});
  return map;
}

/// The root mean square of log2 of the local area.
double area_rms(const SampledMap& map) {
  double sum = 0;
  for (Index i = 0; i < map.fz.size(); ++i) {
    const double log = std::log2(std::norm(map.fz[i]) - std::norm(map.fzbar[i]));
    sum += log * log;
  }
  return std::sqrt(sum / static_cast<double>(map.fz.size()));
}

/// The largest distance of the stroke's images from its target.
double miss(const Rest& rest, const Pose& pose) {
  Rest at = rest;
  at.samples = rest.strokes[0];
  at.derivative_samples.clear();
  const SampledMap map = run(at, pose);
  const Polyline target(pose.strokes[0], false);
  double worst = 0;
  for (const Complex& z : map.f) worst = std::max(worst, target.nearest(z).distance);
  return worst;
}

}  // namespace

TEST_CASE("Strokes: a target 1.4 times too long distorts areas a third less than pins do") {
  const Points longer = arc(1.4, 1.2);
  const Rest rest = rest_of(bar(), {middle()});
  const SampledMap slid = run(rest, pose_of(rest, {longer}));
  // Pins hold the same points at equal fractions of both lengths.
  Rest pinned = rest_of(bar(), {});
  Pose pose{pinned.cage, {}};
  const Points places = at_equal_lengths(Polyline(middle(), false), 20),
               wanted = at_equal_lengths(Polyline(longer, false), 20);
  for (size_t i = 0; i < places.size(); ++i) {
    pinned.pins.push_back({places[i]});
    pose.pins.push_back({wanted[i]});
  }
  SampledMap held = method_named("pins").prepare(pinned, nullptr)->deform(pose, {true});
  INFO(area_rms(slid) << " against " << area_rms(held));
  CHECK(area_rms(slid) < area_rms(held) * 2 / 3);
  CHECK(miss(rest, pose_of(rest, {longer})) < 0.01 * 400);
}

TEST_CASE("Strokes: a stroke that is rotated and moved as a whole moves the picture rigidly") {
  const Rest rest = rest_of(bar(), {middle()});
  const Complex turn = std::polar(1.0, 2.2), move(50, -80);
  Points moved;
  for (const Complex& z : middle()) moved.push_back(turn * z + move);
  const SampledMap map = run(rest, pose_of(rest, {moved}));
  for (Index i = 0; i < map.f.size(); ++i)
    REQUIRE(std::abs(map.f[i] - turn * rest.samples[static_cast<size_t>(i)] - move) < 1e-6 * 400);
}

TEST_CASE("Strokes: the number of points on a line does not change the map") {
  const Points target{{20, 60}, {200, 10}, {390, 70}};
  const Rest plain = rest_of(bar(), {middle(2)}), dense = rest_of(bar(), {middle(10000)});
  const SampledMap a = run(plain, pose_of(plain, {target})),
                   b = run(dense,
                           pose_of(dense, {outlines::with_steps(Polyline(target, false), 0.04)}));
  CHECK((a.f - b.f).cwiseAbs().maxCoeff() < 1e-6 * 400);
}

TEST_CASE("Strokes: after a drag the map depends only on the scene") {
  const Rest rest = rest_of(bar(), {middle()});
  const auto dragged = method_named("strokes").prepare(rest, nullptr);
  SampledMap map;
  for (int frame = 1; frame <= 10; ++frame)
    map = dragged->deform(pose_of(rest, {arc(1 + 0.04 * frame, 0.12 * frame)}), {false, true});
  const SampledMap cold = run(rest, pose_of(rest, {arc(1.4, 1.2)}));
  CHECK((map.f - cold.f).cwiseAbs().maxCoeff() < 0.05 * 400);  // close during the drag
  map = dragged->deform(pose_of(rest, {arc(1.4, 1.2)}), {false, false});
  CHECK(map.f == cold.f);
}

TEST_CASE("Strokes: each weight has the intended effect") {
  const auto with = [&](const Points& line, Parameters parameters) {
    const Rest rest = rest_of(bar(), {middle()}, std::move(parameters));
    const Pose pose = pose_of(rest, {line});
    return std::pair(run(rest, pose), miss(rest, pose));
  };
  // Farther bends have several minima with almost no rigidity, and rounding decides between them.
  for (const double bend : {0.5, 1.0}) {
    const auto [loose, loose_miss] = with(arc(1.4, bend), {{"rigidity", 1e-5}});
    const auto [usual, usual_miss] = with(arc(1.4, bend), {});
    const auto [rigid, rigid_miss] = with(arc(1.4, bend), {{"rigidity", 0.3}});
    INFO(bend << ": " << area_rms(loose) << ", " << area_rms(usual) << ", " << area_rms(rigid));
    CHECK(area_rms(usual) < 0.95 * area_rms(loose));
    CHECK(area_rms(rigid) < 0.9 * area_rms(usual));
    CHECK(loose_miss < 0.5 * usual_miss);
    CHECK(usual_miss < 0.5 * rigid_miss);
  }
  const Points longer = arc(1.4, 2.5);
  const auto [usual, usual_miss] = with(longer, {});
  const auto [rigid, rigid_miss] = with(longer, {{"rigidity", 0.3}});
  CHECK(area_rms(rigid) < 0.9 * area_rms(usual));
  const auto [stiff, stiff_miss] = with(longer, {{"smoothness", 0.1}});
  CHECK(stiff_miss > 3 * usual_miss);  // a stiff sheet does not follow the bend
  CHECK(usual.fzbar.isZero(0));
  const auto [soft, soft_miss] = with(longer, {{"softness", 1}});
  CHECK(soft.fzbar.cwiseAbs().maxCoeff() > 0.01);
  CHECK(area_rms(soft) < area_rms(usual));
}

TEST_CASE("Strokes: pins are met together with strokes, including pins with frames") {
  Rest rest = rest_of(bar(), {Points{{250, 40}, {370, 40}}}, {{"pin_weight", 100}});
  rest.pins = {{{40, 40}, true}};
  Pose pose = pose_of(rest, {Points{{250, 40}, {340, 110}}});
  pose.pins[0].angle = 0.4;
  rest.samples = {{40, 40}};
  rest.derivative_samples.clear();
  const SampledMap map = run(rest, pose);
  CHECK(std::abs(map.f[0] - Complex(40, 40)) < 1);
  CHECK(std::abs(map.fz[0] - std::polar(1.0, 0.4)) < 0.05);
  CHECK(miss(rest, pose) < 4);
}

TEST_CASE(
    "Strokes: parts outside the cage are clipped and named, and invalid strokes are refused") {
  Rest rest = rest_of(bar(), {Points{{300, 40}, {500, 40}}, Points{{300, 140}, {500, 140}}});
  const SampledMap map =
      run(rest, pose_of(rest, {Points{{300, 60}, {500, 60}}, Points{{300, 140}, {500, 140}}}));
  CHECK_THAT(map.note,
             Catch::Contains("Stroke 1 leaves the cage") && Catch::Contains("Stroke 2 is outside"));
  CHECK(std::abs(map.f[0] - rest.samples[0] - Complex(0, 20)) < 1e-3);
  const Rest one = rest_of(bar(), {middle()});
  CHECK_THROWS_WITH(run(one, pose_of(one, {})), Catch::Contains("as many strokes as the rest"));
  CHECK_THROWS_WITH(run(one, pose_of(one, {Points{{5, 5}, {5, 5}}})), Catch::Contains("no length"));
  CHECK_THROWS_AS(run(one, pose_of(one, {Points{{5, 5}, {NAN, 5}}})), Error);
  CHECK_THROWS_AS(method_named("strokes").prepare(rest_of(bar(), {Points{{5, 5}}}), nullptr),
                  Error);
  const Rest outside = rest_of(bar(), {Points{{300, 140}, {500, 140}}});
  const SampledMap still = run(outside, pose_of(outside, {Points{{300, 240}, {500, 240}}}));
  CHECK(std::abs(still.f[7] - outside.samples[7]) == 0);
}

}  // namespace holomorph::strokes_test
