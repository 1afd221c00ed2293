// Maps with known derivatives, ready to be projected. They include the maps in the specification of
// bounded distortion.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>

#include "core/bounded/bounded_space.h"
#include "core/maps/argument.h"
#include "core/mesh/mesh.h"
#include "core/mesh/mesher.h"

namespace known_maps {

using namespace holomorph;
using Norm = BoundedSettings::Norm;

/// A smooth map of the plane, given by its Wirtinger derivatives.
struct KnownMap {
  const char* name;
  Points domain;
  std::function<Complex(Complex)> fz, fzbar;
};

inline Points circle(int n) {
  Points points;
  for (int i = 0; i < n; ++i) points.push_back(std::polar(1.0, 2 * kPi * i / n));
  return points;
}

inline Points bar() {
  return {{0, -0.5}, {6, -0.5}, {6, 0.5}, {0, 0.5}};
}

/// Compute the Wirtinger derivatives from the partial derivatives.
inline Complex fz_of(Complex fx, Complex fy) {
  return 0.5 * (fx - kI * fy);
}
inline Complex fzbar_of(Complex fx, Complex fy) {
  return 0.5 * (fx + kI * fy);
}

inline KnownMap squared() {
  return {"(z - 0.05)^2", circle(50), [](Complex z) { return 2.0 * (z - 0.05); },
          [](Complex) { return Complex(0); }};
}
inline KnownMap quadratic() {
  return {"z + 0.3 z^2 + 0.9 conj(z)^2",
          {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
          [](Complex z) { return 1.0 + 0.6 * z; },
          [](Complex z) { return 1.8 * std::conj(z); }};
}
inline KnownMap spiral() {
  const double radius = 6 / (2 * kPi);
  const auto turn = [=](Complex z) { return std::polar(1.0, z.real() / radius - kPi / 2); };
  const auto fx = [=](Complex z) {
    return (radius - z.imag()) * turn(z) * (kI / radius * (1 + 0.12 * z.real()) + 0.12);
  };
  const auto fy = [=](Complex z) { return -turn(z) * (1 + 0.12 * z.real()); };
  return {"a 360 degree spiral", bar(), [=](Complex z) { return fz_of(fx(z), fy(z)); },
          [=](Complex z) { return fzbar_of(fx(z), fy(z)); }};
}
inline KnownMap folded() {
  const auto fx = [](Complex z) {
    return Complex(1 - 1.6 * std::exp(-4 * (z.real() - 3) * (z.real() - 3)));
  };
  return {"a fold", bar(), [=](Complex z) { return fz_of(fx(z), kI); },
          [=](Complex z) { return fzbar_of(fx(z), kI); }};
}

/// A map of a bar whose derivative f_z has a zero at an interior point.
inline KnownMap pinched() {
  return {"one zero in a bar", bar(), [](Complex z) { return (z - Complex(3.7, 0.05)) * 0.4; },
          [](Complex) { return Complex(0); }};
}
inline KnownMap two_zeros() {
  return {"two zeros",
          {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
          [](Complex z) { return (z - Complex(0.4, 0.1)) * (z + Complex(0.3, -0.2)) * 3.0; },
          [](Complex) { return Complex(0); }};
}

inline VectorXc values(const std::function<Complex(Complex)>& f, const Points& points) {
  VectorXc result(static_cast<Index>(points.size()));
  for (size_t i = 0; i < points.size(); ++i) result[static_cast<Index>(i)] = f(points[i]);
  return result;
}

/// The resolution: numbers of polygon vertices and samples.
struct Fineness {
  int basis = 50, samples = 300;
};

/// A known map over its domain, ready to be projected.
struct Projection {
  std::shared_ptr<const BoundaryBasis> basis;
  std::unique_ptr<BoundedSpace> space;
  ReferencePoints points;
  BoundedReference reference;
  Mesh mesh;

  /// With `inside`, the energy also measures nu at points inside the domain.
  Projection(const KnownMap& known, const Bounds& bounds, Norm norm, bool inside = true,
             Fineness fineness = {}) {
    const Cage cage = polygon_cage(known.domain);
    basis = std::make_shared<const BoundaryBasis>(cage, fineness.basis, fineness.samples);
    mesh = domain_mesh(cage, {1000});
    points.boundary = basis->samples();
    std::vector<bool> outer(mesh.vertices.size());
    for (const int v : mesh.boundary) outer[static_cast<size_t>(v)] = true;
    for (size_t v = 0; v < mesh.vertices.size() && inside; ++v)
      if (!outer[v]) points.inner.push_back(mesh.vertices[v]);
    space = std::make_unique<BoundedSpace>(basis, points, BoundedSettings{bounds, norm, 1});
    // Take the argument of f_z from the nearest holomorphic function.
    const VectorXc fz = values(known.fz, basis->samples());
    const auto [unknowns, gamma] = HolomorphicFit(*basis, basis->samples())(fz);
    const VectorXc on_mesh = basis->whitened(basis->values(mesh.vertices)) * unknowns;
    const VectorXd theta = boundary_argument(basis->samples(), gamma, zeros_of(mesh, on_mesh));
    reference.log_fz.resize(fz.size());
    for (Index i = 0; i < fz.size(); ++i)
      reference.log_fz[i] = Complex(std::log(std::abs(fz[i])), theta[i]);
    const auto nu = [&](Complex z) { return std::conj(known.fzbar(z)) / known.fz(z); };
    reference.nu = values(nu, basis->samples());
    reference.inner_nu = values(nu, points.inner);
    const auto psi = [&](Complex z) { return std::conj(known.fzbar(z)); };
    reference.psi = values(psi, basis->samples());
    reference.inner_psi = values(psi, points.inner);
  }

  double energy(const BoundedMap& map) const { return space->energy(reference, map.solution); }
};

inline std::vector<KnownMap> all() {
  return {squared(), quadratic(), spiral(), folded(), pinched(), two_zeros()};
}

/// The largest violation of the bounds at these points. Positive if any bound is violated.
inline double violation(const BoundaryBasis& basis, const LogMap& map, const Points& points,
                        const Bounds& bounds) {
  const MatrixXc c = basis.values(points);
  const auto [phi, psi] = derivatives_of(map, c * map.l, c * map.w);
  double worst = -1;
  for (Index i = 0; i < phi.size(); ++i) {
    const double fz = std::abs(phi[i]), fzbar = std::abs(psi[i]);
    if (!std::isfinite(fz) || !std::isfinite(fzbar)) return std::numeric_limits<double>::infinity();
    worst = std::max(
        {worst, fzbar / fz - bounds.k, fz + fzbar - bounds.Sigma, bounds.sigma - (fz - fzbar)});
  }
  return worst;
}

/// All vertices of a mesh, and ten points on each piece of the domain's boundary.
inline Points dense_points(const BoundaryBasis& basis, const Mesh& mesh) {
  Points points = mesh.vertices;
  for (const BoundaryPiece& piece : basis.pieces())
    for (int k = 0; k < 10; ++k) {
      const double t = piece.from + (k + 0.5) / 10 * (piece.to - piece.from);
      points.push_back(bezier_point(basis.domain().controls(piece.segment), t));
    }
  return points;
}

}  // namespace known_maps
