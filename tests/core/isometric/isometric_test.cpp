// Tests the isometric energy and its minimization: derivatives against differences, minima against
// Ipopt and against the figures of the specification, and the certificate of every answer.
#include <Eigen/Eigenvalues>
#include <random>

#include "core/isometric/barrier.h"
#include "core/isometric/isometric_space.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "core/solvers/real_form.h"
#include "support/catch.h"
#include "support/ipopt.h"
#include "support/seeds.h"

namespace holomorph::isometric_test {

namespace {

const Points kBar{{0, -.5}, {6, -.5}, {6, .5}, {0, .5}};

/// A domain, its pins, and their targets. Energies are measured as in the specification: at the
/// boundary alone, with a penalty of 1e4 / size^2.
struct Problem {
  Points domain, pins, targets;
  int vertices = 50;
  std::vector<Points> holes = {};

  Cage cage() const {
    Cage cage = polygon_cage(domain);
    for (const Points& hole : holes) add_hole(cage, polygon_cage(hole).segments);
    return cage;
  }
};

struct Prepared {
  Mesh mesh;
  std::shared_ptr<const BoundaryBasis> basis;
  IsometricSpace space;
  IsometricTarget target;

  explicit Prepared(const Problem& problem, IsometricEnergy energy = {})
      : mesh(domain_mesh(problem.cage(), {1500})),
        basis(std::make_shared<const BoundaryBasis>(problem.cage(), problem.vertices,
                                                    6 * problem.vertices)),
        space(basis, mesh, handles(problem), {}, {}, energy) {
    target.stations.resize(static_cast<Index>(problem.pins.size()));
    for (size_t i = 0; i < problem.pins.size(); ++i)
      target.stations[static_cast<Index>(i)] = problem.targets[i] - problem.pins[i];
  }

 private:
  static IsometricHandles handles(const Problem& problem) {
    const Index count = static_cast<Index>(problem.pins.size());
    return {problem.pins, count, VectorXd::Ones(count), {}, {}};
  }
};

const IsometricSpace::Settings kSettings{.pin_weight = 1e4};

Problem bent_by_270_degrees() {
  Problem problem{kBar, {}, {}};
  const double radius = 10 / (3 * kPi);
  for (int s = 0; s <= 5; ++s) {
    problem.pins.push_back({0.5 + s, 0});
    problem.targets.push_back(
        {radius * std::sin(s / radius), radius - radius * std::cos(s / radius)});
  }
  return problem;
}

Points regular_polygon(int corners, double radius) {
  Points polygon;
  for (int i = 0; i < corners; ++i) polygon.push_back(std::polar(radius, 2 * kPi * i / corners));
  return polygon;
}

Points square_around(Complex center, double half) {
  return {center + half * Complex(-1, -1), center + half * Complex(1, -1),
          center + half * Complex(1, 1), center + half * Complex(-1, 1)};
}

}  // namespace

TEST_CASE("Isometric energy: derivatives agree with differences, and the Hessian is definite") {
  for (const unsigned seed : seeds_of("isometric energy", {1, 2})) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int k = 0; k < 200; ++k) {
      using Form = IsometricEnergy::Form;
      const IsometricEnergy energy{std::array{Form::plain, Form::exponential, Form::power}[k % 3],
                                   uniform(1, 2)};
      const double u = uniform(-0.7, 0.7);
      const Complex nu = std::polar(uniform(0, 0.8), uniform(0, 7));
      const auto value = energy.with_derivatives(u, nu.real(), nu.imag());
      CHECK(value.value == Approx(energy.value(u, nu.real(), nu.imag())).epsilon(1e-12));
      CHECK(value.value >= 2 - 1e-12);
      Eigen::Vector3d x(u, nu.real(), nu.imag());
      for (int i = 0; i < 3; ++i) {
        // The error is h^2 / 6 times the third derivative plus the rounding error over h.
        constexpr double kStep = 1e-5;
        const auto at = [&](double step) {
          Eigen::Vector3d y = x;
          y[i] += step;
          return energy.with_derivatives(y[0], y[1], y[2]);
        };
        const auto before = at(-kStep), after = at(kStep);
        const double scale = 1 + value.hessian.cwiseAbs().maxCoeff();
        CHECK(std::abs((after.value - before.value) / (2 * kStep) - value.gradient[i]) <=
              1e-5 * scale);
        CHECK(((after.gradient - before.gradient) / (2 * kStep) - value.hessian.col(i)).norm() <=
              1e-5 * scale);
      }
      // Convex: positive definite up to rounding.
      CHECK(value.hessian.ldlt().vectorD().minCoeff() > 0);
    }
  }
}

