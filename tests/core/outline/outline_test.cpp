// Maps of outlines onto outlines: the parts of the method, and the whole method.
#include <Eigen/QR>
#include <algorithm>
#include <random>

#include "bench/outlines.h"
#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "core/methods/parameters.h"
#include "core/outline/inner_loop.h"
#include "core/outline/outline_match.h"
#include "core/outline/outline_start.h"
#include "core/outline/riemann.h"
#include "core/solvers/alternating_fit.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::outline_test {

namespace {

Points circle(Complex center, double radius, int n) {
  Points points;
  for (int i = 0; i < n; ++i) points.push_back(center + radius * std::polar(1.0, 2 * kPi * i / n));
  return points;
}

Points moved(Points points, Complex factor, Complex shift) {
  for (Complex& z : points) z = factor * z + shift;
  return points;
}

/// A map of method `outline` on a mesh.
struct Onto {
  Rest rest;
  Pose pose;
  SampledMap map;
  std::unique_ptr<Deformer> deformer;

  Onto(const Cage& cage, const Points& outline, const Parameters& parameters = {}) {
    rest.cage = cage;
    rest.mesh = std::make_shared<const Mesh>(domain_mesh(cage, {1500}));
    rest.samples = rest.mesh->vertices;
    rest.derivative_samples = derivative_samples(*rest.mesh);
    rest.parameters = parameters;
    rest.precision = Precision::full;
    rest.outline = outline;
    pose = {cage, {}};
    deformer = method_named("outline").prepare(rest, nullptr);
    map = deformer->deform(pose, {true, false});
  }
};

/// The terms of a map's energy in units of L^2, by their definitions in OutlineSettings.
struct Energy {
  double misses = 0;  ///< mean square distance of the boundary's image from the outline
  double bends = 0;   ///< mean |h^2 f''|^2
  double shears = 0;  ///< L^2 mean |f_zbar|^2
};

Energy energy_of(const OutlineMatch& match, const Cage& source, const Points& outline) {
  std::vector<BoundaryPoint> samples, middles;
  std::vector<double> sizes;
  for (Index e = 0; e < match.basis.size(); ++e) {
    const double length = std::abs(match.basis.end_vertex(e) - match.basis.vertex(e));
    const int degree = match.basis.degree(e);
    for (int k = 0; k < 4 * degree; ++k) samples.push_back({e, k / (4.0 * degree)});
    for (int k = 0; k < degree; ++k) {
      middles.push_back({e, (k + 0.5) / degree});
      sizes.push_back(length / degree);
    }
  }
  const bool soft = match.psi.size() > 0;
  const auto sum_of = [&](const MatrixXc& c) {
    VectorXc sum = c * match.phi;
    if (soft) sum += c.conjugate() * match.psi;
    return sum;
  };
  // L and f'' refer to the source's own frame, in which its first chord is along the real axis.
  const Complex chord = source.vertex(1) - source.vertex(0), along = chord / std::abs(chord);
  Cage turned = source;
  for (Points& segment : turned.segments) segment = moved(segment, std::conj(along), 0);
  const double unit = perimeter(flattened(turned).points) / (2 * kPi);
  const VectorXc values = sum_of(cauchy_coordinates(match.basis, samples, 0)),
                 second = sum_of(along * along * cauchy_coordinates(match.basis, middles, 2));
  const Polyline target(outline, true);
  Energy energy;
  for (const Complex& z : values)
    energy.misses += std::norm((z - target.nearest(z).point) / unit) / values.size();
  for (Index i = 0; i < second.size(); ++i) {
    const double size = sizes[static_cast<size_t>(i)];
    energy.bends += std::norm(size * size * second[i] / unit) / second.size();
  }
  if (soft)
    energy.shears =
        (cauchy_coordinates(match.basis, middles, 1).conjugate() * match.psi).cwiseAbs2().mean();
  return energy;
}

/// The number of flipped triangles that touch no vertex of the cage.
///
/// There are none if f_z has no zeros. At a vertex of angle a, f behaves like z^p with p = pi / a,
/// so that at a distance r from it the derivative changes over a triangle of size h by the fraction
/// h |f''| / |f'| = |p - 1| h / r. Where that is less than 1, the triangle keeps its orientation.
/// Angles of at least 90 degrees have |p - 1| <= 1. Hence only triangles with r < h can flip, and
/// those touch the vertex.
int flips_away_from_vertices(const Mesh& mesh, const VectorXc& f) {
  int count = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto [i, j, k] = t;
    const bool touches = std::ranges::any_of(
        mesh.cage_vertices, [&](int v) { return std::ranges::find(t, v) != t.end(); });
    count += !touches && !(cross(f[j] - f[i], f[k] - f[i]) > 0);
  }
  return count;
}

}  // namespace

