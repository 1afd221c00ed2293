// Newton's method on x and y of all vertices, in turn. The matrix has the entries of bending, which
// joins vertices with a common neighbor, whatever the positions are.
#include "core/sheet/sheet_program.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "core/error.h"

namespace holomorph {
namespace {

/// Relative to the largest stiffness: keeps the matrix definite where nothing resists a motion,
/// such as rotation about a single pin. The first is so small that the tip of a long, thin limb
/// gets to its place in few steps; the second is for matrices that rounding errors make indefinite.
constexpr std::array kLeastStiffness{1e-14, 1e-10};

using Matrix = Eigen::SparseMatrix<double>;

/// The position of an entry of the lower triangle in the values of the matrix.
int slot_of(const Matrix& matrix, Index i, Index j) {
  const int row = static_cast<int>(std::max(i, j)), column = static_cast<int>(std::min(i, j));
  const int *first = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column],
            *end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column + 1];
  const int* found = std::lower_bound(first, end, row);
  check(found != end && *found == row, "sheet: the matrix has all entries of its triangles");
  return static_cast<int>(found - matrix.innerIndexPtr());
}

/// Calls visit(i, j, part, block) for the entries in the lower triangle of a row's Hessian, which
/// are `part` times the entry 0 to 3 of a 2 x 2 block.
void for_entries(const SheetRow& row, auto&& visit) {
  for (const auto& [v, a] : row.terms)
    for (const auto& [w, b] : row.terms)
      for (int k = 0; k < 4; ++k)
        if (const Index i = 2 * v + k / 2, j = 2 * w + k % 2; i >= j) visit(i, j, a * b, k);
}

Eigen::Vector2d vector(Complex z) {
  return {z.real(), z.imag()};
}

/// Derivatives of the energy E of a spring that misses its target by `off`. `projected`: the
/// Hessian of the quadratic function that touches E from above, since E is concave in r^2.
Eigen::Vector2d gradient_of(const Spring& spring, Complex off) {
  return 2 * spring.slope(std::norm(off)) * vector(off);
}
Eigen::Matrix2d hessian_of(const Spring& spring, Complex off, bool projected) {
  Eigen::Matrix2d hessian = 2 * spring.slope(std::norm(off)) * Eigen::Matrix2d::Identity();
  if (!projected)
    hessian += 4 * spring.curvature(std::norm(off)) * vector(off) * vector(off).transpose();
  return hessian;
}

double work_of(const VectorXc& load, const VectorXc& f) {
  double sum = 0;
  for (Index v = 0; v < load.size(); ++v) sum += dot(load[v], f[v]);
  return sum;
}

}  // namespace

struct SheetProgram::Factor {
  std::mutex in_use;  ///< guards the members below
  Matrix matrix;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver;
};

