// Locally injective harmonic maps: the maps nearest to known maps, and the proofs of their bounds.

#include "bench/known_maps.h"
#include "core/bounded/bounded_space.h"
#include "core/error.h"
#include "core/maps/argument.h"
#include "core/mesh/antiderivative.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace holomorph::bounded_test {
using Norm = BoundedSettings::Norm;

using known_maps::KnownMap;
using known_maps::Projection;

TEST_CASE("Bounded: the energies of the specification's maps") {
  // The specification uses different samples on the boundary to measure nu, so the energies agree
  // only to one percent.
  struct Row {
    KnownMap known;
    double l2, l2_digit, l1, l1_digit;  ///< energies, each with half a unit of its last digit
  };
  constexpr double kSampling = 0.01;
  for (const Row& row : {Row{known_maps::squared(), 0.836, 5e-4, 1.28, 5e-3},
                         Row{known_maps::quadratic(), 0.0043, 5e-5, 0.0049, 5e-5},
                         Row{known_maps::spiral(), 0.0374, 5e-5, 0.219, 5e-4}})
    for (const Norm norm : {Norm::l2, Norm::l1}) {
      const Projection projection(row.known, {}, norm, false);
      const BoundedMap map = projection.space->nearest(projection.reference);
      const double wanted = norm == Norm::l1 ? row.l1 : row.l2;
      INFO(row.known.name << (norm == Norm::l1 ? ", L1" : ", L2"));
      CHECK(map.certificate.holds);
      const double digit = norm == Norm::l1 ? row.l1_digit : row.l2_digit;
      CHECK(std::abs(projection.energy(map) - wanted) <= kSampling * wanted + digit);
    }
}

TEST_CASE("Bounded: certified bounds hold at samples ten times as dense, on boundary and inside") {
  for (const Bounds& bounds : {Bounds{0.7, 0.2, 5}, Bounds{0.5, 0.5, 1.5}, Bounds{0, 0.3, 3}})
    for (const KnownMap& known : known_maps::all()) {
      const Projection projection(known, bounds, Norm::l1);
      BoundedMap map = projection.space->nearest(projection.reference);
      INFO(known.name << ", k = " << bounds.k);
      REQUIRE(map.certificate.holds);
      const Points points = known_maps::dense_points(*projection.basis, projection.mesh);
      CHECK(known_maps::violation(*projection.basis, map.map, points, bounds) <= 0);
      CHECK(map.blend <= 1e-3);
      // Continue from this solution, as in a drag.
      map = projection.space->nearest(projection.reference, &map);
      CHECK(map.certificate.holds);
      CHECK(known_maps::violation(*projection.basis, map.map, points, bounds) <= 0);
    }
}

TEST_CASE("Bounded: a map within the bounds is its own projection") {
  const Complex slope = std::polar(1.3, 0.7);
  for (const double shear : {0.0, 0.3}) {
    const KnownMap known{"affine", shapes::l_shape(), [=](Complex) { return slope; },
                         [=](Complex) { return shear * std::conj(slope); }};
    for (const Norm norm : {Norm::l1, Norm::l2}) {
      const Projection projection(known, {}, norm);
      const BoundedMap map = projection.space->nearest(projection.reference);
      const MatrixXc c = projection.basis->values(projection.mesh.vertices);
      CHECK((c * map.map.l - VectorXc::Constant(c.rows(), std::log(slope))).cwiseAbs().maxCoeff() <=
            1e-9);
      CHECK(map.certificate.holds);
      CHECK(projection.energy(map) <= 1e-9);
    }
  }
}

TEST_CASE("Bounded: a certificate is refused where a bound is violated between the samples") {
  const auto basis =
      std::make_shared<const BoundaryBasis>(polygon_cage(known_maps::bar()), 50, 100);
  const Certifier certifier(*basis);
  LogMap map{VectorXc::Zero(basis->size()), VectorXc::Zero(basis->size())};
  CHECK(certifier.certify(map, {}).holds);
  CHECK_FALSE(certifier.certify(map, {0.7, 1.1, 5}).holds);
  // Two coefficients are raised, so nu peaks next to a polygon vertex, between two samples.
  map.w[7] = 0.9;
  map.w[8] = 0.75;
  const Points samples = basis->samples();
  const VectorXc nu = basis->values(samples) * map.w;
  const double seen = nu.cwiseAbs().maxCoeff();
  Points dense;
  for (const BoundaryPiece& piece : basis->pieces())
    for (int k = 0; k < 200; ++k)
      dense.push_back(piece.start + k / 200.0 * (piece.end - piece.start));
  const double peak = (basis->values(dense) * map.w).cwiseAbs().maxCoeff();
  REQUIRE(peak > seen);
  const Certificate between = certifier.certify(map, {0.5 * (seen + peak), 0.01, 20});
  CHECK_FALSE(between.holds);
  CHECK(between.failed == Bound::k);
  CHECK(std::abs(between.where - basis->polygon().points[7]) < 0.2);
  CHECK(certifier.certify(map, {peak + 0.01, 0.01, 20}).holds);
}

