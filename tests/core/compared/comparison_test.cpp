// The comparison with other projections: each satisfies what its paper states.
#include <random>

#include "core/compared/comparison.h"
#include "core/compared/projections.h"
#include "core/error.h"
#include "core/mesh/mesher.h"
#include "core/solvers/real_form.h"
#include "support/catch.h"

namespace holomorph::comparison_test {

namespace {

const Cage& bar_cage() {
  static const Cage cage = polygon_cage(Points{{0, 0}, {600, 0}, {600, 100}, {0, 100}});
  return cage;
}

/// A bar with one end pushed back over the other, so that the pins' map folds.
struct Folded {
  Rest rest;
  Pose pose;

  explicit Folded(int vertices) {
    rest.cage = bar_cage();
    rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {vertices}));
    rest.samples = rest.mesh->vertices;
    rest.pins = {{{30, 50}}, {{300, 50}}, {{570, 50}}};
    pose.cage = rest.cage;
    pose.pins = {{{30, 50}}, {{300, 50}}, {{180, 60}}};
  }
};

Element random_element(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> number(-size, size);
  Element e;
  for (double& x : e) x = number(random);
  return e;
}

/// How far an element is outside the bounds.
double outside(const Element& e, const Bounds& bounds) {
  const double a = e.head<2>().norm(), b = e.tail<2>().norm();
  return std::max({b - bounds.k * a, a + b - bounds.Sigma, bounds.sigma - (a - b)});
}

double worst_outside(const VectorXd& elements, const Bounds& bounds) {
  double worst = -1;
  for (Index i = 0; 4 * i < elements.size(); ++i)
    worst = std::max(worst, outside(elements.segment<4>(4 * i), bounds));
  return elements.allFinite() ? worst : 1e300;
}

}  // namespace

TEST_CASE("Projections: the nearest bounded element is within the bounds, and no other is nearer") {
  std::mt19937 random(3);
  for (const Bounds& bounds :
       {Bounds{0.7, 0.2, 5}, Bounds{0.5, 0.5, 1.5}, Bounds{0, 0.5, 2}, Bounds{0.9, 0.8, 1.2}})
    for (int trial = 0; trial < 50; ++trial) {
      const Element e = random_element(random, 6), p = nearest_bounded(e, bounds);
      CHECK(outside(p, bounds) <= 1e-12);
      if (outside(e, bounds) <= 0) CHECK(p == e);
      for (int other = 0; other < 200; ++other) {
        const Element q = random_element(random, 3);
        if (outside(q, bounds) <= 0) REQUIRE((q - e).norm() >= (p - e).norm() - 1e-12);
      }
    }
}

TEST_CASE("Projections: derivatives, adjoints and solutions of both operators are consistent") {
  const Mesh mesh = domain_mesh(bar_cage(), {200});
  const BoundaryBasis basis(bar_cage(), 30, 120);
  const MapOnMesh on_mesh(basis, mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&](Index size) {
    VectorXd v(size);
    for (double& x : v) x = number(random);
    return v;
  };
  std::vector<std::unique_ptr<DerivativeOperator>> operators;
  operators.push_back(mesh_operator(mesh));
  operators.push_back(harmonic_operator(basis, on_mesh, basis.samples()));
  for (const auto& t : operators) {
    CHECK(std::abs(t->weights().sum() - 1) <= 1e-12);
    const VectorXd similar = t->apply(t->similarity(1.7));
    for (Index i = 0; i < t->elements(); ++i)
      REQUIRE((similar.segment<4>(4 * i) - Element(1.7, 0, 0, 0)).norm() <= 1e-9);
    const VectorXc f = t->map(t->similarity(1.7));
    for (size_t v = 1; v < mesh.vertices.size(); ++v)
      REQUIRE(std::abs(f[static_cast<Index>(v)] - f[0] -
                       1.7 * (mesh.vertices[v] - mesh.vertices[0])) <= 1e-6);
    const VectorXd x = vector(t->unknowns()), y = vector(4 * t->elements());
    CHECK(t->apply(x).dot(y) == Approx(x.dot(t->adjoint(y))).epsilon(1e-9));
    std::vector<Eigen::Matrix4d> blocks;
    for (Index i = 0; i < t->elements(); ++i) {
      const Element a = random_element(random, 1);
      blocks.push_back(Eigen::Matrix4d::Identity() + a * a.transpose());
    }
    t->factor(blocks);
    const VectorXd solution = t->solve(t->adjoint(y));
    VectorXd back = t->apply(solution);
    for (Index i = 0; i < t->elements(); ++i)
      back.segment<4>(4 * i) = (blocks[static_cast<size_t>(i)] * back.segment<4>(4 * i)).eval();
    const VectorXd wanted = t->adjoint(y);
    CHECK((t->adjoint(back) - wanted).norm() <= 1e-4 * wanted.norm());
  }
  // Derivatives of affine maps are exact.
  const Complex fz(0.8, 0.5), fzbar(-0.2, 0.3);
  VectorXc f(static_cast<Index>(mesh.vertices.size()));
  for (Index v = 0; v < f.size(); ++v) {
    const Complex z = mesh.vertices[static_cast<size_t>(v)];
    f[v] = fz * z + fzbar * std::conj(z);
  }
  const VectorXd elements = operators[0]->apply(stacked(f));
  for (Index i = 0; i < operators[0]->elements(); ++i)
    REQUIRE((elements.segment<4>(4 * i) - Element(0.8, 0.5, -0.2, 0.3)).norm() <= 1e-9);
}

