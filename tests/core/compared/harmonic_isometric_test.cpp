// The reimplementation of Chen, Weber 2017: its minima are minima, do not fold, and compare with
// the puppet's as published.
#include "core/compared/harmonic_isometric.h"

#include <random>

#include "core/isometric/isometric_space.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"

namespace holomorph::harmonic_isometric_test {

namespace {

const Points kBar{{0, -.5}, {6, -.5}, {6, .5}, {0, .5}};

struct Stage {
  Mesh mesh;
  std::shared_ptr<const BoundaryBasis> basis;
  IsometricSpace space;
  HarmonicIsometricProblem problem;

  Stage(const Points& domain, const Points& pins, const Points& targets, double weight)
      : mesh(domain_mesh(domain, {800})),
        basis(std::make_shared<const BoundaryBasis>(polygon_cage(domain), 50, 300)),
        space(basis, mesh,
              IsometricHandles{pins,
                               static_cast<Index>(pins.size()),
                               VectorXd::Ones(static_cast<Index>(pins.size())),
                               {},
                               {}},
              {}, {}, {}),
        problem{space.system().weights, pins, targets,
                weight / std::pow(box_of(basis->samples()).diagonal(), 2)} {}

  IsometricMap own(double weight) const {
    IsometricTarget target;
    target.stations.resize(static_cast<Index>(problem.pins.size()));
    for (size_t i = 0; i < problem.pins.size(); ++i)
      target.stations[static_cast<Index>(i)] = problem.targets[i] - problem.pins[i];
    return space.solved(target, {.pin_weight = weight});
  }

  /// The value that is minimized, from its definition.
  double value(const VectorXc& phi, const VectorXc& psi) const {
    const MatrixXc slopes = basis->values(basis->samples(), 1), at = basis->values(problem.pins);
    const VectorXc fz = slopes * phi, fzbar = slopes * psi, f = at * phi + (at * psi).conjugate();
    double sum = 0;
    for (Index i = 0; i < fz.size(); ++i) {
      const double most = std::abs(fz[i]) + std::abs(fzbar[i]),
                   least = std::abs(fz[i]) - std::abs(fzbar[i]);
      sum += problem.weights[i] * 0.5 *
             (most * most + least * least + 1 / (most * most) + 1 / (least * least));
    }
    for (Index i = 0; i < f.size(); ++i)
      sum += problem.penalty * std::norm(f[i] - problem.targets[static_cast<size_t>(i)]);
    return sum;
  }
};

}  // namespace

TEST_CASE("Chen, Weber 2017: pins at rest or moved rigidly give a rigid motion") {
  const Points pins{{.5, 0}, {3, .2}, {5.5, 0}};
  for (const Complex turn : {Complex(1), std::polar(1.0, 2.0)}) {
    Points targets;
    for (const Complex& z : pins) targets.push_back(turn * z + Complex(3, -1));
    const Stage stage(kBar, pins, targets, 1e4);
    const HarmonicIsometricMap map = harmonic_isometric(*stage.basis, stage.problem);
    CHECK(map.converged);
    CHECK(map.energy == Approx(2).epsilon(1e-9));
    CHECK(map.total == Approx(2).epsilon(1e-9));
  }
}

TEST_CASE("Chen, Weber 2017: the result is a minimum without folds, near the puppet's energy") {
  for (const unsigned seed : seeds_of("Chen, Weber 2017", {1, 2, 3})) {
    std::mt19937 random(seed);
    const Points pins{{.5, 0}, {2, .2}, {4, -.2}, {5.5, 0}};
    Points targets = pins;
    for (Complex& z : targets) z += 0.5 * random_complex(random);
    constexpr double kWeight = 1e4;
    const Stage stage(kBar, pins, targets, kWeight);
    const HarmonicIsometricMap map = harmonic_isometric(*stage.basis, stage.problem);
    CHECK(map.converged);
    CHECK(stage.value(map.phi, map.psi) == Approx(map.total).epsilon(1e-9));
    for (int k = 0; k < 20; ++k) {
      const auto nearby = [&](VectorXc coefficients) {
        for (Complex& z : coefficients) z += 1e-5 * random_complex(random);
        return coefficients;
      };
      CHECK(stage.value(nearby(map.phi), nearby(map.psi)) >= map.total - 1e-9);
    }
    const MatrixXc slopes = stage.basis->values(stage.mesh.vertices, 1);
    const VectorXc fz = slopes * map.phi, fzbar = slopes * map.psi;
    CHECK((fz.cwiseAbs() - fzbar.cwiseAbs()).minCoeff() > 0);
    // The paper's maps and ours are different spaces of the same dimension.
    const IsometricMap own = stage.own(kWeight);
    INFO("own " << own.solution.total << ", theirs " << map.total);
    CHECK(own.solution.total <= 1.02 * map.total);
    CHECK(own.certificate.holds);
  }
}

}  // namespace holomorph::harmonic_isometric_test