TEST_CASE("Isometric energy: rigid motions have the value 2, and inverse maps equal values") {
  const IsometricEnergy energy;
  CHECK(energy.value(0, 0, 0) == 2);
  // Stretches a and b: u = ln((a + b) / 2), |nu| = (a - b) / (a + b).
  const auto of = [&](double a, double b) {
    return energy.value(std::log((a + b) / 2), (a - b) / (a + b), 0);
  };
  const auto expected = [](double a, double b) {
    return 0.5 * (a * a + b * b + 1 / (a * a) + 1 / (b * b));
  };
  for (const auto& [a, b] : {std::pair(2.0, 1.0), std::pair(1.5, 0.4), std::pair(1.0, 0.1)}) {
    CHECK(of(a, b) == Approx(expected(a, b)).epsilon(1e-13));
    CHECK(of(1 / b, 1 / a) == Approx(of(a, b)).epsilon(1e-13));
  }
}

TEST_CASE("Isometric energy: the exponential form stays finite, smooth and convex far away") {
  for (const double s : {1.0, 1.5, 4.0}) {
    const IsometricEnergy energy{IsometricEnergy::Form::exponential, s};
    CHECK(std::isfinite(energy.value(20, 0, 0)));
    CHECK(std::isfinite(energy.value(0, 0, 1 - 1e-9)));
    // Where s (e - 2) = 30, the form changes.
    const double u = 0.5 * std::acosh((2 + 30 / s) / 2), h = 1e-6;
    const auto before = energy.with_derivatives(u - h, 0, 0),
               after = energy.with_derivatives(u + h, 0, 0);
    CHECK(after.value == Approx(before.value).epsilon(1e-3));
    CHECK(after.gradient[0] == Approx(before.gradient[0]).epsilon(1e-3));
    CHECK(after.hessian(0, 0) == Approx(before.hessian(0, 0)).epsilon(1e-3));
    CHECK(energy.with_derivatives(4, 0.3, 0.2).hessian.ldlt().isPositive());
  }
}

TEST_CASE("Barrier: derivatives agree with differences, and it is infinite where a bound fails") {
  for (const unsigned seed : seeds_of("barrier", {1, 2})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 200; ++i) {
      const Bounds bounds{0.5 + 0.4 * uniform(random), std::exp(-1 + uniform(random)),
                          std::exp(1.1 + uniform(random))};
      const Barrier barrier(bounds);
      const double u = 2 * uniform(random), a = uniform(random), b = uniform(random),
                   r = std::hypot(a, b), value = barrier.value(u, a, b);
      INFO("seed " << seed << ", number " << i);
      const bool inside =
          r < bounds.k && u + r < std::log(bounds.Sigma) && std::exp(u) * (1 - r) > bounds.sigma;
      CHECK(std::isfinite(value) == inside);
      if (!inside) continue;
      CHECK(std::exp(u) * (1 + r) <= bounds.Sigma);
      const auto at = [&](const Eigen::Vector3d& x) {
        IsometricEnergy::Value sum{0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
        barrier.add_to(sum, 0.5, x[0], x[1], x[2]);
        return sum;
      };
      const Eigen::Vector3d x(u, a, b);
      const auto here = at(x);
      CHECK(here.value == Approx(0.5 * value));
      CHECK(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(here.hessian).eigenvalues()[0] >= 0);
      const double room = std::min(
          {bounds.k - r, std::log(bounds.Sigma) - u - r, 1 - bounds.sigma * std::exp(-u) - r});
      const double step = 1e-4 * room;
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(k);
        const auto after = at(x + d), before = at(x - d);
        CHECK(std::abs((after.value - before.value) / (2 * step) - here.gradient[k]) <=
              1e-5 * (here.gradient.norm() + 1 / room));
        CHECK(((after.gradient - before.gradient) / (2 * step) - here.hessian.col(k)).norm() <=
              1e-5 * here.hessian.norm());
      }
    }
  }
}