TEST_CASE("Riemann map: for a disk, it is an automorphism of the disk") {
  const Complex middle(3, 1), center(3.5, 1.2);
  constexpr double kArcs = 2e-6;  // 400 vertices, each arc a third-order fit
  const RiemannMap map(circle(middle, 2, 400), center);
  const auto exact = [&](Complex z) {
    const Complex u = (z - middle) / 2.0, a = (center - middle) / 2.0;
    return (u - a) / (1.0 - std::conj(a) * u);
  };
  CHECK(std::abs(map.at(center)) <= 1e-12);
  const Complex turn = map.at({4, 2}) / exact({4, 2});
  CHECK(std::abs(std::abs(turn) - 1) <= kArcs);
  for (const Complex z : {Complex(3, 1), Complex(2, 0.5), Complex(3.1, 2.7), Complex(4.9, 1)})
    CHECK(std::abs(map.at(z) - turn * exact(z)) <= kArcs);
  const VectorXd& angles = map.angles();
  for (Index i = 1; i < angles.size(); ++i) REQUIRE(angles[i] > angles[i - 1]);
  CHECK(angles[angles.size() - 1] < angles[0] + 2 * kPi);
  for (Index i = 3; i < angles.size(); i += 40)  // the first arcs are the least accurate
    CHECK(std::abs(std::polar(1.0, angles[i]) -
                   turn * exact(middle + 2.0 * std::polar(1.0, 2 * kPi * i / 400.0))) <= 1e-4);
}

TEST_CASE("Riemann map: it does not depend on the position, rotation or size of the outline") {
  const Points outline = outlines::random(5, true, 300);
  const Complex factor = std::polar(2.0, 0.9), shift(40, -7);
  const RiemannMap map(outline, 0), other(moved(outline, factor, shift), shift);
  CHECK((map.angles() - other.angles()).cwiseAbs().maxCoeff() <= 1e-9);
  for (const Complex z : {Complex(20, 30), Complex(-50, 10)})
    CHECK(std::abs(map.at(z) - other.at(factor * z + shift)) <= 1e-9);
}

TEST_CASE("Riemann map: an outline that touches itself is refused") {
  CHECK_THROWS_AS(RiemannMap(Points{{0, 0}, {1, 0}, {1, 0}, {0, 1}}, {0.2, 0.2}), Error);
}

TEST_CASE("Polyline: the nearest point agrees with a search through all segments") {
  for (const bool closed : {true, false}) {
    const Points points = outlines::random(3, true, 157);
    const Polyline line(points, closed);
    for (int i = 0; i < 300; ++i) {
      const Complex z = 500.0 * std::polar(std::fmod(0.37 * i, 1.3), 2.1 * i);
      double least = 1e300;
      for (Index s = 0; s < line.segments(); ++s)
        least = std::min(least, nearest_on_segment(points[static_cast<size_t>(s)],
                                                   points[static_cast<size_t>(s + 1) % 157], z)
                                    .distance);
      const Polyline::Nearest nearest = line.nearest(z, i % 100);
      REQUIRE(std::abs(nearest.distance - least) <= 1e-12 * 600);
      REQUIRE(std::abs(nearest.distance - std::abs(nearest.point - z)) <= 1e-12 * 600);
      REQUIRE(std::abs(line.at(line.length_at(nearest.segment, nearest.parameter)) -
                       nearest.point) <= 1e-9);
    }
  }
}

