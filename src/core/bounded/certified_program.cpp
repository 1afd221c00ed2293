// A proof fails where the functions deviate too much from the chords between samples. Additional
// samples constrain the functions there.
#include "core/bounded/certified_program.h"

#include <algorithm>

namespace holomorph {

std::optional<Bound> binding_constraint(std::initializer_list<const ConeSolution*> solutions) {
  constexpr double kNothing = 1e-2;  // the solver leaves smaller multipliers on inactive bounds
  std::optional<Bound> binding;
  double most = kNothing;
  for (const ConeSolution* solution : solutions)
    for (size_t c = 0; c < solution->z.size(); ++c)
      if (const double push = solution->z[c].row(0).sum(); push > most) {
        most = push;
        binding = static_cast<Bound>(c);
      }
  return binding;
}

namespace {

/// The start, moved toward the center as far as necessary to be strictly feasible.
ConeSolution inside(const ConeSystem& system, ConeSolution start, const VectorXd& center) {
  const VectorXd x = start.x;
  for (double fraction = 0.02; !is_feasible(system, start.x) && fraction <= 1; fraction *= 2)
    start.x = (1 - fraction) * x + fraction * center;
  if (!is_feasible(system, start.x)) start.x = center;
  return start;
}

}  // namespace

BoundedMap CertifiedProgram::solved(const ConeTarget& target, const ConeSettings& settings,
                                    const ConeSolution& start, const Points& cuts) const {
  if (cuts.empty())
    return proved(target, settings, holomorph::solved(system, target, settings, start));
  ConeSystem cut = system;
  append(cuts, cut);
  return proved(target, settings,
                holomorph::solved(cut, target, settings, inside(cut, start, center)), cuts);
}

void CertifiedProgram::take(ConeSolution solution, BoundedMap& map) const {
  map.solution = std::move(solution);
  map.map = map_of(map.solution.x);
  map.certificate = certifier.certify(map.map, bounds);
}

void CertifiedProgram::blend(double first, double most, BoundedMap& map) const {
  // The center is certified, and all error bounds shrink on the way there.
  const VectorXd x = map.solution.x;
  for (double fraction = first; !map.certificate.holds; fraction = std::min(4 * fraction, most)) {
    map.blend = fraction;
    ConeSolution nearer = std::move(map.solution);
    nearer.x = (1 - fraction) * x + fraction * center;
    take(std::move(nearer), map);
    if (fraction == most) break;
  }
}

BoundedMap CertifiedProgram::proved(const ConeTarget& target, const ConeSettings& settings,
                                    ConeSolution solution, const Points& cuts) const {
  BoundedMap best;
  best.cuts = cuts;
  best.iterations = solution.iterations;
  take(std::move(solution), best);
  constexpr double kFirstBlend = 1e-5;
  constexpr int kMostRounds = 3;
  ConeSystem cut;
  for (; !best.certificate.holds && best.rounds < kMostRounds; ++best.rounds) {
    if (slight_blend > 0) {
      BoundedMap blended = best;
      blend(slight_blend / 16, slight_blend, blended);
      if (blended.certificate.holds) return blended;
    }
    if (best.rounds == 0) {
      cut = system;
      append(best.cuts, cut);
    }
    const Points unproved = std::move(best.certificate.unproved);
    append(unproved, cut);
    best.cuts.insert(best.cuts.end(), unproved.begin(), unproved.end());
    take(holomorph::solved(cut, target, settings, inside(cut, best.solution, center)), best);
    best.iterations += best.solution.iterations;
  }
  blend(kFirstBlend, 1, best);
  return best;
}

}  // namespace holomorph
