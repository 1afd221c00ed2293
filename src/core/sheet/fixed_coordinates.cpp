#include "core/sheet/fixed_coordinates.h"

#include "core/arithmetic.h"
#include "core/error.h"

namespace holomorph {

FixedCoordinates::FixedCoordinates(std::shared_ptr<const Mesh> shared,
                                   const std::vector<std::array<bool, 2>>& fixed)
    : mesh_(std::move(shared)) {
  const Mesh& mesh = *mesh_;
  check(fixed.empty() || fixed.size() == mesh.vertices.size(), "sheet: a mark for each vertex");
  if (fixed.empty()) return;
  for (size_t k = 0; k < axes_.size(); ++k) {
    Axis& axis = axes_[k];
    std::vector<int> number;  // among the fixed or the free coordinates
    for (size_t v = 0; v < fixed.size(); ++v) {
      std::vector<int>& list = fixed[v][k] ? axis.fixed : axis.free;
      number.push_back(static_cast<int>(list.size()));
      list.push_back(static_cast<int>(v));
    }
    if (axis.fixed.empty() || axis.free.empty()) continue;
    std::vector<Eigen::Triplet<double>> inside, across;
    for (const Triangle& t : mesh.triangles)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          const auto v = static_cast<size_t>(t[a]), w = static_cast<size_t>(t[b]);
          if (fixed[v][k]) continue;
          const double entry =
              dot(opposite_side(mesh, t, a), opposite_side(mesh, t, b)) / (4 * area_of(mesh, t));
          (fixed[w][k] ? across : inside).emplace_back(number[v], number[w], entry);
        }
    const auto count = static_cast<Index>(axis.free.size());
    Matrix matrix(count, count);
    matrix.setFromTriplets(inside.begin(), inside.end());
    axis.coupling.resize(count, static_cast<Index>(axis.fixed.size()));
    axis.coupling.setFromTriplets(across.begin(), across.end());
    axis.factor.compute(matrix);
    check(axis.factor.info() == Eigen::Success, "sheet: the Dirichlet energy is definite");
  }
}

void FixedCoordinates::restore(VectorXc& f) const {
  for (size_t k = 0; k < axes_.size(); ++k) {
    const Axis& axis = axes_[k];
    const auto part = [k](Complex z) { return k == 0 ? z.real() : z.imag(); };
    const auto move = [&](int v, double by) { f[v] += k == 0 ? Complex(by, 0) : Complex(0, by); };
    VectorXd back(static_cast<Index>(axis.fixed.size()));
    for (size_t i = 0; i < axis.fixed.size(); ++i) {
      const int v = axis.fixed[i];
      const double rest = part(mesh_->vertices[static_cast<size_t>(v)]);
      back[static_cast<Index>(i)] = rest - part(f[v]);
      // Adding the difference would leave a rounding error.
      f[v] = k == 0 ? Complex(rest, f[v].imag()) : Complex(f[v].real(), rest);
    }
    if (axis.fixed.empty() || axis.free.empty()) continue;
    const VectorXd follow = axis.factor.solve(-(axis.coupling * back));
    for (size_t i = 0; i < axis.free.size(); ++i) move(axis.free[i], follow[static_cast<Index>(i)]);
  }
}

}  // namespace holomorph