TEST_CASE("Polyline: it is resampled at equal lengths and in short steps") {
  const Polyline square(Points{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, true);
  CHECK(square.length() == 16);
  CHECK(square.at(-2) == Complex(0, 2));
  CHECK(square.at(21) == Complex(4, 1));
  CHECK(at_equal_lengths(square, 8)[3] == Complex(4, 2));
  const Points steps = outlines::with_steps(square, 1.5);
  CHECK(steps.size() == 12);
  const Polyline open(Points{{0, 0}, {3, 0}}, false);
  CHECK(at_equal_lengths(open, 4).back() == Complex(3, 0));
  CHECK(open.at(99) == Complex(3, 0));
  CHECK(one_sided_distance(open, square) == 0);
  CHECK(one_sided_distance(square, open) == std::hypot(1, 4));  // from (4, 4) to (3, 0)
}

TEST_CASE("Correspondence: an outline is mapped to a moved copy of itself") {
  for (const unsigned seed : {1u, 2u, 7u}) {
    const Points outline = outlines::random(seed, seed % 2, 300);
    const Complex factor = std::polar(1.5, 2.2), shift(100, 20);
    const Polyline source(outline, true), target(moved(outline, factor, shift), true);
    const Correspondence pairs = ConformalStart(source, target, 0).best();
    CHECK(pairs.residual <= 0.02);
    for (double s = 0; s < source.length(); s += 0.07 * source.length())
      CHECK(std::abs(target.at(pairs(s)) - (factor * source.at(s) + shift)) <=
            0.01 * target.diagonal());
    // A full turn of the source corresponds to a full turn of the target. The argument is rounded
    // to 2^-53 of a length, and the correspondence stretches this error by a factor of less than
    // 1000.
    CHECK_THAT(pairs(5 + source.length()),
               Catch::WithinAbs(pairs(5) + target.length(), 1e-12 * target.length()));
  }
}

TEST_CASE("Correspondence: a square is not rotated when it is mapped to a circle or an ellipse") {
  const Polyline square(Points{{-200, -200}, {200, -200}, {200, 200}, {-200, 200}}, true);
  for (const double height : {1.0, 0.7}) {
    Points round = circle(0, 250, 200);
    for (Complex& z : round) z = {z.real(), height * z.imag()};
    std::rotate(round.begin(), round.begin() + 77, round.end());
    const Polyline target(round, true);
    const Correspondence pairs = ConformalStart(square, target, 1).best();
    // The middle of the right side stays on the right.
    const Complex to = target.at(pairs(600));
    CHECK(std::abs(std::arg(to)) <= 0.2);
  }
}

TEST_CASE(
    "Alternating fit: fixed targets give the least squares solution, and moving targets give "
    "decreasing energies") {
  const Cage cage = polygon_cage(outlines::random(4, false, 40));
  std::vector<BoundaryPoint> boundary_points;
  for (Index e = 0; e < cage.size(); ++e)
    for (const double t : {0.0, 0.3, 0.6}) boundary_points.push_back({e, t});
  const MatrixXc rows = cauchy_coordinates(cage, boundary_points, 0);
  VectorXc wanted(rows.rows());
  for (Index i = 0; i < wanted.size(); ++i) wanted[i] = 30.0 * std::polar(1.0, 0.7 * i);
  const MatrixXc half = rows.topRows(rows.rows() / 2), rest = rows.bottomRows(rows.rows() / 2);
  AlternatingFit fixed(
      {{half, 2, [&](const VectorXc&, VectorXc& targets) { targets = wanted.head(half.rows()); }},
       {rest, 2}});
  fixed.set_targets(1, wanted.tail(rest.rows()));
  fixed.start(wanted.head(half.rows()));
  const VectorXc best = rows.householderQr().solve(wanted);
  CHECK((fixed.unknowns() - best).norm() <= 1e-9 * best.norm());
  // The energy is the difference of |targets|^2 = 4 * 900 and a square of nearly that size, each a
  // sum of 120 terms that are rounded to 2^-53: 120 * 7200 * 2^-53 = 1e-10 at worst, of 73.
  CHECK_THAT(fixed.energy(),
             Catch::WithinAbs(4 * (rows * best - wanted).squaredNorm() / rows.rows(), 1e-10));
  fixed.step(AlternatingFit::Mode::anderson);
  CHECK((fixed.unknowns() - best).norm() <= 1e-9 * best.norm());

  const Polyline target(outlines::random(9, false, 200), true);
  const auto project = [&](const VectorXc& values, VectorXc& targets) {
    for (Index i = 0; i < values.size(); ++i) targets[i] = target.nearest(values[i]).point;
  };
  const auto normals = [&](const VectorXc& values, const VectorXc& targets, VectorXc& result) {
    for (Index i = 0; i < values.size(); ++i) {
      const Complex direction = values[i] - targets[i];
      result[i] = std::abs(direction) > 0 ? direction / std::abs(direction) : Complex(1);
    }
  };
  double after[3];
  for (const auto mode : {AlternatingFit::Mode::zeroth, AlternatingFit::Mode::anderson,
                          AlternatingFit::Mode::first_order}) {
    AlternatingFit fit({{rows, 1, project, normals}});
    fit.start(rows * controls_of(cage));
    double energy = fit.energy();
    for (int i = 0; i < 10; ++i) {
      fit.step(mode);
      CHECK(fit.energy() <= energy * (1 + 1e-12));
      energy = fit.energy();
    }
    after[static_cast<int>(mode)] = energy;
  }
  CHECK(after[1] < after[0]);
  CHECK(after[2] < after[0]);
}

TEST_CASE("Outline: random shapes are mapped onto random outlines without folds") {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Cage cage = polygon_cage(outlines::random(seed, seed % 2, 50));
    const Points outline = outlines::random(seed + 100, seed % 3 == 0, 400);
    INFO("seed " << seed);
    // Sample the boundary itself densely, because the mesh's boundary is coarse where limbs are
    // stretched.
    const OutlineMatch match = matched({cage, outline, {}, {}}, {});
    CHECK(match.zeros == 0);
    CHECK(match.psi.size() == 0);
    std::vector<BoundaryPoint> boundary_points;
    for (Index e = 0; e < match.basis.size(); ++e)
      for (int k = 0; k < 15; ++k) boundary_points.push_back({e, (k + 0.37) / 15});
    const VectorXc f = cauchy_coordinates(match.basis, boundary_points, 0) * match.phi;
    const Polyline target(outline, true), boundary(Points(f.begin(), f.end()), true);
    CHECK(one_sided_distance(boundary, target) < 0.01 * target.diagonal());
    CHECK(one_sided_distance(target, boundary) < 0.01 * target.diagonal());
  }
}