TEST_CASE(
    "Bounded: a certificate of Psi' is refused where a bound is violated between the samples") {
  const auto basis =
      std::make_shared<const BoundaryBasis>(polygon_cage(known_maps::bar()), 50, 100);
  const Certifier certifier(*basis);
  LogMap map{VectorXc::Zero(basis->size()), VectorXc::Zero(basis->size()), LogMap::Second::psi};
  map.w[7] = 0.9;
  map.w[8] = 0.75;
  const double seen = (certifier.coordinates() * map.w).cwiseAbs().maxCoeff();
  Points dense;
  for (const BoundaryPiece& piece : basis->pieces())
    for (int k = 0; k < 200; ++k)
      dense.push_back(piece.start + k / 200.0 * (piece.end - piece.start));
  const double peak = (basis->values(dense) * map.w).cwiseAbs().maxCoeff();
  REQUIRE(peak > seen);
  const double between = 0.5 * (seen + peak);
  // |f_z| is 1, so each bound can be tested separately.
  CHECK(certifier.certify(map, {between, 0.01, 20}).failed == Bound::k);
  CHECK_FALSE(certifier.certify(map, {between, 0.01, 20}).holds);
  CHECK_FALSE(certifier.certify(map, {0.99, 1 - between, 20}).holds);
  CHECK_FALSE(certifier.certify(map, {0.99, 0.01, 1 + between}).holds);
  CHECK(certifier.certify(map, {peak + 0.01, 0.99 - peak, 1.01 + peak}).holds);
  // The same holds with the map scaled and rotated.
  for (const Complex factor : {Complex(2), std::polar(0.5, 1.1)}) {
    const double s = std::abs(factor);
    const LogMap turned = scaled(map, factor);
    CHECK_FALSE(certifier.certify(turned, {between, 0.01 * s, 20 * s}).holds);
    CHECK(certifier.certify(turned, {peak + 0.01, (0.99 - peak) * s, (1.01 + peak) * s}).holds);
  }
}

TEST_CASE("Bounded: a certificate of Psi' accounts for |f_z| lying below its chord") {
  // l grows so steeply along the square that e^l is far below its chord between two samples. At
  // both samples, Psi' is nearly as large as allowed.
  const auto basis = std::make_shared<const BoundaryBasis>(
      polygon_cage(Points{{0, 0}, {1, 0}, {1, 1}, {0, 1}}), 25, 50);
  const Certifier certifier(*basis);
  LogMap map{VectorXc(basis->size()), VectorXc(basis->size()), LogMap::Second::psi};
  constexpr double kSteep = 30;
  for (Index j = 0; j < basis->size(); ++j) {
    const Complex z = basis->polygon().points[static_cast<size_t>(j)];
    map.l[j] = kSteep * (z - 0.5);
    map.w[j] = 0;
  }
  const double low = std::exp(-0.5 * kSteep), high = std::exp(0.5 * kSteep);
  CHECK(certifier.certify(map, {0.5, 0.9 * low, 1.1 * high}).holds);
  // Over a piece, the chord of e^l exceeds e^l by at most this factor. A constant Psi' lies between
  // the two.
  const double piece = std::abs(basis->pieces()[0].end - basis->pieces()[0].start);
  const double sag = std::exp(0.5 * kSteep * piece) / 2 + std::exp(-0.5 * kSteep * piece) / 2;
  REQUIRE(sag > 1.02);
  map.w.setConstant(0.5 * low);
  CHECK(certifier.certify(map, {0.51, 0.4 * low, 1.1 * high}).holds);
  CHECK_FALSE(certifier.certify(map, {0.49, 0.4 * low, 1.1 * high}).holds);
}

