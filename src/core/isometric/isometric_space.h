// Maps of least isometric energy: f_z = e^l, conj(f_zbar) = nu e^l with l and nu in a basis, |nu| <
// 1 everywhere, and pins.
//
// Every map is certified: |nu| < 1 is proved on the boundary, and therefore inside. e^l has no
// zeros. The map does not fold.
#pragma once

#include <memory>

#include "core/bounded/certificate.h"
#include "core/isometric/isometric_program.h"
#include "core/mesh/area_samples.h"

namespace holomorph {

/// Points whose images are prescribed, and points where l and nu = 0 are prescribed.
struct IsometricHandles {
  Points stations;         ///< inside the domain
  Index turned = 0;        ///< how many of the stations, the first ones, have turns
  VectorXd weights;        ///< one for each station
  Points frames;           ///< inside the domain
  VectorXd frame_weights;  ///< one for each frame
};

/// A map, how it was found, and the proof that it does not fold.
struct IsometricMap {
  LogMap map;
  IsometricSolution solution;
  Certificate certificate;
  VectorXd turns;  ///< Im l at the stations, in radians, unwrapped
  /// The program that was solved. It has more samples than usual if the proof needed them.
  std::shared_ptr<const IsometricSystem> system;
};

class IsometricSpace {
 public:
  /// The factors by which energies are multiplied at the samples: of the boundary's samples, then
  /// of the inner samples. Empty: 1.
  using Stiffness = VectorXd;

  /// The mesh must belong to the basis' domain. The boundary and the inner samples, which are
  /// vertices of the mesh, contribute half of the energy each. Without inner samples, the energy is
  /// measured at the boundary alone. Cost: (nodes + samples) n^2 for n polygon vertices.
  IsometricSpace(std::shared_ptr<const BoundaryBasis> basis, const Mesh& mesh,
                 IsometricHandles handles, const std::vector<AreaSample>& inner,
                 const Stiffness& stiffness, IsometricEnergy energy);

  struct Settings {
    double pin_weight = 1e5;  ///< penalty of a squared miss, in units of the domain's diagonal
    bool exact = false;       ///< meet the stations exactly in final answers
    std::stop_token stop = {};
  };

  /// The final answer. If the turns of the first stations are known (in radians, one for each of
  /// IsometricHandles::turned), the start has these turns; which of several minima is found depends
  /// on them. Otherwise, or if no drag can have left such turns, the start is the best rotation of
  /// all stations. The result depends on the arguments alone. Cost: 6 to 20 iterations of
  /// `minimized`, up to 200 for poses that cannot be reached.
  IsometricMap solved(const IsometricTarget& target, const Settings& settings,
                      const VectorXd& turns = {}) const;
  /// A draft: a few steps from an earlier map of this space.
  IsometricMap followed(const IsometricTarget& target, const Settings& settings,
                        const IsometricMap& from) const;

  const IsometricSystem& system() const { return *system_; }
  /// The proved extremes of a certified map.
  Extremes extremes(const LogMap& map) const { return certifier_.extremes(map); }
  /// Tries to prove that |nu| < 1.
  Certificate certify(const LogMap& map) const;

 private:
  double penalty(const Settings& settings) const;
  VectorXd start(const VectorXd& turns) const;
  VectorXd rotated(const IsometricTarget& target) const;
  double conformal_energy(const VectorXd& x) const;
  LogMap map_of(const VectorXd& x) const;
  std::shared_ptr<const IsometricSystem> with_samples(const IsometricSystem& system,
                                                      const Points& points) const;
  void prove(IsometricMap& map) const;
  void retreat(const VectorXd& certified, IsometricMap& map) const;
  void finish(const IsometricTarget& target, IsometricMap& map) const;

  std::shared_ptr<const BoundaryBasis> basis_;
  IsometricHandles handles_;
  double size_;
  Certifier certifier_;
  std::shared_ptr<const IsometricSystem> system_;
  MatrixXc at_stations_;  ///< the whitened basis
  Cholesky from_turns_;
};

}  // namespace holomorph