/// A polygon with corners at a few random directions, rotated by some angle, whose edges are
/// divided into `parts`. The rounded vertices bend by some ulps to either side.
Points straight_runs(std::mt19937& random, int corners, int parts) {
  std::uniform_real_distribution<double> unit(0, 1);
  Points ends;
  for (int i = 0; i < corners; ++i)
    ends.push_back(
        std::polar(70 + 60 * unit(random), 2 * kPi * (i + 0.6 * unit(random)) / corners + 0.3));
  Points polygon;
  for (size_t i = 0; i < ends.size(); ++i)
    for (int k = 0; k < parts; ++k)
      polygon.push_back(ends[i] + (ends[(i + 1) % ends.size()] - ends[i]) * (1.0 * k / parts));
  return polygon;
}

TEST_CASE("Inner loop: along straight runs of vertices, it does not cross itself") {
  for (const unsigned seed : seeds_of("inner loops", {1, 2, 3, 4, 5, 6})) {
    std::mt19937 random(seed);
    const Points polygon = straight_runs(random, 5 + static_cast<int>(seed % 4), 12),
                 loop = inner_loop(polygon, 0.2);
    CAPTURE(seed);
    CHECK_FALSE(self_crossing(loop));
    // It keeps the distance that was asked for.
    int near = 0;
    for (const Complex& z : loop) near += Polyline(polygon, true).nearest(z).distance < 0.19;
    CHECK(near == 0);
    Points zeros;
    for (int k = 0; k < 3; ++k) zeros.push_back(25.0 * random_complex(random));
    const auto at = [&](const Points& points) {
      VectorXc values(static_cast<Index>(points.size()));
      for (Index i = 0; i < values.size(); ++i) {
        values[i] = 1;
        for (const Complex& zero : zeros) values[i] *= points[static_cast<size_t>(i)] - zero;
      }
      return values;
    };
    CHECK(zeros_inside(loop, at(loop), at) == 3);
  }
}

TEST_CASE("Outline: keeping the picture upright never makes it fold") {
  for (const unsigned seed : seeds_of("upright outlines", {1, 2, 3, 4})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const Points from = straight_runs(random, 6, 8), to = straight_runs(random, 5, 10);
    OutlineTask task{polygon_cage(from), to, {}, {}};
    OutlineSettings free;
    free.upright = 0;
    const OutlineMatch plain = matched(task, free);
    CHECK(matched(task, {}).zeros <= plain.zeros);
    // The same with pins that are moved a little.
    for (const size_t i : {size_t{0}, from.size() / 2}) task.pins.push_back(0.5 * from[i]);
    const VectorXc images = cauchy_coordinates(plain.basis, task.pins) * plain.phi;
    for (const Complex& image : images)
      task.pinned.push_back(image + 15.0 * random_complex(random));
    CHECK(matched(task, {}).zeros <= matched(task, free).zeros);
  }
}

TEST_CASE("Outline: shapes with limbs and corners are mapped onto each other without folds") {
  const Points letter{{0, 0},     {200, 0},  {200, 60}, {60, 60},   {60, 130},  {170, 130},
                      {170, 190}, {60, 190}, {60, 260}, {200, 260}, {200, 320}, {0, 320}},
      bar{{-300, -30}, {300, -30}, {300, 30}, {-300, 30}}, round = circle(0, 100, 120);
  Points star;
  for (int i = 0; i < 10; ++i) star.push_back(std::polar(i % 2 ? 76.4 : 200.0, kPi * i / 5));
  const std::pair<Points, Points> pairs[] = {{round, star}, {star, round}, {round, letter},
                                             {bar, star},   {star, bar},   {letter, bar}};
  for (const auto& [from, to] : pairs) {
    const OutlineMatch match = matched({polygon_cage(from), to, {}, {}}, {});
    INFO(from.size() << " corners onto " << to.size());
    CHECK(match.zeros == 0);
    CHECK(match.hausdorff < 0.01 * Polyline(to, true).diagonal());
  }
}