TEST_CASE("Isometric program: gradients agree with differences, and Hessians where pins are met") {
  for (const unsigned seed : seeds_of("isometric program", {5})) {
    const Prepared prepared(
        {kBar, {{0.5, 0}, {3, 0.2}, {5.5, 0}}, {{0.5, 0}, {3, 0.3}, {5, 1}}, 25});
    const IsometricSystem& system = prepared.space.system();
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    VectorXd x(system.unknowns()), direction(system.unknowns());
    for (double& value : x) value = 0.02 * normal(random);
    for (double& value : direction) value = normal(random);
    direction.normalize();
    IsometricSettings settings;
    settings.penalty = 30;
    const auto at = [&](double step) {
      return isometric_derivatives(system, prepared.target, settings, x + step * direction);
    };
    constexpr double kStep = 1e-5;
    const auto here = at(0), before = at(-kStep), after = at(kStep);
    const double slope = here.gradient.dot(direction);
    CHECK(std::abs((after.value - before.value) / (2 * kStep) - slope) <=
          1e-6 * (1 + std::abs(slope)));

    // With targets where the pins are, the offsets vanish, and Gauss-Newton is exact.
    IsometricTarget met = prepared.target;
    IsometricSettings nothing;
    nothing.iterations = 0;
    met.stations += minimized(system, prepared.target, nothing, x).offsets;
    const auto exact = [&](double step) {
      return isometric_derivatives(system, met, settings, x + step * direction);
    };
    const MatrixXd hessian = exact(0).hessian.selfadjointView<Eigen::Lower>();
    const VectorXd curved = (exact(kStep).gradient - exact(-kStep).gradient) / (2 * kStep);
    CHECK((hessian * direction - curved).norm() <= 1e-5 * curved.norm());
  }
}

TEST_CASE("Path tree: the nodes integrate functions of the basis almost to rounding") {
  const Points shape{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  const Mesh mesh = domain_mesh(polygon_cage(shape), {2000});
  const BoundaryBasis basis(polygon_cage(shape), 50, 300);
  for (const unsigned seed : seeds_of("path tree", {1})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 3);
    Points stations;
    while (stations.size() < 12)
      if (const Complex z(uniform(random), uniform(random)); winding_number(shape, z) != 0)
        stations.push_back(z);
    const PathTree tree(mesh, basis.polygon(), stations);
    // A function with a pole just outside the polygon, as close as a basis function's vertex.
    const Complex pole =
        basis.polygon().points[7] + 0.01 * (basis.polygon().points[7] - Complex(0.5, 0.5));
    const auto integral = [&](Complex z) { return std::log(z - pole); };
    std::vector<Complex> f(tree.pieces().size());
    for (size_t e = 0; e < f.size(); ++e) {
      const auto& piece = tree.pieces()[e];
      CHECK(std::abs(piece.to - piece.from) <=
            1.5000001 *
                nearest_on_polygon(basis.polygon(), 0.5 * (piece.from + piece.to)).distance);
      if (piece.parent >= 0) f[e] = f[static_cast<size_t>(piece.parent)];
      for (Index k = 0; k < PathTree::kNodes; ++k) {
        const Index node = static_cast<Index>(e) * PathTree::kNodes + k;
        f[e] += tree.weights()[node] / (tree.nodes()[static_cast<size_t>(node)] - pole);
      }
    }
    for (size_t i = 1; i < stations.size(); ++i) {
      const Complex expected = integral(stations[i]) - integral(stations[0]);
      const Complex off = f[static_cast<size_t>(tree.ends()[i])] - expected;
      const double turns = std::round(off.imag() / (2 * kPi));
      // The pole is nearer than the basis' own singularities, so the error is larger than theirs.
      CHECK(std::abs(off - 2 * kPi * turns * kI) <= 1e-5);
    }
  }
}

