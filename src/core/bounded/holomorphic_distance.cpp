// Complex least squares in real form.
#include "core/bounded/holomorphic_distance.h"

#include "core/error.h"
#include "core/solvers/real_form.h"

namespace holomorph {

HolomorphicDistance::HolomorphicDistance(const BoundaryBasis& basis, const ReferencePoints& points,
                                         double weight)
    : boundary_(basis, points.boundary),
      inner_(basis.whitened(basis.values(points.inner))),
      weight_(weight),
      quadratic_(MatrixXd::Zero(2 * basis.unknowns(), 2 * basis.unknowns())) {
  for (const MatrixXc* rows : std::initializer_list<const MatrixXc*>{&boundary_.rows(), &inner_}) {
    if (rows->rows() == 0) continue;
    MatrixXd re, im;
    real_columns(*rows, re, im);
    quadratic_ += row_weight(*rows) * (re * re.transpose() + im * im.transpose());
  }
}

/// The weight of one squared difference at these rows.
double HolomorphicDistance::row_weight(const MatrixXc& rows) const {
  return weight_ * (inner_.rows() > 0 ? 0.5 : 1) / static_cast<double>(rows.rows());
}

HolomorphicDistance::Target HolomorphicDistance::target(const VectorXc& boundary,
                                                        const VectorXc& inner, double most) const {
  check(boundary.size() == boundary_.rows().rows() && inner.size() == inner_.rows(),
        "holomorphic distance: one value for each point");
  Target target{VectorXd::Zero(quadratic_.rows())};
  const auto add = [&](const MatrixXc& rows, VectorXc values) {
    if (rows.rows() == 0) return;
    for (Complex& x : values) {
      const double size = std::abs(x);
      if (!std::isfinite(size))
        x = 0;
      else if (size > most)
        x *= most / size;
    }
    target.linear -= row_weight(rows) * stacked(rows.adjoint() * values);
    target.constant += 0.5 * row_weight(rows) * values.squaredNorm();
  };
  add(boundary_.rows(), boundary);
  add(inner_, inner);
  return target;
}

}  // namespace holomorph