TEST_CASE(
    "Outline: moving, rotating or scaling either shape only changes the frame of the result") {
  constexpr double kRounding = 1e-7;  // over the zipper's 800 arcs, relative to the outline's size
  const Points shape = outlines::random(11, true, 50), outline = outlines::random(12, false, 300);
  const Complex factor = std::polar(4.0, 0.8), shift(30, 50);
  OutlineSettings settings;
  settings.upright = 0;
  const OutlineMatch plain = matched({polygon_cage(shape), outline, {}, {}}, settings);
  const auto differs = [&](const OutlineMatch& other, const Points& at, const Points& at_other,
                           Complex turn, Complex move) {
    const VectorXc f = cauchy_coordinates(plain.basis, at) * plain.phi,
                   g = cauchy_coordinates(other.basis, at_other) * other.phi;
    return (turn * f.array() + move - g.array()).abs().maxCoeff() / (600 * std::abs(turn));
  };
  const Points inner{{10, 20}, {-60, 30}, {50, -40}};
  CHECK(differs(matched({polygon_cage(shape), moved(outline, factor, shift), {}, {}}, settings),
                inner, inner, factor, shift) <= kRounding);
  CHECK(differs(matched({polygon_cage(moved(shape, factor, shift)), outline, {}, {}}, settings),
                inner, moved(inner, factor, shift), 1, 0) <= kRounding);
  CHECK(differs(matched({polygon_cage(moved(shape, 4, 0)), moved(outline, 4, 0), {}, {}}, settings),
                inner, moved(inner, 4, 0), 4, 0) <= 1e-12);
  // Both shapes are moved together, with the default settings.
  const Points pin{{10, 20}}, pinned{{40, -30}};
  for (const bool with_pin : {false, true}) {
    const auto both = [&](Complex turn, Complex move) {
      return matched({polygon_cage(moved(shape, turn, move)), moved(outline, turn, move),
                      with_pin ? moved(pin, turn, move) : Points{},
                      with_pin ? moved(pinned, turn, move) : Points{}},
                     {});
    };
    const OutlineMatch here = both(1, 0), there = both(factor, shift);
    const VectorXc f = cauchy_coordinates(here.basis, inner) * here.phi,
                   g = cauchy_coordinates(there.basis, moved(inner, factor, shift)) * there.phi;
    CHECK((factor * f.array() + shift - g.array()).abs().maxCoeff() / 2400 <= 1e-11);
  }
}

TEST_CASE(
    "Outline: with the published method, a square approaches a blob as in the paper's figure") {
  // The distance falls by a factor of about ten from iteration 1 to 10, and again from 10 to 100
  // (SB16 fig. 2).
  const Points square{{-200, -200}, {200, -200}, {200, 200}, {-200, 200}};
  const Points blob = outlines::random(21, false, 400);
  double rms[3];
  int at = 0;
  for (const int iterations : {1, 10, 100}) {
    OutlineSettings settings;
    settings.published = true;
    settings.vertices = 100;
    settings.most_iterations = iterations;
    rms[at++] = matched({polygon_cage(square), blob, {}, {}}, settings).rms / 600;
  }
  INFO(rms[0] << ", " << rms[1] << ", " << rms[2]);
  CHECK(rms[0] < 0.1);
  CHECK(rms[1] < 0.5 * rms[0]);
  CHECK(rms[2] < rms[1]);
}

TEST_CASE("Outline: the map of a shape onto a circle is its Riemann map") {
  const Points shape = outlines::random(31, true, 120);
  const Points round = circle({700, 300}, 250, 300);
  const Onto onto(polygon_cage(shape), round);
  for (const int v : onto.rest.mesh->boundary)
    REQUIRE(std::abs(std::abs(onto.map.f[v] - Complex(700, 300)) - 250) <= 1e-3 * 500);
  // Up to automorphisms of the disk, it is the zipper's map.
  const RiemannMap exact(outlines::with_steps(Polyline(shape, true), 3), 0);
  const auto cross_ratio = [](Complex a, Complex b, Complex c, Complex d) {
    return (a - c) * (b - d) / ((a - d) * (b - c));
  };
  const auto points = onto.deformer->point_map(onto.pose);
  const Complex z[4] = {{0, 0}, {40, 30}, {-60, 20}, {10, -70}};
  const auto f = [&](int i) { return points->at(z[i]).f; };
  const auto g = [&](int i) { return exact.at(z[i]); };
  CHECK(std::abs(cross_ratio(f(0), f(1), f(2), f(3)) - cross_ratio(g(0), g(1), g(2), g(3))) <=
        1e-2);
}