TEST_CASE("Isometric maps: the energies of the specification, certified") {
  struct Row {
    Problem problem;
    double energy;
  };
  const std::vector<Row> rows{
      {{kBar, {{.5, 0}, {3, 0}, {5.5, 0}}, {{.5, 0}, {3, 0}, {3, 2.5}}}, 2.211},
      {{kBar, {{.5, 0}, {5.5, 0}, {5, 0}}, {{.5, 0}, {.5, 2.2}, {1, 2.2}}}, 2.364},
      {bent_by_270_degrees(), 2.592},
      {{kBar, {{.5, 0}, {5.5, 0}}, {{.5, 0}, {8, 0}}}, 2.283},
      {{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},
        {{.5, .5}, {.5, 2.5}, {2.5, .5}},
        {{.5, .5}, {.5, 2.5}, {2, 1.7}}},
       2.065},
      {{regular_polygon(48, 2),
        {{-1.5, 0}, {0, 1.5}, {1.5, 0}},
        {{-1.5, 0}, {0, 1.5}, {2.5, .8}},
        90,
        {regular_polygon(32, 1)}},
       2.119},
      {{{{-3, -1.5}, {3, -1.5}, {3, 1.5}, {-3, 1.5}},
        {{-2.6, 0}, {0, 0}, {2.6, 0}},
        {{-2.6, 0}, {0, 0}, {2, 1.6}},
        80,
        {square_around(-1.5, .7), square_around(1.5, .7)}},
       2.056}};
  for (size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const Prepared prepared(row.problem);
    const IsometricMap map = prepared.space.solved(prepared.target, kSettings);
    INFO("energy " << map.solution.energy << " for " << row.energy << ", "
                   << map.solution.iterations << " iterations");
    CHECK(std::abs(map.solution.energy - row.energy) <= 0.01 * row.energy);
    CHECK(map.certificate.holds);
    CHECK(map.solution.converged);
    for (const Complex& gap : map.solution.gaps) CHECK(std::abs(gap) <= 1e-7);
    if (i % 3 != 0 && !soaks()) continue;
    // Twice as many vertices hardly lower the energy.
    Problem finer = row.problem;
    finer.vertices *= 2;
    const Prepared twice(finer);
    const IsometricMap again = twice.space.solved(twice.target, kSettings);
    CHECK(std::abs(again.solution.energy - map.solution.energy) <= 0.01 * row.energy);
  }
}

TEST_CASE("Isometric maps: rest is exactly the identity, and rigid motions are reproduced") {
  Problem problem{kBar, {{.5, 0}, {3, .2}, {5.5, 0}}, {{.5, 0}, {3, .2}, {5.5, 0}}};
  const Prepared rest(problem);
  CHECK(rest.space.solved(rest.target, kSettings).solution.x.isZero(0));
  for (const unsigned seed : seeds_of("rigid motions", {1, 2})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-3, 3);
    const Complex turn = std::polar(1.0, uniform(random)), move(uniform(random), uniform(random));
    for (size_t i = 0; i < problem.pins.size(); ++i)
      problem.targets[i] = turn * problem.pins[i] + move;
    const Prepared prepared(problem);
    const IsometricMap map = prepared.space.solved(prepared.target, kSettings);
    CHECK(map.solution.offsets.cwiseAbs().maxCoeff() <= 1e-9);
    CHECK(std::abs(map.solution.energy - 2) <= 1e-9);
    const VectorXc l = rest.basis->values(rest.basis->samples()) * map.map.l;
    CHECK((l.array().exp() - turn).abs().maxCoeff() <= 1e-9);
  }
}

