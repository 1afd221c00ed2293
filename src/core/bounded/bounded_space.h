// The space L_nu of locally injective harmonic maps (Levi, Weber 2016), and the projection of a
// reference onto it: f_z = e^l, conj(f_zbar) = nu e^l with l and nu holomorphic.
//
// The bounds on angles and stretch are convex in (Re l, nu), so the nearest map is the solution of
// a small cone program.
#pragma once

#include <memory>

#include "core/bounded/certified_program.h"
#include "core/bounded/holomorphic_distance.h"
#include "core/maps/deformer.h"

namespace holomorph {

/// A map to be projected, sampled at ReferencePoints: a continuous ln f_z on the boundary, and Psi'
/// = conj(f_zbar) and nu = Psi' / f_z at all points.
struct BoundedReference {
  VectorXc log_fz, nu, psi;
  VectorXc inner_nu, inner_psi;
};

struct BoundedSettings {
  Bounds bounds;
  /// The distance of l: either the mean of |Re| + |Im|, which is robust to jumps of 2 pi, or half
  /// the mean square.
  enum class Norm { l1, l2 } norm = Norm::l1;
  double weight = 1;  ///< weight of the distance of nu, which is half the mean square
};

/// The solver narrows the bounds by this fraction. The original bounds can then be proved.
inline constexpr double kTightening = 0.002;

class BoundedSpace {
 public:
  /// Distances are measured at `points`. Half of nu's distance is measured at the inner points, or
  /// all of it at the boundary if there are no inner points. The solver uses bounds that are 0.2 %
  /// narrower than the bounds to be proved. Throws Error for bounds that cannot be used. Cost:
  /// proportional to samples times unknowns^2.
  BoundedSpace(std::shared_ptr<const BoundaryBasis> basis, const ReferencePoints& points,
               const BoundedSettings& settings);

  /// The map of this space that is nearest to a reference, with its certificate. During drags, pass
  /// an earlier solution of this space as `warm`: the solver starts there and is less accurate.
  /// Without `warm`, the result depends on the reference alone.
  BoundedMap nearest(const BoundedReference& reference, const BoundedMap* warm = nullptr) const;

  /// Tries to prove that a map of this space satisfies the bounds.
  Extremes extremes(const LogMap& map) const { return certifier_.extremes(map); }
  Certificate certify(const LogMap& map) const { return certifier_.certify(map, settings_.bounds); }

  const BoundaryBasis& basis() const { return *basis_; }
  const Certifier& certifier() const { return certifier_; }

  /// The distance of a map from the reference: the distance of l plus `weight` times the distance
  /// of nu.
  double energy(const BoundedReference& reference, const ConeSolution& solution) const;

 private:
  void set_up_distance_of_l();
  ConeTarget target_of(const BoundedReference& reference) const;
  ConeSolution start(const BoundedMap* warm) const;
  LogMap map_of(const VectorXd& x) const;
  /// The map of this space that fits the reference best at the samples when the bounds are ignored.
  VectorXd unconstrained(const BoundedReference& reference) const;
  /// Appends the program's columns for more samples. `whitened` is the whitened basis at these
  /// samples.
  void append_samples(const MatrixXc& whitened, ConeSystem& system) const;

  std::shared_ptr<const BoundaryBasis> basis_;
  BoundedSettings settings_;
  ConeSystem system_;
  HolomorphicDistance distance_;  ///< of nu
  Certifier certifier_;
  VectorXd center_;  ///< nu = 0, l in the middle of the bounds
};

}  // namespace holomorph