TEST_CASE("Outline: soft maps trade angles for a closer fit, and their derivatives are correct") {
  const Cage cage = polygon_cage(Points{{-200, -100}, {200, -100}, {200, 100}, {-200, 100}});
  const Points outline = circle(0, 200, 200);
  const Onto hard(cage, outline), soft(cage, outline, {{"softness", 1}});
  CHECK(hard.map.fzbar.isZero(0));
  CHECK(soft.map.fzbar.cwiseAbs().maxCoeff() > 0.01);
  // More freedom never increases the energy.
  OutlineSettings settings;
  settings.smoothness = 1;
  settings.most_iterations = 100;
  const auto energy = [&](double stiffness) {
    settings.stiffness = stiffness;
    return matched({cage, outline, {}, {}}, settings).energies.back();
  };
  const double conformal = energy(0), nearly = energy(1), loose = energy(1e-3);
  INFO(conformal << ", " << nearly << ", " << loose);
  CHECK(nearly <= conformal);
  CHECK(loose < 0.9 * conformal);
  const auto points = soft.deformer->point_map(soft.pose);
  const double h = 1e-4;
  for (const Complex z : {Complex(20, 30), Complex(-120, 50)}) {
    const auto at = points->at(z);
    const Complex fx = (points->at(z + h).f - points->at(z - h).f) / (2 * h),
                  fy = (points->at(z + h * kI).f - points->at(z - h * kI).f) / (2 * h);
    CHECK(std::abs((fx - kI * fy) / 2.0 - at.fz) <= 1e-6);
    CHECK(std::abs((fx + kI * fy) / 2.0 - at.fzbar) <= 1e-6);
  }
  for (size_t v = 0; v < soft.rest.samples.size(); v += 50)
    CHECK(std::abs(points->at(soft.rest.samples[v]).f - soft.map.f[static_cast<Index>(v)]) <= 1e-7);
}

TEST_CASE("Outline: pins guide the map, and cages may be curved or clockwise") {
  const Points outline = circle(0, 300, 200);
  const Cage cage = polygon_cage(outlines::random(41, false, 40));
  const OutlineTask task{cage, outline, {{0, 0}}, {{60, 40}}};
  OutlineSettings settings;
  settings.vertices = 100;
  const auto off = [&](const OutlineMatch& match) {
    const Points pin{{0, 0}};
    return std::abs((cauchy_coordinates(match.basis, pin) * match.phi)[0] - Complex(60, 40));
  };
  settings.pin_weight = 1e-3;
  const double light = off(matched(task, settings));
  settings.pin_weight = 10;
  settings.most_iterations = 50;
  const OutlineMatch heavy = matched(task, settings);
  CHECK(off(heavy) < 0.3 * light);
  for (const Cage& other : {reversed(cage), shapes::curved_star(6, 2, 0.2, 3)}) {
    Points scaled = moved(outline, box_of(controls_of(other)).diagonal() / 800, 0);
    std::reverse(scaled.begin(), scaled.end());
    const Onto onto(other, scaled, {{"vertices", 60}});
    INFO(onto.map.note);
    for (const int v : onto.rest.mesh->boundary)
      CHECK(std::abs(std::abs(onto.map.f[v]) - std::abs(scaled[0])) <= 0.01 * std::abs(scaled[0]));
  }
}

TEST_CASE("Outline: a pin selects one of the conformal maps, and nothing folds") {
  // For each target and rotation there is one map onto a disk, however near the target is to the
  // boundary.
  const Points outline = circle({20, 10}, 150, 80);
  const Complex pin(30, 0);
  OutlineFit fit(polygon_cage(circle(0, 100, 60)), outline, {pin}, {});
  const double size = Polyline(outline, true).diagonal();
  for (const double radius : {0.0, 60.0, 120.0, 140.0}) {
    INFO("radius " << radius);
    for (const bool rough : {false, true}) {
      const Complex wanted = Complex(20, 10) + std::polar(radius, rough ? 1.1 : 1.0);
      if (rough)
        fit.follow({wanted}, fit.checkpoint());
      else
        fit.solve({wanted});
      const OutlineMatch match = fit.after(fit.iterations());
      const Complex there = (cauchy_coordinates(match.basis, Points{pin}) * match.phi)[0];
      CHECK(match.zeros == 0);
      CHECK(match.hausdorff < 0.01 * size);
      CHECK(std::abs(there - wanted) < 0.01 * size);
      CHECK_THAT(match.pins_missed, Catch::WithinAbs(std::abs(there - wanted), 1e-9));
      CHECK(match.pins_held == 0);
    }
  }
  // The pin cannot go outside the outline: it is held inside.
  const Complex outside = Complex(20, 10) + std::polar(400.0, 2.0);
  fit.solve({outside});
  const OutlineMatch held = fit.after(fit.iterations());
  CHECK(held.pins_held == 1);
  CHECK(held.zeros == 0);
  CHECK(held.hausdorff < 0.01 * size);
  const Complex there = (cauchy_coordinates(held.basis, Points{pin}) * held.phi)[0];
  CHECK(std::arg((there - Complex(20, 10)) / std::polar(1.0, 2.0)) == Approx(0).margin(0.05));
}