TEST_CASE("Isometric maps: exact pins are met, and soft pins give way only where they must") {
  const Problem problem{kBar, {{.5, 0}, {3, 0}, {5.5, 0}}, {{.5, 0}, {3, 0}, {3, 2.5}}};
  const Prepared prepared(problem);
  const IsometricMap soft = prepared.space.solved(prepared.target, kSettings),
                     exact = prepared.space.solved(prepared.target, {1e4, true});
  CHECK(soft.solution.offsets.cwiseAbs().maxCoeff() > 1e-5);
  CHECK(exact.solution.offsets.cwiseAbs().maxCoeff() <= 1e-8);
  CHECK(exact.solution.energy > soft.solution.energy);
  CHECK(exact.certificate.holds);
}

TEST_CASE("Isometric maps: proved extremes are bounds, and are attained to within 1 %") {
  for (const unsigned seed : seeds_of("proved extremes", {1, 2, 3})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Problem problem{kBar, {{.5, 0}, {2, .3}, {4, -.3}, {5.5, 0}}, {}};
    for (const Complex& z : problem.pins)
      problem.targets.push_back(z + 0.8 * Complex(uniform(random), uniform(random)));
    const Prepared prepared(problem);
    const IsometricMap map = prepared.space.solved(prepared.target, kSettings);
    REQUIRE(map.certificate.holds);
    const Extremes proved = prepared.space.extremes(map.map);
    Points dense;  // on the boundary, where all extremes lie
    constexpr int kEach = 40;
    for (const BoundaryPiece& piece : prepared.basis->pieces())
      for (int k = 0; k < kEach; ++k)
        dense.push_back(piece.start + static_cast<double>(k) / kEach * (piece.end - piece.start));
    const MatrixXc c = prepared.basis->values(dense);
    const VectorXc l = c * map.map.l, nu = c * map.map.w;
    Extremes seen;
    for (Index i = 0; i < l.size(); ++i) {
      const double size = std::exp(l[i].real()), shear = std::abs(nu[i]);
      seen.shear = std::max(seen.shear, shear);
      seen.smallest = std::min(seen.smallest, size * (1 - shear));
      seen.largest = std::max(seen.largest, size * (1 + shear));
    }
    constexpr double kClose = 1.011, kSmall = 1e-3;
    CHECK(proved.shear >= seen.shear - 1e-12);
    CHECK(proved.shear <= kClose * seen.shear + kSmall);
    CHECK(proved.smallest <= seen.smallest + 1e-12);
    CHECK(proved.smallest >= seen.smallest / kClose - kSmall);
    CHECK(proved.largest >= seen.largest - 1e-12);
    CHECK(proved.largest <= kClose * seen.largest + kSmall);
  }
}

TEST_CASE("Isometric maps: drafts converge to the final answer that starts from their turns") {
  for (const unsigned seed : seeds_of("isometric drags", {1})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const Prepared prepared({kBar, {{.5, 0}, {3, 0}, {5.5, 0}}, {{.5, 0}, {3, 0}, {5.5, 0}}});
    IsometricTarget target = prepared.target;
    IsometricMap map = prepared.space.solved(target, kSettings);
    const Complex end(uniform(random) * 2, 1 + uniform(random));
    // The drag takes 25 frames. Then the pointer rests until drafts no longer change.
    double before = 0;
    for (int frame = 1; frame <= 300; ++frame) {
      target.stations[2] = end * std::min(frame / 25.0, 1.0);
      map = prepared.space.followed(target, kSettings, map);
      INFO("frame " << frame);
      CHECK(map.certificate.holds);
      if (frame > 40 && std::abs(map.solution.total - before) <= 1e-12 * before) break;
      before = map.solution.total;
    }
    const IsometricMap final_map = prepared.space.solved(target, kSettings, map.turns);
    CHECK(final_map.certificate.holds);
    CHECK(std::abs(final_map.solution.total - map.solution.total) <=
          1e-6 * final_map.solution.total);
    CHECK((final_map.solution.offsets - map.solution.offsets).cwiseAbs().maxCoeff() <= 1e-4);
  }
}

