// A cone program whose answer is a map, and the proof that this map keeps its bounds.
#pragma once

#include <functional>

#include "core/bounded/certificate.h"
#include "core/solvers/cone_program.h"

namespace holomorph {

/// A map that keeps bounds, how it was found, and the proof.
struct BoundedMap {
  LogMap map;
  Certificate certificate;
  ConeSolution solution;
  int rounds = 0;      ///< of added samples
  Points cuts;         ///< all samples that were added
  int iterations = 0;  ///< of all rounds
  double blend = 0;    ///< how far towards the center of the bounds it was moved, to be proved
};

/// The bound that the solutions' energies would gain most from if it were wider; none when no bound
/// is in the way.
std::optional<Bound> binding_constraint(std::initializer_list<const ConeSolution*> solutions);

/// The program at the boundary's samples, and what its unknowns mean. All references must outlive
/// this.
struct CertifiedProgram {
  const Certifier& certifier;
  const Bounds& bounds;  ///< to be proved; the program's own are a little narrower
  const ConeSystem& system;
  const VectorXd& center;  ///< feasible, and certified by all means
  std::function<LogMap(const VectorXd& x)> map_of;
  /// Adds samples at points of the boundary.
  std::function<void(const Points& points, ConeSystem& system)> append;

  /// Solves from a feasible start, with cuts that are likely to be needed. What cannot be proved is
  /// cut off by added samples, then moved towards the center, as far as that itself if need be.
  /// Cost: that of the program, and again of each round.
  BoundedMap solved(const ConeTarget& target, const ConeSettings& settings,
                    const ConeSolution& start, const Points& cuts = {}) const;
  /// The same with the solution of the program with these cuts known.
  BoundedMap proved(const ConeTarget& target, const ConeSettings& settings, ConeSolution solution,
                    const Points& cuts = {}) const;

  /// The cuts to go on with in a drag: as long as they are few.
  static Points cuts_of(const BoundedMap* warm) {
    constexpr size_t kMost = 60;
    return warm && warm->cuts.size() <= kMost ? warm->cuts : Points{};
  }
};

}  // namespace holomorph