SheetProgram::SheetProgram(std::shared_ptr<const SheetEnergy> energy, SheetHolds holds)
    : energy_(std::move(energy)), holds_(std::move(holds)), factor_(std::make_unique<Factor>()) {
  const Mesh& mesh = energy_->mesh();
  const Index unknowns = 2 * static_cast<Index>(mesh.vertices.size());
  check(holds_.fixed.empty() || holds_.fixed.size() == mesh.vertices.size(),
        "sheet: a mark for each vertex");
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Index i, Index j, double value) {
    if (i >= j && !is_fixed(i) && !is_fixed(j)) entries.emplace_back(i, j, value);
  };
  for (Index i = 0; i < unknowns; ++i) entries.emplace_back(i, i, is_fixed(i) ? 1.0 : 0.0);
  const Matrix& bending = energy_->bending_matrix();
  for (Index column = 0; column < bending.outerSize(); ++column)
    for (Matrix::InnerIterator at(bending, column); at; ++at)
      for (Index k = 0; k < 2; ++k) add(2 * at.row() + k, 2 * column + k, at.value());
  for (const SheetRow& row : holds_.rows)
    for_entries(row, [&](Index i, Index j, double, int) { add(i, j, 0); });
  for (const Triangle& t : mesh.triangles)
    for (const int v : t)
      for (const int w : t)
        for (Index k = 0; k < 4; ++k) add(2 * v + k / 2, 2 * w + k % 2, 0);
  constant_.resize(unknowns, unknowns);
  constant_.setFromTriplets(entries.begin(), entries.end());
  for (const Triangle& t : mesh.triangles) {
    std::array<int, 21>& slots = slots_.emplace_back();
    size_t at = 0;
    for (size_t i = 0; i < 6; ++i)
      for (size_t j = 0; j <= i; ++j) {
        const Index row = 2 * t[i / 2] + static_cast<Index>(i % 2),
                    column = 2 * t[j / 2] + static_cast<Index>(j % 2);
        slots[at++] = is_fixed(row) || is_fixed(column) ? -1 : slot_of(constant_, row, column);
      }
  }
  for (const SheetRow& row : holds_.rows) {
    std::vector<int>& slots = row_slots_.emplace_back();
    for_entries(row, [&](Index i, Index j, double, int) {
      slots.push_back(is_fixed(i) || is_fixed(j) ? -1 : slot_of(constant_, i, j));
    });
  }
  factor_->matrix = constant_;
  factor_->solver.analyzePattern(constant_);
}

SheetProgram::~SheetProgram() = default;

double SheetProgram::value(const VectorXc& f, const SheetPull& pull) const {
  double sum = energy_->value(f);
  for (size_t r = 0; r < holds_.rows.size(); ++r)
    sum += pull.rows[r].spring.value(std::norm(holds_.rows[r].image(f) - pull.rows[r].target));
  for (const VertexPull& at : pull.vertices)
    sum += at.spring.value(std::norm(f[at.vertex] - at.target));
  return sum - work_of(pull.load, f);
}

VectorXd SheetProgram::gradient(const VectorXc& f, const SheetPull& pull) const {
  const VectorXc bending = energy_->bending_gradient(f);
  VectorXd gradient(2 * f.size());
  for (Index v = 0; v < f.size(); ++v) gradient.segment<2>(2 * v) = vector(bending[v]);
  for (size_t i = 0; i < slots_.size(); ++i) {
    const SheetGradient own = energy_->gradient_of(i, f);
    const Triangle& t = energy_->mesh().triangles[i];
    for (int k = 0; k < 3; ++k) gradient.segment<2>(2 * t[k]) += own.segment<2>(2 * k);
  }
  for (size_t r = 0; r < holds_.rows.size(); ++r) {
    const SheetRow& row = holds_.rows[r];
    const Eigen::Vector2d own =
        gradient_of(pull.rows[r].spring, row.image(f) - pull.rows[r].target);
    for (const auto& [v, weight] : row.terms) gradient.segment<2>(2 * v) += weight * own;
  }
  for (const VertexPull& at : pull.vertices)
    gradient.segment<2>(2 * at.vertex) += gradient_of(at.spring, f[at.vertex] - at.target);
  for (Index v = 0; v < pull.load.size(); ++v) gradient.segment<2>(2 * v) -= vector(pull.load[v]);
  for (Index i = 0; i < gradient.size(); ++i)
    if (is_fixed(i)) gradient[i] = 0;
  return gradient;
}

