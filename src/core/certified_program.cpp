// Where a proof fails the functions leave their samples' chord: another sample binds them there.
#include "core/certified_program.h"

#include <algorithm>

namespace holomorph {

std::optional<Bound> hardest_bound(const ConeSolution& solution) {
  constexpr double kNothing = 1e-2;  // multipliers left over from the interior
  std::optional<Bound> hardest;
  double most = kNothing;
  for (size_t c = 0; c < solution.z.size(); ++c)
    if (const double push = solution.z[c].row(0).sum(); push > most) {
      most = push;
      hardest = static_cast<Bound>(c);
    }
  return hardest;
}

BoundedMap CertifiedProgram::solved(const ConeTarget& target, const ConeSettings& settings,
                                    const ConeSolution& start) const {
  return proved(target, settings, holomorph::solved(system, target, settings, start));
}

BoundedMap CertifiedProgram::proved(const ConeTarget& target, const ConeSettings& settings,
                                    ConeSolution solution) const {
  BoundedMap best;
  const auto take = [&](ConeSolution candidate) {
    best.solution = std::move(candidate);
    best.map = map_of(best.solution.x);
    best.certificate = certifier.certify(best.map, bounds);
  };
  take(std::move(solution));
  constexpr int kMostRounds = 3;
  ConeSystem cut;
  for (; !best.certificate.holds && best.rounds < kMostRounds; ++best.rounds) {
    if (best.rounds == 0) cut = system;
    append(best.certificate.open, cut);
    ConeSolution from = best.solution;
    for (double share = 0.02; !is_feasible(cut, from.x) && share <= 1; share *= 2)
      from.x = (1 - share) * best.solution.x + share * centre;
    if (!is_feasible(cut, from.x)) from.x = centre;
    take(holomorph::solved(cut, target, settings, from));
  }
  // The centre is certified, and what lies between two certified maps is, too, nearly always.
  const VectorXd x = best.solution.x;
  for (double share = 1e-5; !best.certificate.holds; share = std::min(4 * share, 1.0)) {
    best.blend = share;
    ConeSolution nearer = best.solution;
    nearer.x = (1 - share) * x + share * centre;
    take(std::move(nearer));
    if (share == 1) break;
  }
  return best;
}

}  // namespace holomorph