TEST_CASE("Bounded: a warm start from another frame's map gets as close as a cold start") {
  constexpr double kShare = 3e-2, kGap = 3e-3;  // the settings of drafts
  for (const known_maps::KnownMap& known : known_maps::all()) {
    Projection from(known, {}, known_maps::Norm::l1), to(known, {}, known_maps::Norm::l1);
    to.reference.log_fz.array() += Complex(0.3, 0.8);
    to.reference.nu *= 0.8;
    to.reference.inner_nu *= 0.8;
    const BoundedMap before = from.space->nearest(from.reference),
                     warm = from.space->nearest(to.reference, &before),
                     cold = from.space->nearest(to.reference);
    INFO(known.name);
    const double best = from.space->energy(to.reference, cold.solution);
    const double stayed = from.space->energy(to.reference, before.solution);
    CHECK(from.space->energy(to.reference, warm.solution) <= (1 + kShare) * best + kGap);
    CHECK(stayed > (1 + kShare) * best + 10 * kGap);
  }
}

TEST_CASE("Bounded: drafts that stop early are proved, and later ones are solved") {
  for (const known_maps::KnownMap& known : known_maps::all()) {
    Projection from(known, {}, known_maps::Norm::l1), to(known, {}, known_maps::Norm::l1);
    to.reference.log_fz.array() += Complex(-0.5, 3);
    to.reference.nu *= -1;
    to.reference.inner_nu *= -1;
    BoundedMap map = from.space->nearest(from.reference);
    constexpr int kMostDrafts = 8;
    int drafts = 0;
    do {
      map = from.space->nearest(to.reference, &map);
      INFO(known.name << ", draft " << drafts);
      CHECK(map.certificate.holds);
    } while (map.solution.status != ConeSolution::Status::solved && ++drafts < kMostDrafts);
    CHECK(drafts < kMostDrafts);
  }
}

TEST_CASE("Bounded: impossible bounds are refused") {
  const auto basis =
      std::make_shared<const BoundaryBasis>(polygon_cage(known_maps::bar()), 25, 100);
  for (const Bounds& bounds : {Bounds{1, 0.2, 5}, Bounds{-0.1, 0.2, 5}, Bounds{0.5, 0, 5},
                               Bounds{0.5, 2, 1}, Bounds{0.5, NAN, 5}, Bounds{NAN, 0.2, 5}})
    CHECK_THROWS_AS(BoundedSpace(basis, {basis->samples(), {}}, {bounds}), Error);
}

TEST_CASE(
    "Boundary basis: it reproduces holomorphic functions, and its polygon surrounds the domain") {
  for (const Cage& cage : {polygon_cage(shapes::l_shape()), shapes::curved_star(9, 3, 0.25, 3),
                           reversed(polygon_cage(shapes::comb(4)))}) {
    const BoundaryBasis basis(cage, 60, 360);
    CHECK(signed_area(basis.polygon()) > 0);
    for (const Complex& z : flattened(cage).points) CHECK(winding_number(basis.polygon(), z) == 1);
    const double size = box_of(basis.samples()).diagonal();
    const Complex center = box_of(basis.samples()).center();
    const auto wave = [&](Complex z) { return std::exp((z - center) / size); };
    const VectorXc f = known_maps::values(wave, basis.samples());
    const double m = static_cast<double>(f.size());
    const VectorXc unknowns = basis.at_samples().adjoint() * f / m;
    CHECK((basis.at_samples() * unknowns - f).cwiseAbs().maxCoeff() <= 1e-2);
    CHECK(std::abs(unknowns.squaredNorm() - f.squaredNorm() / m) <= 1e-3);  // whitened
    CHECK((basis.values(basis.samples()) * basis.coefficients(unknowns) -
           basis.at_samples() * unknowns)
              .cwiseAbs()
              .maxCoeff() <= 1e-10);
    CHECK((basis.at_samples() * basis.one() - VectorXc::Ones(f.size())).cwiseAbs().maxCoeff() <=
          1e-10);
  }
}