TEST_CASE(
    "Projections: maps within the bounds stay unchanged, and others are brought within them") {
  const Mesh mesh = domain_mesh(bar_cage(), {150});
  const auto t = mesh_operator(mesh);
  const Bounds bounds{0.5, 0.5, 2};
  const auto values = [&](const std::function<Complex(Complex)>& map) {
    VectorXc f(static_cast<Index>(mesh.vertices.size()));
    for (Index v = 0; v < f.size(); ++v) f[v] = map(mesh.vertices[static_cast<size_t>(v)]);
    return stacked(f);
  };
  const auto distance = [&](const VectorXd& x, const VectorXd& g) {
    const VectorXd off = t->apply(x) - g;
    double sum = 0;
    for (Index i = 0; i < t->elements(); ++i)
      sum += t->weights()[i] * off.segment<4>(4 * i).squaredNorm();
    return sum;
  };
  const VectorXd gentle =
      values([](Complex z) { return std::polar(1.1, 0.4) * z + 0.2 * std::conj(z); });
  const VectorXd g = t->apply(gentle);
  CHECK(by_half_spaces(*t, gentle, {bounds}).x == gentle);
  CHECK(by_tangent_planes(*t, gentle, {bounds}).x == gentle);
  const Projected framed = by_local_frames(*t, g, {bounds});
  CHECK(distance(framed.x, g) <= 1e-3);
  // A map that stretches some parts to four times their size and flattens others completely.
  const VectorXd wild = values([](Complex z) { return z + z * z / 400.0 - 0.5 * std::conj(z); });
  const VectorXd wild_g = t->apply(wild);
  REQUIRE(worst_outside(wild_g, bounds) > 1);
  for (const Projected& map :
       {by_local_frames(*t, wild_g, {bounds}), by_half_spaces(*t, wild, {bounds}),
        by_tangent_planes(*t, wild, {bounds})}) {
    CHECK(worst_outside(t->apply(map.x), bounds) <= 1e-3);
    CHECK(distance(map.x, wild_g) < distance(t->similarity(1), wild_g));
  }
  // Conformal maps of a mesh are similarities, so there is no interior for a barrier method.
  const Projected conformal = by_local_frames(*t, wild_g, {{0, 0.5, 2}});
  CHECK(worst_outside(t->apply(conformal.x), {0.001, 0.5, 2}) <= 1e-9);
}

TEST_CASE("Comparison: all methods unfold a folded picture, and each row measures the result") {
  const Folded bar(100);
  std::vector<ComparedMap> rows;
  compare(bar.rest, bar.pose, [&](const ComparedMap& row) { rows.push_back(row); });
  REQUIRE(rows.size() == 6);
  CHECK(std::abs(rows[0].turning_number - 1) > 0.5);  // the reference
  for (const ComparedMap& row : rows) {
    INFO(row.label);
    CHECK(row.f.size() == static_cast<Index>(bar.rest.mesh->vertices.size()));
    if (row.label == rows[0].label) continue;
    CHECK(row.flipped_triangles == 0);
    CHECK(row.max_k <= 0.7 + 0.05);
    CHECK(row.max_tau <= 5 + 0.05);
  }
  // Our map and the maps by local frames have no branch points.
  for (const size_t i : {1, 2, 3}) CHECK(std::abs(rows[i].turning_number - 1) <= 1e-9);
  CHECK(rows[1].settled);
  CHECK(rows[1].max_k <= 0.7);
  CHECK(rows[1].max_tau <= 5);
  std::stop_source stop;
  int taken = 0;
  const auto stop_soon = [&](const ComparedMap&) {
    if (++taken == 2) stop.request_stop();
  };
  compare(bar.rest, bar.pose, stop_soon, stop.get_token());
  CHECK(taken == 2);
  Rest narrow = bar.rest;
  narrow.parameters = {{"sigma", 3}, {"Sigma", 2}};
  CHECK_THROWS_AS(compare(narrow, bar.pose, [](const ComparedMap&) {}), Error);
}

}  // namespace holomorph::comparison_test
