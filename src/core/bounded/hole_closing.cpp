#include "core/bounded/hole_closing.h"

namespace holomorph {

HoleClosing::HoleClosing(const BoundaryBasis& basis, const Mesh& mesh)
    : basis_(basis), loops_(mesh, basis.polygon()), integrals_(basis, mesh, {}, loops_.paths()) {}

Derivatives HoleClosing::weighted(const LogMap& map) const {
  Derivatives d = derivatives_of(map, integrals_.values() * map.l, integrals_.values() * map.w);
  d.phi = d.phi.cwiseProduct(integrals_.weights()).eval();
  d.psi = d.psi.cwiseProduct(integrals_.weights()).eval();
  return d;
}

VectorXc HoleClosing::gaps(const LogMap& map) const {
  const Derivatives d = weighted(map);
  return integrals_.of(d.phi, d.psi);
}

bool HoleClosing::is_closed(const LogMap& map) const {
  constexpr double kClosed = 1e-6;
  return !has_holes() ||
         !(gaps(map).cwiseAbs().maxCoeff() > kClosed * box_of(basis_.samples()).diagonal());
}

LogMap HoleClosing::closed(LogMap map, bool conformal) const {
  constexpr int kSteps = 6;
  constexpr double kRounding = 1e-14;
  const Index count = integrals_.count();
  for (int step = 0; step < kSteps; ++step) {
    const Derivatives d = weighted(map);
    const VectorXc gap = integrals_.of(d.phi, d.psi);
    const LogMap change = integrals_.smallest(
        {MatrixXd::Identity(count, count), -gap, map.second, conformal}, basis_, d);
    map.l += change.l;
    map.w += change.w;
    if (gap.cwiseAbs().maxCoeff() <= kRounding * d.phi.cwiseAbs().sum()) break;
  }
  return map;
}

}  // namespace holomorph