TEST_CASE("Puppet: a pin with rotation turns a small disk, by 45 degrees to within 2") {
  const Method& method = method_named("puppet");
  Rest rest;
  rest.cage = polygon_cage(Points{{0, 0}, {600, 0}, {600, 200}, {0, 200}});
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {1500}));
  rest.precision = Precision::full;
  const Complex center(300, 100);
  rest.pins = {{center, true}, {{40, 100}}, {{560, 100}}};
  const double radius = 0.03 * std::hypot(600, 200);
  for (int k = 0; k < 6; ++k) rest.samples.push_back(center + std::polar(radius, 2 * kPi * k / 6));
  const Pose pose{rest.cage, {{center, kPi / 4}, {{40, 100}}, {{560, 100}}}};
  const SampledMap map = method.prepare(rest, nullptr)->deform(pose, {.derivatives = true});
  CHECK(map.status == SampledMap::Status::certified);
  for (Index i = 0; i < map.fz.size(); ++i) {
    CHECK(std::abs(std::arg(map.fz[i]) - kPi / 4) <= 2 * kPi / 180);
    CHECK(std::abs(map.fz[i]) + std::abs(map.fzbar[i]) <= 1.05);
    CHECK(std::abs(map.fz[i]) - std::abs(map.fzbar[i]) >= 0.95);
  }
}

TEST_CASE("Isometric maps: impossible poses are certified, too") {
  for (const unsigned seed : seeds_of("impossible poses", {1, 2, 3})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Problem problem{kBar, {{.5, 0}, {2, .3}, {4, -.3}, {5.5, 0}}, {}};
    for (size_t i = 0; i < problem.pins.size(); ++i) {
      const double reach = seed % 3 == 0 ? 1e-3 : seed % 3 == 1 ? 3 : 60;
      problem.targets.push_back(reach * Complex(uniform(random), uniform(random)));
    }
    const Prepared prepared(problem);
    const IsometricMap map = prepared.space.solved(prepared.target, kSettings);
    INFO("energy " << map.solution.energy << " in " << map.solution.iterations);
    CHECK(map.certificate.holds);
    CHECK(map.solution.x.allFinite());
  }
}

TEST_CASE("Isometric program: its minimum equals Ipopt's from the same start") {
  for (const Problem& problem :
       {Problem{kBar, {{.5, 0}, {3, 0}, {5.5, 0}}, {{.5, 0}, {3, 0}, {5, 1}}, 25},
        Problem{kBar, {{.5, 0}, {5.5, 0}}, {{.5, 0}, {7, 0}}, 25},
        Problem{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},
                {{.5, .5}, {.5, 2.5}, {2.5, .5}},
                {{.5, .5}, {.5, 2.5}, {2, 1.7}},
                25}}) {
    const Prepared prepared(problem);
    const IsometricSystem& system = prepared.space.system();
    IsometricSettings settings;
    settings.penalty = 5;
    const VectorXd start = VectorXd::Zero(system.unknowns());
    const IsometricSolution own = minimized(system, prepared.target, settings, start);
    const auto value = [&](const VectorXd& x) {
      return isometric_value(system, prepared.target, settings, x);
    };
    const auto gradient = [&](const VectorXd& x) -> VectorXd {
      return isometric_derivatives(system, prepared.target, settings, x).gradient;
    };
    const double other = value(minimum_by_ipopt(value, gradient, start));
    INFO("own " << own.total << ", Ipopt " << other);
    CHECK(own.converged);
    CHECK(std::abs(own.total - other) <= 1e-7 * other);
  }
}

}  // namespace holomorph::isometric_test
