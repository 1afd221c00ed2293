// Locally injective harmonic maps: the nearest ones to known maps, and the proof of their bounds.
#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include "core/argument.h"
#include "core/bounded_space.h"
#include "core/clock.h"
#include "core/mesh.h"
#include "support/shapes.h"

using namespace holomorph;
using Norm = BoundedSettings::Norm;

namespace {

/// A smooth map of the plane by its Wirtinger derivatives.
struct Known {
  const char* name;
  Points domain;
  std::function<Complex(Complex)> fz, fzbar;
};

Points circle(int n) {
  Points points;
  for (int i = 0; i < n; ++i) points.push_back(std::polar(1.0, 2 * kPi * i / n));
  return points;
}

Points bar() {
  return {{0, -0.5}, {6, -0.5}, {6, 0.5}, {0, 0.5}};
}

/// From partial derivatives.
Complex fz_of(Complex fx, Complex fy) {
  return 0.5 * (fx - kI * fy);
}
Complex fzbar_of(Complex fx, Complex fy) {
  return 0.5 * (fx + kI * fy);
}

Known squared() {
  return {"(z - 0.05)^2", circle(50), [](Complex z) { return 2.0 * (z - 0.05); },
          [](Complex) { return Complex(0); }};
}
Known quadratic() {
  return {"z + 0.3 z^2 + 0.9 conj(z)^2",
          {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
          [](Complex z) { return 1.0 + 0.6 * z; },
          [](Complex z) { return 1.8 * std::conj(z); }};
}
Known spiral() {
  const double radius = 6 / (2 * kPi);
  const auto turn = [=](Complex z) { return std::polar(1.0, z.real() / radius - kPi / 2); };
  const auto fx = [=](Complex z) {
    return (radius - z.imag()) * turn(z) * (kI / radius * (1 + 0.12 * z.real()) + 0.12);
  };
  const auto fy = [=](Complex z) { return -turn(z) * (1 + 0.12 * z.real()); };
  return {"a 360 degree spiral", bar(), [=](Complex z) { return fz_of(fx(z), fy(z)); },
          [=](Complex z) { return fzbar_of(fx(z), fy(z)); }};
}
Known folded() {
  const auto fx = [](Complex z) {
    return Complex(1 - 1.6 * std::exp(-4 * (z.real() - 3) * (z.real() - 3)));
  };
  return {"a fold", bar(), [=](Complex z) { return fz_of(fx(z), kI); },
          [=](Complex z) { return fzbar_of(fx(z), kI); }};
}

VectorXc values(const std::function<Complex(Complex)>& f, const Points& points) {
  VectorXc result(static_cast<Index>(points.size()));
  for (size_t i = 0; i < points.size(); ++i) result[static_cast<Index>(i)] = f(points[i]);
  return result;
}

struct Projection {
  std::shared_ptr<const BoundaryBasis> basis;
  std::unique_ptr<BoundedSpace> space;
  BoundedReference reference;
  Mesh mesh;

  Projection(const Known& known, const Bounds& bounds, Norm norm, int basis_size = 50,
             int samples = 300) {
    const Cage cage = polygon_cage(known.domain);
    basis = std::make_shared<const BoundaryBasis>(cage, basis_size, samples);
    mesh = domain_mesh(cage, {1000});
    Points inner;
    std::vector<bool> outer(mesh.vertices.size());
    for (const int v : mesh.boundary) outer[static_cast<size_t>(v)] = true;
    for (size_t v = 0; v < mesh.vertices.size(); ++v)
      if (!outer[v] && !getenv("NOINNER")) inner.push_back(mesh.vertices[v]);
    space = std::make_unique<BoundedSpace>(basis, ReferencePoints{basis->samples(), inner},
                                           BoundedSettings{bounds, norm, 1});
    VectorXc fz = values(known.fz, basis->samples());
    VectorXc gamma = fz;
    VectorXc gmesh = values(known.fz, mesh.vertices);
    if (const char* mode = getenv("GAMMA")) {
      const MatrixXc& q = basis->at_samples();
      VectorXc c = q.adjoint() * fz / (double)fz.size();
      if (mode[0] == '2' || mode[0] == '4') {
        MatrixXc qi = basis->whitened(basis->values(mesh.vertices));
        const Index ni = qi.rows();
        MatrixXc all(q.rows() + ni, q.cols());
        all << q / std::sqrt((double)q.rows()), qi / std::sqrt((double)ni);
        VectorXc rhs(q.rows() + ni);
        rhs << fz / std::sqrt((double)q.rows()), gmesh / std::sqrt((double)ni);
        c = (all.adjoint() * all).ldlt().solve(all.adjoint() * rhs);
      }
      gamma = q * c;
      gmesh = basis->whitened(basis->values(mesh.vertices)) * c;
      if (mode[0] >= '3') fz = gamma;
    }
    // As if harmonic: arguments of f_z itself where it has no holomorphic part.
    const VectorXd theta = boundary_argument(basis->samples(), gamma, zeros_of(mesh, gmesh));
    reference.log_fz.resize(fz.size());
    for (Index i = 0; i < fz.size(); ++i)
      reference.log_fz[i] = Complex(std::log(std::abs(fz[i])), theta[i]);
    const auto nu = [&](Complex z) { return std::conj(known.fzbar(z)) / known.fz(z); };
    reference.nu = values(nu, basis->samples());
    reference.inner_nu = values(nu, inner);
  }
};

}  // namespace

TEST_CASE("Bounded: energies of the known maps") {
  struct Row {
    Known known;
    double l2, l1;
  };
  for (const Row& row : {Row{squared(), 0.836, 1.28}, Row{quadratic(), 0.0043, 0.0049},
                         Row{spiral(), 0.0374, 0.219}})
    for (const Norm norm : {Norm::l2, Norm::l1}) {
      const Projection projection(row.known, {}, norm);
      const double start = now_ms();
      const BoundedMap map = projection.space->nearest(projection.reference);
      const double ms = now_ms() - start;
      const double energy = projection.space->energy(projection.reference, map.solution);
      const VectorXc l = projection.basis->values(projection.basis->samples()) * map.map.l -
                         projection.reference.log_fz;
      const VectorXc nb = projection.basis->values(projection.basis->samples()) * map.map.nu;
      WARN("u L1 " << l.real().cwiseAbs().mean() << " v L1 " << l.imag().cwiseAbs().mean()
                   << " iso " << l.cwiseAbs().mean() << " u2 " << l.real().squaredNorm() / l.size()
                   << " v2 " << l.imag().squaredNorm() / l.size() << " nu max "
                   << nb.cwiseAbs().maxCoeff() << " nu2 raw "
                   << (nb - projection.reference.nu).squaredNorm() / l.size());
      WARN(row.known.name << ": " << energy << " wanted " << (norm == Norm::l1 ? row.l1 : row.l2)
                          << ", " << map.solution.iterations << " its, " << ms << " ms, certified "
                          << map.certificate.holds << " rounds " << map.rounds << " blend "
                          << map.blend << " gap " << map.solution.gap << " residual "
                          << map.solution.residual << " basis " << projection.basis->size());
    }
}
