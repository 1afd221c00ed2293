// The unknowns are displacements, which are 0 at rest.
#include "core/sheet/conformal_path.h"

#include <Eigen/SparseCholesky>

#include "core/error.h"

namespace holomorph {

namespace {

constexpr double kRows = 1e3;  // the weight of a squared miss

VectorXc at_rest(const Mesh& mesh) {
  return Eigen::Map<const VectorXc>(mesh.vertices.data(), static_cast<Index>(mesh.vertices.size()));
}

}  // namespace

struct ConformalPaths::Factor {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>> solver;
};

ConformalPaths::ConformalPaths(std::shared_ptr<const Mesh> mesh, std::vector<SheetRow> rows)
    : mesh_(std::move(mesh)),
      rows_(std::move(rows)),
      between_(mesh_),
      rest_(between_.shape_of(at_rest(*mesh_), 0)),
      factor_(std::make_unique<Factor>()) {
  // Adding a small part of the Dirichlet energy makes the matrix definite.
  constexpr double kDirichlet = 1e-3;
  std::vector<Eigen::Triplet<Complex>> entries;
  for (const Triangle& t : mesh_->triangles) {
    const double area = area_of(*mesh_, t);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const Complex ea = opposite_side(*mesh_, t, a), eb = opposite_side(*mesh_, t, b);
        entries.emplace_back(
            t[a], t[b], std::conj(ea) * eb / (16 * area) + kDirichlet * dot(ea, eb) / (8 * area));
      }
  }
  for (const SheetRow& row : rows_)
    for (const auto& [v, a] : row.terms)
      for (const auto& [w, b] : row.terms) entries.emplace_back(v, w, kRows * a * b);
  const Index n = static_cast<Index>(mesh_->vertices.size());
  Eigen::SparseMatrix<Complex> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_->solver.compute(matrix);
  check(factor_->solver.info() == Eigen::Success, "sheet: the conformal energy is definite");
}

ConformalPaths::~ConformalPaths() = default;

ConformalPaths::Path ConformalPaths::path(const VectorXc& displacements) const {
  VectorXc pull = VectorXc::Zero(static_cast<Index>(mesh_->vertices.size()));
  for (size_t r = 0; r < rows_.size(); ++r)
    for (const auto& [v, weight] : rows_[r].terms)
      pull[v] += kRows * weight * displacements[static_cast<Index>(r)];
  const VectorXc f = at_rest(*mesh_) + factor_->solver.solve(pull);
  Inbetween::Shape end = between_.shape_of(f, 0);
  const double turns = std::round(end.logarithm.imag().mean() / (2 * kPi));
  if (turns != 0) end = between_.shape_of(f, -static_cast<int>(turns));
  return {std::move(end), least_moving_point(*mesh_, rest_.f, f)};
}

ConformalPaths::Path ConformalPaths::wound(std::span<const Location> places,
                                           std::span<const double> rotations) const {
  check(!places.empty() && places.size() == rotations.size(), "sheet: a rotation for each place");
  // The smoothest angles with these values (Dirichlet).
  const Index n = static_cast<Index>(mesh_->vertices.size());
  std::vector<Eigen::Triplet<double>> entries;
  VectorXd pull = VectorXd::Zero(n);
  for (const Triangle& t : mesh_->triangles)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        entries.emplace_back(t[a], t[b],
                             dot(opposite_side(*mesh_, t, a), opposite_side(*mesh_, t, b)) /
                                 (4 * area_of(*mesh_, t)));
  for (size_t i = 0; i < places.size(); ++i) {
    const Location& at = places[i];
    const Triangle& t = mesh_->triangles[static_cast<size_t>(at.triangle)];
    for (size_t a = 0; a < 3; ++a) {
      pull[t[a]] += kRows * at.weights[a] * rotations[i];
      for (size_t b = 0; b < 3; ++b)
        entries.emplace_back(t[a], t[b], kRows * at.weights[a] * at.weights[b]);
    }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  check(factor.info() == Eigen::Success, "sheet: the Dirichlet energy is definite");
  const VectorXd angles = factor.solve(pull);
  Path path{rest_, places.front()};
  for (Index i = 0; i < path.end.logarithm.size(); ++i) {
    const auto& [a, b, c] = mesh_->triangles[static_cast<size_t>(i)];
    path.end.logarithm[i] = Complex(0, (angles[a] + angles[b] + angles[c]) / 3);
  }
  constexpr double kAlmost = 1 - 1e-9;  // only the end itself has to be known
  path.end.f = at(path, kAlmost);
  return path;
}

VectorXc ConformalPaths::at(const Path& path, double part) const {
  VectorXc f;
  between_.blend({.from = rest_, .to = path.end, .still = &path.still}, part, f);
  return f;
}

}  // namespace holomorph
