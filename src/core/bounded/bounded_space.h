// The space L_nu of locally injective harmonic maps (Levi, Weber 2016), and the nearest of its maps
// to a reference: f_z = e^l, conj(f_zbar) = nu e^l with l and nu holomorphic.
//
// The bounds on angles and stretch are convex in (Re l, nu), so that the nearest map is the
// solution of a small cone program.
#pragma once

#include <memory>

#include "core/bounded/certified_program.h"
#include "core/bounded/holomorphic_distance.h"

namespace holomorph {

/// A map to be projected at those points: ln f_z, continuous, on the boundary; and Psi' =
/// conj(f_zbar) and nu = Psi' / f_z everywhere.
struct BoundedReference {
  VectorXc log_fz, nu, psi;
  VectorXc inner_nu, inner_psi;
};

struct BoundedSettings {
  Bounds bounds;
  /// Of l's distance: mean of |Re| + |Im|, which forgives jumps of 2 pi, or half the mean square.
  enum class Norm { l1, l2 } norm = Norm::l1;
  double weight = 1;  ///< of nu's distance, half the mean square
};

/// By how much bounds are narrowed where they are solved, so that they can be proved.
inline constexpr double kTightening = 0.002;

class BoundedSpace {
 public:
  /// Distances count at the points, nu's inside by half; without inner points at the boundary's
  /// alone. The bounds are solved 0.2 % narrower than they are proved. Throws Error
  /// for bounds that cannot be used. Cost: a product of unknowns^2 and samples.
  BoundedSpace(std::shared_ptr<const BoundaryBasis> basis, const ReferencePoints& points,
               const BoundedSettings& settings);

  /// Projects. With `warm`, a solution of this space, the work starts from there and is less
  /// exact: for dragging; without, the result depends on the reference alone. It is certified.
  BoundedMap nearest(const BoundedReference& reference, const BoundedMap* warm = nullptr) const;

  /// Tries to prove the bounds for a map of this space.
  Certificate certify(const LogMap& map) const { return certifier_.certify(map, settings_.bounds); }

  const BoundaryBasis& basis() const { return *basis_; }
  const Certifier& certifier() const { return certifier_; }

  /// The distance of a map from the reference: l's plus weight times nu's.
  double energy(const BoundedReference& reference, const ConeSolution& solution) const;

 private:
  void set_up_distance_of_l();
  ConeTarget target_of(const BoundedReference& reference) const;
  ConeSolution start(const BoundedMap* warm) const;
  LogMap map_of(const VectorXd& x) const;
  /// The space's best fit to the reference at the samples, whatever the bounds.
  VectorXd unconstrained(const BoundedReference& reference) const;
  /// The program's columns for points whose C these are.
  void append_samples(const MatrixXc& whitened, ConeSystem& system) const;

  std::shared_ptr<const BoundaryBasis> basis_;
  BoundedSettings settings_;
  ConeSystem system_;
  HolomorphicDistance distance_;  ///< of nu
  Certifier certifier_;
  VectorXd center_;  ///< nu = 0, l in the middle of the bounds
};

}  // namespace holomorph
