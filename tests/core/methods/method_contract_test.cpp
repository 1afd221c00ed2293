// The contract that every row of the table of methods fulfills, in both precisions.

#include <Eigen/QR>
#include <functional>
#include <map>
#include <tuple>

#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "support/catch.h"
#include "support/contract_setup.h"
#include "support/seeds.h"

namespace holomorph::method_contract_test {

namespace {

Pose mapped(const Rest& rest, Complex a, Complex b) {
  Pose pose{rest.cage, {}};
  for (Points& segment : pose.cage.segments)
    for (Complex& z : segment) z = a * z + b;
  for (const RestPin& pin : rest.pins)
    pose.pins.push_back({a * pin.position + b, std::arg(a), std::abs(a)});
  for (const Points& stroke : rest.strokes) {
    pose.strokes.emplace_back();
    for (const Complex& z : stroke) pose.strokes.back().push_back(a * z + b);
  }
  return pose;
}

/// The rounding error of the operators, for displacements as large as the picture.
double tolerance(Precision precision) {
  return precision == Precision::full ? 1e-9 : 5e-4;
}

bool is_linear(const Method& method) {
  return method.id == "cage" || method.id == "pins";
}

/// Every law uses the same setups and deformers, so each is prepared once.
const Setup& shared_setup(const Method& method, Precision precision, Shape shape) {
  static std::map<std::tuple<std::string, Precision, Shape>, Setup> cache;
  const auto [at, is_new] = cache.try_emplace({method.id, precision, shape});
  if (is_new) at->second = setup(method, precision, shape);
  return at->second;
}
Deformer& shared_deformer(const Method& method, const Rest& rest) {
  static std::vector<std::tuple<std::string, Rest, std::unique_ptr<Deformer>>> cache;
  for (const auto& [id, same, deformer] : cache)
    if (id == method.id && same == rest) return *deformer;
  cache.emplace_back(method.id, rest, method.prepare(rest, nullptr));
  return *std::get<2>(cache.back());
}

/// Adds a bent outline as the target of the cage's shape.
Setup outlined(Setup s) {
  s.rest.outline = flattened(s.rest.cage).points;
  s.rest.parameters["vertices"] = 60;
  for (Complex& z : s.rest.outline) z = bend(z);
  for (PosePin& pin : s.pose.pins) pin.position += Complex(1, 2);
  return s;
}

enum class Outlines { none, too };

template <class Check>
void for_every_method(Check check, Outlines outlines = Outlines::none) {
  for (const Method& method : methods())
    for (const Precision precision : {Precision::single, Precision::full})
      for (const Shape shape : {Shape::straight, Shape::raised, Shape::curved, Shape::holes}) {
        if (shape == Shape::holes && !method.allows_holes) continue;
        // Other methods always compute in double precision, and raised edges give them the same
        // polygon.
        if (!is_linear(method) && shape != Shape::straight &&
            (precision == Precision::single || shape == Shape::raised))
          continue;
        INFO(method.id << (precision == Precision::full ? ", full" : ", single") << ", shape "
                       << static_cast<int>(shape));
        check(method, shared_setup(method, precision, shape), tolerance(precision));
        // A fit to an outline sees the same polygon for raised edges as for straight ones. For
        // curved ones it takes seconds.
        if (outlines == Outlines::none || !method.uses_outline || shape == Shape::raised ||
            shape == Shape::holes || (shape == Shape::curved && !soaks()))
          continue;
        INFO("with an outline");
        // The basis has hundreds of short segments, whose control points lie off the smooth curve.
        constexpr double kFineBasis = 1e-5;
        check(method, outlined(shared_setup(method, precision, shape)),
              std::max(kFineBasis, tolerance(precision)));
      }
}

SampledMap run(const Method& method, const Rest& rest, const Pose& pose) {
  return shared_deformer(method, rest).deform(pose, {true});
}

VectorXc samples_of(const Rest& rest) {
  return Eigen::Map<const VectorXc>(rest.samples.data(), static_cast<Index>(rest.samples.size()));
}

}  // namespace

TEST_CASE("Contract: the rest pose gives exactly the identity") {
  for_every_method([](const Method& method, const Setup& s, double) {
    const SampledMap map = run(method, s.rest, mapped(s.rest, 1, 0));
    CHECK(map.f == samples_of(s.rest));
    CHECK(map.fz == VectorXc::Ones(map.f.size()));
    CHECK(map.fzbar.isZero(0));
  });
}

TEST_CASE("Contract: the motions that a method reproduces give the same motion of the picture") {
  for_every_method([](const Method& method, const Setup& s, double tolerance) {
    Complex a{0.4, 1.1};
    const Complex b{30, -12};
    if (method.reproduces == Method::Motions::none) return;
    if (method.reproduces == Method::Motions::rigid) a /= std::abs(a);
    const SampledMap map = run(method, s.rest, mapped(s.rest, a, b));
    const VectorXc exact = (a * samples_of(s.rest)).array() + b;
    CHECK((map.f - exact).cwiseAbs().maxCoeff() <= tolerance);
    CHECK((map.fz.array() - a).abs().maxCoeff() <= tolerance);
  });
}

TEST_CASE("Contract: scaling everything by a power of two changes nothing else") {
  for_every_method(
      [](const Method& method, Setup s, double tolerance) {
        const SampledMap before = run(method, s.rest, s.pose);
        const double scale = 8;
        const auto scale_cage = [&](Cage& cage) {
          for (Points& segment : cage.segments)
            for (Complex& z : segment) z *= scale;
        };
        scale_cage(s.rest.cage), scale_cage(s.pose.cage);
        for (RestPin& pin : s.rest.pins) pin.position *= scale;
        for (PosePin& pin : s.pose.pins) pin.position *= scale;
        for (auto* strokes : {&s.rest.strokes, &s.pose.strokes})
          for (Points& stroke : *strokes)
            for (Complex& z : stroke) z *= scale;
        for (Complex& z : s.rest.outline) z *= scale;
        for (Complex& z : s.rest.samples) z *= scale;
        for (Complex& z : s.rest.derivative_samples) z *= scale;
        Mesh mesh = *s.rest.mesh;
        for (Complex& z : mesh.vertices) z *= scale;
        s.rest.mesh = std::make_shared<const Mesh>(mesh);
        const SampledMap after = run(method, s.rest, s.pose);
        CHECK((after.f - scale * before.f).cwiseAbs().maxCoeff() <= scale * tolerance);
        CHECK((after.fz - before.fz).cwiseAbs().maxCoeff() <= tolerance);
      },
      Outlines::too);
}

TEST_CASE("Contract: derivatives agree with finite differences") {
  for_every_method(
      [](const Method& method, Setup s, double) {
        if (s.rest.precision == Precision::single)
          return;  // differences of floats are too inaccurate
        const Points centers{{50, 50}, {120, 40}, {60, 150}, {20, 90}};
        const double h = 1e-3;
        s.rest.samples.clear();
        s.rest.derivative_samples.clear();
        for (const Complex z : centers)
          for (const Complex step : {Complex(h), Complex(-h), h * kI, -h * kI, Complex(0)})
            s.rest.samples.push_back(z + step);
        const SampledMap map = run(method, s.rest, s.pose);
        for (Index i = 0; i < map.f.size(); i += 5) {
          const Complex fx = (map.f[i] - map.f[i + 1]) / (2 * h),
                        fy = (map.f[i + 2] - map.f[i + 3]) / (2 * h);
          CHECK(std::abs((fx - kI * fy) / 2.0 - map.fz[i + 4]) < 1e-6);
          CHECK(std::abs((fx + kI * fy) / 2.0 - map.fzbar[i + 4]) < 1e-6);
        }
      },
      Outlines::too);
}

TEST_CASE("Contract: the shader's operator reproduces the map") {
  for (const Method& method : methods()) {
    const Setup s = setup(method, Precision::single);
    const auto deformer = method.prepare(s.rest, nullptr);
    const PlanarMatrix<float>* matrix = deformer->operator_matrix();
    if (!matrix) continue;
    SampledMap map = deformer->deform(s.pose, {});
    const VectorXc controls = deformer->controls(s.pose);
    REQUIRE(matrix->cols() == controls.size());
    const MatrixXc exact =
        matrix->re.cast<double>().cast<Complex>() + kI * matrix->im.cast<double>().cast<Complex>();
    CHECK((samples_of(s.rest) + exact * controls - map.f).cwiseAbs().maxCoeff() <= 1e-4);
  }
}

TEST_CASE(
    "Contract: the map at single points equals the map at samples, inside and on the boundary") {
  for_every_method(
      [](const Method& method, const Setup& s, double tolerance) {
        for (const bool clockwise : {false, true}) {
          Rest rest = s.rest;
          Pose pose = s.pose;
          if (clockwise) rest.cage = reversed(rest.cage), pose.cage = reversed(pose.cage);
          if (clockwise && rest.precision == Precision::single && !soaks()) continue;
          Deformer& deformer = shared_deformer(method, rest);
          const auto points = deformer.point_map(pose);
          if (!points) return;
          const SampledMap map = deformer.deform(pose, {true});
          for (size_t i = 0; i < rest.samples.size(); i += 7) {
            const auto at = points->at(rest.samples[i]);
            CHECK(std::abs(at.f - map.f[static_cast<Index>(i)]) <= tolerance);
          }
          // Compare derivatives with differences, well inside.
          for (const Complex z : {Complex(50, 50), Complex(120, 40), Complex(60, 150)}) {
            const double h = 1e-4, rounding = s.rest.outline.empty() ? 1e-7 : 1e-6;
            const Complex fx = (points->at(z + h).f - points->at(z - h).f) / (2 * h),
                          fy = (points->at(z + h * kI).f - points->at(z - h * kI).f) / (2 * h);
            const auto at = points->at(z);
            CHECK(std::abs((fx - kI * fy) / 2.0 - at.fz) <= rounding);
            CHECK(std::abs((fx + kI * fy) / 2.0 - at.fzbar) <= rounding);
          }
        }
      },
      Outlines::too);
}

TEST_CASE("Contract: single precision is full precision, rounded") {
  for (const Method& method : methods()) {
    const Setup rough = setup(method, Precision::single), exact = setup(method, Precision::full);
    const SampledMap a = run(method, rough.rest, rough.pose),
                     b = run(method, exact.rest, exact.pose);
    CHECK((a.f - b.f).cwiseAbs().maxCoeff() <= 1e-3);
    CHECK((a.fz - b.fz).cwiseAbs().maxCoeff() <= 1e-3);
  }
}

TEST_CASE("Contract: bad input throws, and the deformer still works afterwards") {
  for_every_method(
      [](const Method& method, const Setup& s, double) {
        Deformer& deformer = shared_deformer(method, s.rest);
        SampledMap map = deformer.deform(s.pose, {});
        const VectorXc before = map.f;
        Pose bad = s.pose;
        bad.cage.segments[0][0] = {NAN, 0};
        CHECK_THROWS_AS(deformer.deform(bad, {}), Error);
        bad = s.pose;
        bad.cage.segments[0].resize(s.rest.cage.degree(0) + 1, bad.cage.segments[0][0]);
        CHECK_THROWS_AS(deformer.deform(bad, {}), Error);
        bad = s.pose;
        bad.cage.segments.pop_back();
        CHECK_THROWS_AS(deformer.deform(bad, {}), Error);
        map = deformer.deform(s.pose, {});
        CHECK(map.f == before);
        Rest crossed = s.rest;
        crossed.cage = polygon_cage(Points{{0, 0}, {10, 10}, {10, 0}, {0, 10}});
        CHECK_THROWS_AS(method.prepare(crossed, nullptr), Error);
      },
      Outlines::too);
}

TEST_CASE("Contract: a draft depends only on the pose and the solution that it continues from") {
  for (const Method& method : methods()) {
    INFO(method.id);
    bool continues = false;
    for (const bool onto : {false, true}) {
      if (onto && !method.uses_outline) continue;
      Setup s = setup(method, Precision::single);
      if (onto) s = outlined(std::move(s));
      const auto deformer = method.prepare(s.rest, nullptr);
      const auto at = [&](double part) {
        Pose pose = s.pose;
        for (PosePin& pin : pose.pins) pin.position += Complex(3 * part, -2 * part);
        for (Points& segment : pose.cage.segments)
          for (Complex& z : segment) z += part * Complex(0.01, 0.02) * z;
        return pose;
      };
      const EvalOptions kDraft{.derivatives = false, .draft = true};
      const SampledMap start = deformer->deform(at(0), {}), near = deformer->deform(at(1), kDraft),
                       next = deformer->deform(at(0.5), kDraft, start.solution.get());
      // Other solves in between change nothing.
      for (const double part : {0.2, 1.5}) {
        const SampledMap other = deformer->deform(at(part), kDraft, next.solution.get());
        CHECK(other.f.allFinite());
      }
      CHECK(deformer->deform(at(0.5), kDraft, start.solution.get()).f == next.f);
      CHECK(deformer->deform(at(1), kDraft).f == near.f);
      CHECK(deformer->deform(at(0), {}, next.solution.get()).f == start.f);
      continues = continues || next.solution;
    }
    CHECK(continues == method.iterates);
  }
}

TEST_CASE("Contract: a final answer that is asked to stop stops or is complete") {
  for (const Method& method : methods()) {
    INFO(method.id);
    const Setup s = setup(method, Precision::single);
    const auto deformer = method.prepare(s.rest, nullptr);
    const SampledMap whole = deformer->deform(s.pose, {});
    std::stop_source source;
    EvalOptions options;
    options.stop = source.get_token();
    CHECK(deformer->deform(s.pose, options).f == whole.f);
    source.request_stop();
    try {
      const SampledMap complete = deformer->deform(s.pose, options);
      CHECK(complete.f == whole.f);
    } catch (const Stopped&) {
      CHECK(method.iterates);
    }
    CHECK(deformer->deform(s.pose, {}).f == whole.f);
  }
}

TEST_CASE("Contract: a previous deformer does not change the map") {
  for_every_method(
      [](const Method& method, const Setup& s, double) {
        Rest fewer = s.rest;
        Pose fewer_pose = s.pose;
        if (!fewer.pins.empty()) fewer.pins.pop_back();
        const auto previous = method.prepare(fewer, nullptr);
        SampledMap a, b;
        a = method.prepare(s.rest, previous.get())->deform(s.pose, {true});
        b = run(method, s.rest, s.pose);
        CHECK(a.f == b.f);
        CHECK(a.fz == b.fz);
      },
      Outlines::too);
}

TEST_CASE(
    "Contract: while there are pins that replace the cage, posed cage points have no effect") {
  for (const Method& method : methods()) {
    if (!method.uses_pins) continue;
    INFO(method.id);
    Setup s = setup(method, Precision::full);
    s.rest.strokes.clear();
    s.pose.strokes.clear();
    const SampledMap bent = run(method, s.rest, s.pose);
    s.pose.cage = s.rest.cage;
    const SampledMap rests = run(method, s.rest, s.pose);
    CHECK((bent.f == rests.f) == method.pins_replace_cage);
  }
}

TEST_CASE("Pins: exact pins are met, and soft pins are met more closely as their weight grows") {
  const Method& pins = method_named("pins");
  Setup s = setup(pins, Precision::full);
  s.rest.samples.clear();
  s.rest.derivative_samples.clear();
  for (const RestPin& pin : s.rest.pins) s.rest.samples.push_back(pin.position);
  const auto miss = [&](const Parameters& parameters) {
    s.rest.parameters = parameters;
    const SampledMap map = run(pins, s.rest, s.pose);
    double worst = 0;
    for (Index i = 0; i < map.f.size(); ++i)
      worst = std::max(worst, std::abs(map.f[i] - s.pose.pins[i].position));
    return worst;
  };
  CHECK(miss({{"exact", 1}}) < 1e-8);
  const double light = miss({{"exact", 0}, {"pin_weight", 1e-3}}),
               heavy = miss({{"exact", 0}, {"pin_weight", 10}});
  CHECK(heavy < light);
  CHECK(light > 1e-3);
  s.rest.parameters = {{"exact", 1}};
  const SampledMap map = run(pins, s.rest, s.pose);
  CHECK(std::abs(map.fz[1] - std::polar(1.0, 0.3)) < 1e-8);  // the pin with a frame
}

TEST_CASE("Pins: soft pins solve the stacked least-squares problem of energy and pins") {
  const Method& pins = method_named("pins");
  const double smoothness = 1e-4, weight = 0.5;
  const Points polygon = shapes::star(100, 0.1, 3);  // as many vertices as the basis has
  const Cage cage = polygon_cage(polygon);
  Rest rest;
  rest.cage = cage;
  rest.precision = Precision::full;
  rest.parameters = {{"exact", 0}, {"smoothness", smoothness}, {"pin_weight", weight}};
  Pose pose{cage, {}};
  const Complex center = box_of(polygon).center();
  VectorXc data(5);
  for (int i = 0; i < 5; ++i) {
    const Complex z = center + std::polar(30.0, 1.3 * i);
    data[i] = Complex(4.0 * i, 9 - i * i);
    rest.pins.push_back({z, false});
    pose.pins.push_back({z + data[i], 0});
    rest.samples.push_back(center + std::polar(45.0, 0.7 * i));
  }
  // Minimize smoothness mean |L^2 h''|^2 + weight mean |h - data|^2 over h = C g, by one QR.
  const double length = perimeter(polygon) / (2 * kPi), m = 5, n = 100;
  std::vector<BoundaryPoint> midpoints;
  for (Index e = 0; e < cage.size(); ++e) midpoints.push_back({e, 0.5});
  Points places;
  for (const RestPin& pin : rest.pins) places.push_back(pin.position);
  MatrixXc stacked(105, 100);
  stacked << cauchy_coordinates(cage, midpoints, 2) * (length * length * std::sqrt(smoothness / n)),
      cauchy_coordinates(cage, places) * std::sqrt(weight / m);
  VectorXc right = VectorXc::Zero(105);
  right.tail(5) = data * std::sqrt(weight / m);
  const VectorXc g = stacked.colPivHouseholderQr().solve(right);
  const VectorXc expected = samples_of(rest) + cauchy_coordinates(cage, rest.samples) * g;
  CHECK((run(pins, rest, pose).f - expected).cwiseAbs().maxCoeff() <= 1e-7);
}

TEST_CASE("Pins: derivatives are finite and moderate on the whole mesh, including the boundary") {
  const Method& pins = method_named("pins");
  for (const Shape shape : {Shape::straight, Shape::curved}) {
    Setup s = setup(pins, Precision::single, shape);
    s.pose = mapped(s.rest, 1, 0);
    s.pose.pins[0].position += Complex(12, 5);
    const SampledMap map = run(pins, s.rest, s.pose);
    CHECK(map.fz.allFinite());
    CHECK(map.fz.cwiseAbs().minCoeff() > 0.3);
    CHECK(map.fz.cwiseAbs().maxCoeff() < 3);
  }
}

TEST_CASE("Contract: a rest without samples is not an error") {
  for (const Method& method : methods()) {
    Setup s = setup(method, Precision::full);
    s.rest.samples.clear();
    s.rest.derivative_samples.clear();
    CHECK(run(method, s.rest, s.pose).f.size() == 0);
  }
}

TEST_CASE("Pins: with the cage's own control points, the solved cage alone gives the same map") {
  const Method &pins = method_named("pins"), &cage = method_named("cage");
  for (const Shape shape : {Shape::straight, Shape::raised, Shape::curved})
    for (const double exact : {0.0, 1.0}) {
      Setup s = setup(pins, Precision::full, shape);
      s.rest.parameters = {{"own_controls", 1}, {"exact", exact}};
      const auto deformer = pins.prepare(s.rest, nullptr);
      SampledMap map, alone;
      map = deformer->deform(s.pose, {});
      const auto solved = deformer->solved_cage(s.pose);
      REQUIRE(solved);
      Rest rest = s.rest;
      rest.pins.clear();
      rest.parameters.clear();
      alone = cage.prepare(rest, nullptr)->deform({*solved, {}}, {});
      CHECK((map.f - alone.f).cwiseAbs().maxCoeff() <= 1e-9);
      if (exact == 0) continue;
      rest.samples = {s.rest.pins[0].position, s.rest.pins[2].position};
      rest.derivative_samples.clear();
      alone = cage.prepare(rest, nullptr)->deform({*solved, {}}, {});
      CHECK(std::abs(alone.f[0] - s.pose.pins[0].position) <= 1e-8);
      CHECK(std::abs(alone.f[1] - s.pose.pins[2].position) <= 1e-8);
    }
  CHECK_FALSE(pins.prepare(setup(pins, Precision::full).rest, nullptr)
                  ->solved_cage(setup(pins, Precision::full).pose));
}

TEST_CASE("Pins: a pin with a frame rotates and scales") {
  const Method& pins = method_named("pins");
  Setup s = setup(pins, Precision::full);
  s.rest.pins = {{{40, 40}, true}};
  s.pose = mapped(s.rest, 1, 0);
  s.pose.pins[0].angle = 0.5;
  s.pose.pins[0].scale = 1.75;
  const SampledMap map = run(pins, s.rest, s.pose);
  const Complex a = std::polar(1.75, 0.5);
  CHECK((map.fz.array() - a).abs().maxCoeff() < 1e-9);
  CHECK((map.f.array() - (a * (samples_of(s.rest).array() - Complex(40, 40)) + Complex(40, 40)))
            .abs()
            .maxCoeff() < 1e-8);
}

TEST_CASE("Pins: the correction minimizes the smoothness energy among maps that meet the pins") {
  const Method& pins = method_named("pins");
  Setup s = setup(pins, Precision::full);
  s.pose.cage = s.rest.cage;
  s.rest.parameters = {{"exact", 1}};
  for (RestPin& pin : s.rest.pins) pin.has_frame = false;
  const auto energy = [&](const Points& samples,
                          const SampledMap& map) {  // the sum of |f''|^2, by differences of f'
    double sum = 0;
    for (size_t i = 0; i + 1 < samples.size(); i += 2)
      sum += std::norm((map.fz[i + 1] - map.fz[i]) / (samples[i + 1] - samples[i]));
    return sum;
  };
  s.rest.derivative_samples.clear();
  s.rest.samples.clear();
  for (double x = 10; x < 100; x += 7)
    for (double y = 10; y < 190; y += 7) {
      s.rest.samples.push_back({x, y});
      s.rest.samples.push_back({x + 1e-3, y});
    }
  const double smoothest = energy(s.rest.samples, run(pins, s.rest, s.pose));
  // A fourth pin on the smoothest map costs no energy; a fourth pin off that map does.
  Setup more = s;
  const Complex place{150, 30};
  more.rest.samples.push_back(place);
  const SampledMap map = run(pins, more.rest, s.pose);
  const Complex image = map.f[map.f.size() - 1];
  more.rest.samples.pop_back();
  more.rest.pins.push_back({place, false});
  more.pose.pins.push_back({image, 0});
  CHECK(energy(s.rest.samples, run(pins, more.rest, more.pose)) == Approx(smoothest).epsilon(1e-6));
  more.pose.pins.back().position += 20.0;
  CHECK(energy(s.rest.samples, run(pins, more.rest, more.pose)) > 1.01 * smoothest);
}

TEST_CASE("Pins: a single pin moves everything, and ignored pins are named") {
  const Method& pins = method_named("pins");
  Setup s = setup(pins, Precision::full);
  s.rest.pins = {{{40, 40}, false}};
  Pose pose = mapped(s.rest, 1, 0);
  pose.pins[0].position += Complex(7, 9);
  SampledMap map = run(pins, s.rest, pose);
  // The map is a translation, to the same accuracy as the derivative below.
  CHECK_THAT((map.f - samples_of(s.rest)).cwiseAbs().minCoeff(),
             Catch::WithinAbs(std::abs(Complex(7, 9)), 1e-9));
  CHECK((map.fz.array() - Complex(1)).abs().maxCoeff() < 1e-9);
  s.rest.pins = {{{40, 40}, false}, {{40, 40}, false}, {{190, 190}, false}};
  map = run(pins, s.rest, mapped(s.rest, 1, 0));
  CHECK_THAT(map.note, Catch::Contains("pin 3 (outside") && Catch::Contains("pin 2 (on another"));
}

TEST_CASE("Methods: an unknown id is refused, and the error names those that exist") {
  CHECK_THROWS_WITH(method_named("magic"),
                    Catch::Contains("magic") && Catch::Contains("cage, pins"));
}

}  // namespace holomorph::method_contract_test