/// Factorizes the Hessian at f. Returns whether it is positive definite.
bool SheetProgram::factorize(const SheetPull& pull, const VectorXc& f, bool projected) const {
  Matrix& matrix = factor_->matrix;
  double* values = matrix.valuePtr();
  std::copy_n(constant_.valuePtr(), constant_.nonZeros(), values);
  for (size_t i = 0; i < slots_.size(); ++i) {
    const SheetHessian own = energy_->hessian_of(i, f, projected);
    size_t at = 0;
    for (Index k = 0; k < 6; ++k)
      for (Index j = 0; j <= k; ++j, ++at)
        if (const int slot = slots_[i][at]; slot >= 0) values[slot] += own(k, j);
  }
  for (size_t r = 0; r < holds_.rows.size(); ++r) {
    const SheetRow& row = holds_.rows[r];
    const Eigen::Matrix2d own =
        hessian_of(pull.rows[r].spring, row.image(f) - pull.rows[r].target, projected);
    auto slot = row_slots_[r].begin();
    for_entries(row, [&](Index, Index, double part, int k) {
      if (*slot >= 0) values[*slot] += part * own(k / 2, k % 2);
      ++slot;
    });
  }
  // Entries of the diagonal are the first of their columns, followed by those below.
  for (const VertexPull& at : pull.vertices) {
    const Eigen::Matrix2d own = hessian_of(at.spring, f[at.vertex] - at.target, projected);
    const int x = 2 * at.vertex, y = x + 1;
    if (!is_fixed(x)) values[matrix.outerIndexPtr()[x]] += own(0, 0);
    if (!is_fixed(y)) values[matrix.outerIndexPtr()[y]] += own(1, 1);
    if (!is_fixed(x) && !is_fixed(y)) values[matrix.outerIndexPtr()[x] + 1] += own(1, 0);
  }
  double largest = 0;
  for (Index i = 0; i < matrix.cols(); ++i)
    largest = std::max(largest, values[matrix.outerIndexPtr()[i]]);
  double added = 0;
  for (const double least : kLeastStiffness) {
    for (Index i = 0; i < matrix.cols(); ++i)
      values[matrix.outerIndexPtr()[i]] += least * largest - added;
    added = least * largest;
    factor_->solver.factorize(matrix);
    if (factor_->solver.info() == Eigen::Success && factor_->solver.vectorD().minCoeff() > 0)
      return true;
    if (!projected) break;
  }
  return false;
}

SheetProgram::Step SheetProgram::step(const SheetPull& pull, VectorXc& f, bool projected) const {
  check(pull.rows.size() == holds_.rows.size(), "sheet: a target for each row");
  const double before = value(f, pull);
  const std::lock_guard lock(factor_->in_use);
  if ((projected || !factorize(pull, f, false)) && !factorize(pull, f, true))
    return {before, before + work_of(pull.load, f), 0, 0};
  const VectorXd slopes = gradient(f, pull), down = factor_->solver.solve(-slopes);
  VectorXc d(f.size());
  for (Index v = 0; v < d.size(); ++v) d[v] = {down[2 * v], down[2 * v + 1]};
  constexpr double kFlipShare = 0.9, kArmijo = 1e-4, kShortest = 1e-10;
  const double slope = slopes.dot(down);
  Step step{before, 0, -0.5 * slope, 0};
  for (double length = std::min(1.0, kFlipShare * energy_->first_flip(f, d)); length > kShortest;
       length *= 0.5) {
    VectorXc there = f + length * d;
    const double after = value(there, pull);
    if (!(after <= before + kArmijo * length * slope)) continue;
    f = std::move(there);
    step.value = after;
    step.length = length;
    break;
  }
  step.energy = step.value + work_of(pull.load, f);
  return step;
}

SheetProgram::Step SheetProgram::minimize(const SheetPull& pull, VectorXc& f, int most,
                                          const std::function<void(const VectorXc&)>& after,
                                          double tolerance, bool is_near) const {
  // The decrement, as a fraction of the energy, below which true Hessians are tried.
  constexpr double kNear = 1e-2;
  Step last;
  for (int i = 0; i < most; ++i) {
    last = step(pull, f, !is_near);
    if (after) after(f);
    is_near = last.length > 0.5 && last.decrement <= kNear * last.energy;
    if (last.length == 0 || last.decrement <= tolerance * last.energy) break;
  }
  return last;
}

}  // namespace holomorph