TEST_CASE("Outline: between shapes with corners, pins reach their targets and nothing folds") {
  const Points square{{0, 0}, {300, 0}, {300, 300}, {0, 300}},
      strip{{0, 0}, {1000, 0}, {1000, 200}, {0, 200}}, round = circle({150, 150}, 150, 60);
  struct Case {
    Points from, to;
    Complex pin;
    std::vector<Complex> wanted;
  };
  for (const auto& [from, to, pin, wanted] :
       {Case{square, square, {150, 150}, {{180, 150}, {225, 150}, {280, 150}, {200, 200}}},
        Case{round, square, {150, 150}, {{240, 150}}},
        Case{strip, strip, {800, 100}, {{650, 100}, {300, 100}}}}) {
    OutlineFit fit(polygon_cage(from), to, {pin}, {});
    const double size = Polyline(to, true).diagonal();
    for (const Complex& place : wanted)
      for (const bool rough : {false, true}) {
        INFO(place << (rough ? " followed" : ""));
        if (rough)
          fit.follow({place}, fit.checkpoint());
        else
          fit.solve({place});
        const OutlineMatch match = fit.after(fit.iterations());
        CHECK(match.zeros == 0);
        CHECK(match.pins_missed < 2e-3 * size);
        CHECK(match.hausdorff < 0.025 * size);  // a corner is rounded
      }
  }
}

TEST_CASE("Outline: pins stay inside if their targets are beyond a side or a corner") {
  const Points square{{0, 0}, {300, 0}, {300, 300}, {0, 300}};
  OutlineFit fit(polygon_cage(square), square, {{150, 150}}, {});
  for (const Complex outside : {Complex(450, 150), Complex(400, 400), Complex(-90, -20)}) {
    fit.solve({outside});
    const OutlineMatch match = fit.after(fit.iterations());
    INFO(outside);
    CHECK(match.pins_held == 1);
    CHECK(match.pins_missed < 0.01 * Polyline(square, true).diagonal());
    CHECK(match.hausdorff < 0.04 * Polyline(square, true).diagonal());
  }
}

// The tip is narrower than the gaps between the directions that are tried around it.
TEST_CASE("Outline: a pin stays inside if its target is beyond a narrow tip") {
  const Points tip{{0, 0}, {300, -50}, {300, 50}};
  for (const double turn : first_of<double>({0.3, 2.0, 0.1, 0.9}, 2)) {
    const Complex direction = std::polar(1.0, turn);
    OutlineFit at_tip(polygon_cage(tip), moved(tip, direction, 0), {{250, 0}}, {});
    at_tip.solve({-50.0 * direction});
    const OutlineMatch match = at_tip.after(at_tip.iterations());
    INFO("turn " << turn);
    CHECK(match.pins_held == 1);
    CHECK(match.pins_missed < 6);
    CHECK(match.hausdorff < 60);
  }
}

TEST_CASE(
    "Outline: strips are matched even if points at their ends coincide on the disk's boundary") {
  for (const double aspect : {8.0, 20.0, 40.0}) {
    INFO("aspect " << aspect);
    const double length = 100 * aspect;
    const Points straight{{0, 0}, {length, 0}, {length, 100}, {0, 100}};
    Points bent;
    for (const int side : {0, 1})
      for (int i = 0; i <= 100; ++i) {
        const double t = side == 0 ? i / 100.0 : 1 - i / 100.0;
        bent.push_back(std::polar(length / 3 + (side == 0 ? 50 : -50), 3 * t - 1.5));
      }
    for (const Points& onto : {straight, bent}) {
      const OutlineMatch match = matched({polygon_cage(straight), onto, {}, {}}, {});
      CHECK(match.zeros == 0);
      CHECK(match.hausdorff < 0.015 * Polyline(onto, true).diagonal());
      CHECK(match.basis.size() < 400);
    }
  }
}

TEST_CASE("Outline: pins that contradict each other are reported") {
  const Cage cage = polygon_cage(outlines::random(41, false, 50));
  const Points around = outlines::random(42, false, 300);
  Onto onto(cage, around);
  const auto point = onto.deformer->point_map(onto.pose);
  // Two pins at the positions to which the map takes them without pins, then much closer together.
  onto.rest.pins = {{{-40, 0}}, {{40, 0}}};
  onto.deformer = method_named("outline").prepare(onto.rest, nullptr);
  const Complex a = point->at({-40, 0}).f, b = point->at({40, 0}).f;
  SampledMap map = onto.deformer->deform({cage, {{a}, {b}}}, {});
  INFO(map.note);
  CHECK(map.note.find("contradict") == std::string::npos);
  map = onto.deformer->deform({cage, {{a}, {0.8 * a + 0.2 * b}}}, {});
  CHECK_THAT(map.note, Catch::Contains("pins contradict each other") && Catch::Contains("missed"));
  map = onto.deformer->deform({cage, {{a}, {b + 1e5}}}, {});
  CHECK_THAT(map.note, Catch::Contains("outside the outline is held inside"));
}

