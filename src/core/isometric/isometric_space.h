// Maps of least isometric energy: f_z = e^l, conj(f_zbar) = nu e^l with l and nu in a basis, |nu| <
// 1 everywhere, and pins.
//
// Every map is certified: |nu| < 1 is proved on the boundary, and therefore inside. e^l has no
// zeros. The map does not fold. If there are bounds on the distortion, they are proved, too.
#pragma once

#include <memory>
#include <optional>

#include "core/bounded/certificate.h"
#include "core/isometric/isometric_program.h"
#include "core/maps/deformer.h"
#include "core/mesh/area_samples.h"
#include "core/mesh/hole_loops.h"

namespace holomorph {

/// Points whose images are prescribed, and points where l and nu = 0 are prescribed.
struct IsometricHandles {
  Points stations;         ///< inside the domain
  Index turned = 0;        ///< how many of the stations, the first ones, have turns
  VectorXd weights;        ///< one for each station
  Points frames;           ///< inside the domain
  VectorXd frame_weights;  ///< one for each frame
};

/// Im l at stations, in radians, unwrapped. Any may be unknown.
using Turns = std::vector<std::optional<double>>;

/// A map, how it was found, and the proof that it does not fold.
struct IsometricMap {
  LogMap map;
  IsometricSolution solution;
  Certificate certificate;
  Turns turns;         ///< of the stations that have turns; all known
  VectorXc target;     ///< of the stations
  double barrier = 0;  ///< its weight relative to the value without it, if there are bounds
  /// The program that was solved. It has more samples than usual if the proof needed them.
  std::shared_ptr<const IsometricSystem> system;
};

class IsometricSpace {
 public:
  /// What the energy at each sample is multiplied by: first at the boundary's samples, then at the
  /// inner ones. Empty: 1 everywhere.
  using Stiffness = VectorXd;

  /// The mesh must belong to the basis' domain. The boundary and the inner samples, which are
  /// vertices of the mesh, contribute half of the energy each. Without inner samples, the energy is
  /// measured at the boundary alone. If there are bounds, all maps stay within them; throws Error
  /// unless they are usable and k > 0. Cost: (nodes + samples) n^2 for n polygon vertices.
  IsometricSpace(std::shared_ptr<const BoundaryBasis> basis, const Mesh& mesh,
                 IsometricHandles handles, const std::vector<AreaSample>& inner,
                 const Stiffness& stiffness, IsometricEnergy energy,
                 const std::optional<Bounds>& bounds = {});

  struct Settings {
    double pin_weight = 1e5;  ///< penalty of a squared miss, in units of the domain's diagonal
    bool exact = false;       ///< meet the stations exactly in final answers
    bool estimates = false;   ///< end early: only the energy of a final answer is of interest
    std::stop_token stop = {};
  };

  /// The final answer. There is one turn for each of IsometricHandles::turned, or none. If turns
  /// are known, the start has these turns; which of several minima is found depends on them.
  /// Otherwise, or if no drag can have left such turns, the start is the best rotation of all
  /// stations. The result depends on the arguments alone. Cost: 6 to 20 iterations of `minimized`,
  /// up to 200 for poses that cannot be reached. That is repeated up to 8 times if the stations
  /// must be met exactly, and up to 6 times if the proof needs more samples.
  IsometricMap solved(const IsometricTarget& target, const Settings& settings,
                      const Turns& turns = {}) const;
  /// A draft: a few steps from an earlier map of this space.
  IsometricMap followed(const IsometricTarget& target, const Settings& settings,
                        const IsometricMap& from) const;

  const IsometricSystem& system() const { return *system_; }
  /// The paths to which a solution's gaps belong.
  const HoleLoops& loops() const { return loops_; }
  /// The proved extremes of a certified map, which are within the bounds.
  Extremes extremes(const LogMap& map) const;
  /// Tries to prove that |nu| < 1, and the bounds if there are any.
  Certificate certify(const LogMap& map) const;

 private:
  double penalty(const Settings& settings) const;
  VectorXd start(const Turns& turns) const;
  VectorXd rotated(const IsometricTarget& target) const;
  double conformal_energy(const VectorXd& x) const;
  LogMap map_of(const VectorXd& x) const;
  std::shared_ptr<const IsometricSystem> with_samples(const IsometricSystem& system,
                                                      const Points& points) const;
  VectorXd moved_inside(const IsometricSystem& system, VectorXd x) const;
  double draft_barrier(const IsometricTarget& target, const IsometricMap& from) const;
  VectorXd center(const VectorXd& x) const;
  double free_value(const IsometricSystem& system, const IsometricTarget& target,
                    IsometricSettings settings, const VectorXd& x) const;
  IsometricSolution within(const IsometricSystem& system, const IsometricTarget& target,
                           IsometricSettings steps, VectorXd x, double barrier) const;
  void prove(const IsometricTarget& target, IsometricMap& map) const;
  void retreat(const IsometricTarget& target, const VectorXd& certified, IsometricMap& map) const;
  void finish(const IsometricTarget& target, IsometricMap& map) const;

  std::shared_ptr<const BoundaryBasis> basis_;
  IsometricHandles handles_;
  std::optional<Bounds> bounds_;
  double size_;
  Certifier certifier_;
  HoleLoops loops_;
  std::shared_ptr<const IsometricSystem> system_;
  MatrixXc at_stations_;  ///< the whitened basis
  MatrixXd normal_;       ///< of mean u^2 in l, with a ridge; its lower triangle
};

}  // namespace holomorph