TEST_CASE(
    "Boundary basis: with few unknowns it still contains 1 and z, and fits smooth functions") {
  for (const Cage& cage : {polygon_cage(shapes::comb(4)), shapes::curved_star(9, 3, 0.25, 3)}) {
    constexpr int kMost = 40;
    const BoundaryBasis fine(cage, 120, 360), coarse(cage, 120, 360, kMost);
    CHECK(coarse.size() == fine.size());
    CHECK(coarse.unknowns() <= 1.5 * kMost);  // bends keep their vertices
    CHECK(fine.unknowns() > 1.5 * kMost);
    const double size = box_of(coarse.samples()).diagonal(),
                 m = static_cast<double>(coarse.samples().size());
    const Complex center = box_of(coarse.samples()).center();
    const auto misfit = [&](auto function) {
      const VectorXc f = known_maps::values(function, coarse.samples());
      const VectorXc unknowns = coarse.at_samples().adjoint() * f / m;
      return (coarse.at_samples() * unknowns - f).cwiseAbs().maxCoeff();
    };
    CHECK(misfit([](Complex) { return Complex(1); }) <= 1e-10);
    CHECK(misfit([&](Complex z) { return (z - center) / size; }) <= 1e-10);
    CHECK(misfit([&](Complex z) { return std::exp((z - center) / size); }) <= 1e-2);
  }
}

TEST_CASE("Boundary argument: it is continuous and closes up, with and without listed zeros") {
  const Mesh mesh = domain_mesh(known_maps::circle(40), {600});
  const Points samples = known_maps::circle(200);
  const auto two = [](Complex z) { return (z - 0.3) * (z - 0.3) * (z + Complex(0.2, 0.5)); };
  const std::vector<Zero> zeros = zeros_of(mesh, known_maps::values(two, mesh.vertices));
  int multiplicity = 0;
  for (const Zero& zero : zeros) {
    multiplicity += zero.multiplicity;
    CHECK(std::abs(two(zero.position)) < 0.02);
  }
  CHECK(multiplicity == 3);
  const VectorXc f = known_maps::values(two, samples);
  for (const std::vector<Zero>& known : {zeros, std::vector<Zero>{}}) {
    const VectorXd theta = boundary_argument(samples, f, known);
    int jumps = 0;
    for (Index i = 0; i < theta.size(); ++i) {
      CHECK(std::abs(std::polar(std::abs(f[i]), theta[i]) - f[i]) < 1e-12);
      const double step = theta[(i + 1) % theta.size()] - theta[i];
      jumps += std::abs(step) > kPi;
      CHECK(std::abs(step) < 5 * kPi);
    }
    CHECK(jumps >= 1);
    CHECK(jumps <= 3);
  }
  CHECK_THROWS_AS(boundary_argument(samples, VectorXc::Zero(200), {}), Error);
}

TEST_CASE("Boundary argument: beyond a zero, the argument takes the smaller of two turns") {
  // From the bar's left to its right, the argument grows by 100 degrees below the zero and falls by
  // 260 degrees above it. The zero is nearer to the lower side.
  const double bend = 80 * kPi / 180;
  const auto g = [&](Complex z) { return (z - Complex(3, -0.2)) * std::exp(-kI * bend * z / 6.0); };
  const BoundaryBasis basis(polygon_cage(known_maps::bar()), 50, 300);
  const Points& samples = basis.samples();
  const VectorXd theta =
      boundary_argument(samples, known_maps::values(g, samples), {{Complex(3, -0.2), 1}});
  double left = 0, right = 0, lefts = 0, rights = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].real() < 0.5) left += theta[static_cast<Index>(i)], ++lefts;
    if (samples[i].real() > 5.5) right += theta[static_cast<Index>(i)], ++rights;
  }
  CHECK(right / rights - left / lefts == Approx(100 * kPi / 180).margin(0.2));
}

TEST_CASE("Mesh tree: it integrates along a mesh to the order of its rule") {
  const auto f = [](Complex z) { return std::sin(2.0 * z) + z * z; };
  const auto f1 = [](Complex z) { return 2.0 * std::cos(2.0 * z) + 2.0 * z; };
  const auto f2 = [](Complex z) { return -4.0 * std::sin(2.0 * z) + 2.0; };
  double last = 0;
  for (const int vertices : {500, 8000}) {
    const Mesh mesh = domain_mesh(known_maps::circle(60), {vertices});
    const MeshTree tree(mesh);
    const VectorXc F = tree.antiderivative(known_maps::values(f1, mesh.vertices),
                                           known_maps::values(f2, mesh.vertices));
    const Complex at_root = f(mesh.vertices[static_cast<size_t>(tree.root())]);
    const double error =
        (F - known_maps::values([&](Complex z) { return f(z) - at_root; }, mesh.vertices))
            .cwiseAbs()
            .maxCoeff();
    CHECK(error < 1e-4);
    if (last > 0) CHECK(error < last / 30);  // fourth order, with edges a quarter as long
    last = error;
  }
}

}  // namespace holomorph::bounded_test