TEST_CASE(
    "Outline: dragged pins are followed approximately, and released pins are solved from scratch") {
  const Cage cage = polygon_cage(outlines::random(41, false, 50));
  Onto onto(cage, outlines::random(42, false, 300));
  onto.rest.pins = {{{0, 0}}};
  onto.deformer = method_named("outline").prepare(onto.rest, nullptr);
  std::shared_ptr<const Solution> last;
  const auto map_of = [&](Complex pin, bool draft) {
    Pose pose{cage, {{pin}}};
    SampledMap map = onto.deformer->deform(pose, {false, draft}, last.get());
    last = map.solution;
    return map.f;
  };
  const VectorXc start = map_of({0, 0}, false);
  VectorXc dragged;
  for (int frame = 1; frame <= 8; ++frame) dragged = map_of({5.0 * frame, -3.0 * frame}, true);
  const VectorXc end = map_of({40, -24}, false);
  CHECK((end - start).cwiseAbs().maxCoeff() > 5);
  CHECK((dragged - end).cwiseAbs().mean() < 0.6 * (end - start).cwiseAbs().mean());
  CHECK(map_of({0, 0}, false) == start);
  CHECK(map_of({40, -24}, false) == end);
}

TEST_CASE("Outline: maps of curved cages stay near the outline for all degrees of softness") {
  // Each curve needs at least as many samples as unknowns. Otherwise the map explodes between them.
  Cage curved = shapes::curved_star(9, 3, 0.15, 4);
  const Points around = outlines::random(51, false, 300);
  // The solver's energy is the difference of sums of |f|^2, which is 9 L^2 on average, over at most
  // 1380 samples, and each sum is rounded by 2^-53 at every sample: 1380 * 9 * 2^-53 = 1.4e-12.
  constexpr double kRounding = 2e-12;
  for (const double softness : first_of<double>({0.3, 0.0, 1.0}, 2)) {
    Onto onto(curved, around, {{"softness", softness}});
    INFO("softness " << softness);
    CHECK(flips_away_from_vertices(*onto.rest.mesh, onto.map.f) == 0);
    const Box box = box_of(around);
    for (const Complex& z : onto.map.f) REQUIRE(std::abs(z - box.center()) < 0.55 * box.diagonal());
    // Alternating minimization never raises the energy.
    const std::vector<double>& energies = onto.map.energies;
    for (size_t i = 1; i < energies.size(); ++i) CHECK(energies[i] <= energies[i - 1] + kRounding);
    // The last energy is the energy of the map itself. With a softness of 0, the last step follows
    // the conformal map, and only its distances from the outline count.
    OutlineSettings settings;
    settings.stiffness = stiffness_of(softness);
    const Energy energy = energy_of(matched({curved, around, {}, {}}, settings), curved, around);
    const double expected = softness == 0 ? energy.misses
                                          : energy.misses + settings.smoothness * energy.bends +
                                                settings.stiffness * energy.shears;
    CHECK_THAT(energies.back(), Catch::WithinAbs(expected, kRounding));
  }
}

TEST_CASE("Outline: invalid outlines are refused") {
  const Cage cage = polygon_cage(circle(0, 100, 12));
  const auto refused = [&](const Points& outline) {
    CHECK_THROWS_AS(matched({cage, outline, {}, {}}, {}), Error);
  };
  refused({{0, 0}, {1, 1}});
  refused({{0, 0}, {1, 0}, {0, 1}, {1, 1}});
  refused({{0, 0}, {1, 0}, {2, 0}});
  refused({{0, 0}, {1, 0}, {1, 0}, {0, 1}});
  refused({{0, 0}, {1, 0}, {NAN, 1}});
  // An outline with ten thousand points is accepted.
  const OutlineMatch fine = matched({cage, circle(3, 50, 10000), {}, {}}, {});
  CHECK(fine.hausdorff <= 0.1);
}

TEST_CASE("Outline: without an outline, nothing moves at rest") {
  const Onto onto(polygon_cage(circle({5, 5}, 100, 12)), {});
  for (size_t i = 0; i < onto.rest.samples.size(); ++i)
    REQUIRE(onto.map.f[static_cast<Index>(i)] == onto.rest.samples[i]);
  CHECK(onto.map.note.find("outline") != std::string::npos);
}

}  // namespace holomorph::outline_test
