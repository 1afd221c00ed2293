// The spaces L_psi and H: pins reach their targets, sizes are kept, and the bounds are proved.

#include "core/bounded/psi_space.h"
#include "bench/known_maps.h"
#include "core/bounded/map_on_mesh.h"
#include "core/error.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace holomorph::psi_space_test {
using known_maps::KnownMap;
using known_maps::Projection;

namespace {

/// Both projection steps for a reference, without pins.
BoundedMap two_steps(const PsiSpace& space, const BoundedReference& reference) {
  return space.nearest(space.conformal(reference), reference, {});
}

/// Half the mean square differences of |f_z| and Psi' from those of a reference, on the boundary
/// alone.
double distance_in_h(const Projection& projection, const BoundedReference& reference,
                     const LogMap& map) {
  const MatrixXc c = projection.basis->values(projection.points.boundary);
  const auto [phi, psi] = derivatives_of(map, c * map.l, c * map.w);
  const VectorXd sizes = reference.log_fz.real().array().exp();
  return 0.5 * ((phi.cwiseAbs() - sizes).squaredNorm() + (psi - reference.psi).squaredNorm()) /
         static_cast<double>(c.rows());
}

}  // namespace

TEST_CASE(
    "L_psi and H: certified bounds hold at samples ten times as dense, on boundary and inside") {
  for (const Bounds& bounds : {Bounds{0.7, 0.2, 5}, Bounds{0.5, 0.5, 1.5}, Bounds{0, 0.3, 3}})
    for (const KnownMap& known : known_maps::all()) {
      const Projection projection(known, bounds, known_maps::Norm::l1);
      const PsiSpace space(projection.basis, projection.points, {bounds});
      const Points points = known_maps::dense_points(*projection.basis, projection.mesh);
      INFO(known.name << ", k = " << bounds.k);
      const BoundedMap psi = two_steps(space, projection.reference);
      CHECK(psi.certificate.holds);
      CHECK(known_maps::violation(*projection.basis, psi.map, points, bounds) <= 0);
      const BoundedMap h = two_steps(space, space.convexified(projection.reference));
      CHECK(h.certificate.holds);
      CHECK(known_maps::violation(*projection.basis, h.map, points, bounds) <= 0);
    }
}

TEST_CASE("L_psi and H: a map within the bounds is its own projection") {
  const Complex slope = std::polar(1.3, 0.7);
  const KnownMap known{"affine", shapes::l_shape(), [=](Complex) { return slope; },
                       [=](Complex) { return 0.3 * std::conj(slope); }};
  const Projection projection(known, {}, known_maps::Norm::l1);
  const PsiSpace space(projection.basis, projection.points, {});
  for (const bool convex : {false, true}) {
    const BoundedMap map =
        two_steps(space, convex ? space.convexified(projection.reference) : projection.reference);
    const MatrixXc c = projection.basis->values(projection.mesh.vertices);
    const auto [phi, psi] = derivatives_of(map.map, c * map.map.l, c * map.map.w);
    // The derivatives are as accurate as the solutions of the cone programs.
    CHECK((phi.array() - slope).abs().maxCoeff() <= 5e-3);
    CHECK((psi.array() - 0.3 * slope).abs().maxCoeff() <= 5e-3);
  }
}

TEST_CASE("H: its convex distance is at most that of every map within the bounds") {
  bool nearer = false;
  for (const KnownMap& known : known_maps::all()) {
    const Bounds bounds{0.5, 0.5, 1.5};
    const Projection projection(known, bounds, known_maps::Norm::l1, false);
    const PsiSpace space(projection.basis, projection.points, {bounds});
    const BoundedReference& g = projection.reference;
    const BoundedReference h = space.convexified(g);
    const double lowest =
        0.5 *
        ((h.log_fz.real().array().exp() - g.log_fz.real().array().exp()).square().sum() +
         (h.psi - g.psi).squaredNorm()) /
        static_cast<double>(g.psi.size());
    INFO(known.name);
    constexpr double kGap = 1e-3;
    for (const LogMap& map :
         {projection.space->nearest(g).map, two_steps(space, g).map, two_steps(space, h).map})
      CHECK(distance_in_h(projection, g, map) >= lowest - kGap);
    const double of_h = distance_in_h(projection, g, two_steps(space, h).map),
                 of_psi = distance_in_h(projection, g, two_steps(space, g).map);
    CHECK(of_h <= of_psi + kGap);
    nearer = nearer || of_h < of_psi - 10 * kGap;
    CHECK(lowest > 1e-4);  // all six references violate these bounds
    for (Index i = 0; i < h.psi.size(); ++i) {
      const double r = std::exp(h.log_fz[i].real()), size = std::abs(h.psi[i]);
      REQUIRE(size <= bounds.k * r);
      REQUIRE(r + size <= bounds.Sigma);
      REQUIRE(r - size >= bounds.sigma);
    }
  }
  CHECK(nearer);
}

TEST_CASE(
    "L_psi: pins reach their targets where the bounds allow it, and more closely with more "
    "weight") {
  // f = z + conj(0.3 z + 0.1 z^2) takes the pins to their targets. The reference is z.
  const KnownMap identity{"z", shapes::l_shape(), [](Complex) { return Complex(1); },
                          [](Complex) { return Complex(0); }};
  const double size = box_of(identity.domain).diagonal();
  const Projection projection(identity, {}, known_maps::Norm::l1);
  const auto psi = [&](Complex z) { return 0.3 * z + 0.1 * z * z / size; };
  const MapOnMesh on_mesh(*projection.basis, projection.mesh);
  const MatrixXc coefficients = projection.basis->coefficients(),
                 c = projection.basis->values(projection.mesh.vertices);
  std::vector<Location> locations;
  VectorXc wanted(4);
  for (Index i = 0; i < 4; ++i) {
    const Triangle& t = projection.mesh.triangles[static_cast<size_t>(37 * i + 5)];
    locations.push_back({static_cast<int>(37 * i + 5), {1, 0, 0}});
    wanted[i] = psi(projection.mesh.vertices[static_cast<size_t>(t[0])]);
  }
  const MatrixXc rows = on_mesh.psi_rows(locations, coefficients);
  double before = size;
  for (const double weight : {1.0, 1e3, 1e6}) {
    const PsiSpace space(projection.basis, projection.points, {}, PinRows{rows, weight, size});
    const BoundedMap map =
        space.nearest(space.conformal(projection.reference), projection.reference, wanted);
    REQUIRE(map.certificate.holds);
    const LogMap& found = map.map;
    const VectorXc phi = on_mesh.phi(found.l), f = on_mesh.values(found).f;
    VectorXc miss(4);
    for (Index i = 0; i < 4; ++i) {
      const int v = projection.mesh.triangles[static_cast<size_t>(37 * i + 5)][0];
      miss[i] = std::conj(f[v] - phi[v]) - wanted[i];
    }
    const double worst = (miss.array() - miss.mean()).abs().maxCoeff();
    CHECK(worst < before);
    before = worst;
  }
  CHECK(before <= 1e-4 * size);
}

}  // namespace holomorph::psi_space_test
