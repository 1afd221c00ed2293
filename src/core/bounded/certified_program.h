// A cone program whose solution is a map, and the proof that this map stays within its bounds.
#pragma once

#include <functional>

#include "core/bounded/certificate.h"
#include "core/solvers/cone_program.h"

namespace holomorph {

/// A map that stays within its bounds, how it was found, and the proof.
struct BoundedMap {
  LogMap map;
  Certificate certificate;
  ConeSolution solution;
  int rounds = 0;      ///< number of times that samples were added
  Points cuts;         ///< all samples that were added
  int iterations = 0;  ///< total over all rounds
  double blend = 0;    ///< how far the proof moved the solution toward the center, 0 to 1
};

/// The bound that, if widened, would reduce the solutions' energies most. Empty when no bound is
/// active.
std::optional<Bound> binding_constraint(std::initializer_list<const ConeSolution*> solutions);

/// A cone program at the boundary's samples, and the maps that its unknowns represent. The objects
/// that it refers to must outlive it.
struct CertifiedProgram {
  const Certifier& certifier;
  const Bounds& bounds;  ///< to be proved; the program's own bounds are a little narrower
  const ConeSystem& system;
  const VectorXd& center;  ///< feasible, and always certified
  std::function<LogMap(const VectorXd& x)> map_of;
  /// Adds samples at points of the boundary.
  std::function<void(const Points& points, ConeSystem& system)> append;
  /// How far a solution may be moved toward the center, 0 to 1, before samples are added. This
  /// often saves drafts a second solve.
  double slight_blend = 0;

  /// Solves from a feasible start. `cuts` are additional samples that are likely to be needed.
  /// Where the proof fails, more samples are added and the program is solved again. If this does
  /// not suffice, the solution is moved toward the center, all the way if necessary. Cost: one
  /// solution of the program, and one more for each round.
  BoundedMap solved(const ConeTarget& target, const ConeSettings& settings,
                    const ConeSolution& start, const Points& cuts = {}) const;
  /// Like `solved`, but starts with a known solution of the program with these cuts.
  BoundedMap proved(const ConeTarget& target, const ConeSettings& settings, ConeSolution solution,
                    const Points& cuts = {}) const;

  /// The cuts of an earlier map, for reuse during a drag. Empty when there are too many.
  static Points cuts_of(const BoundedMap* warm) {
    constexpr size_t kMost = 60;
    return warm && warm->cuts.size() <= kMost ? warm->cuts : Points{};
  }

 private:
  /// Evaluates a solution and tries to prove its map.
  void take(ConeSolution solution, BoundedMap& map) const;
  /// Moves an unproved map toward the center, by at most the fraction `most`, until it is proved.
  void blend(double first, double most, BoundedMap& map) const;
};

}  // namespace holomorph
