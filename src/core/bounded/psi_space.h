// The spaces L_psi and H of locally injective harmonic maps (Levi, Weber 2016). The first step
// finds f_z = e^l. The second step finds Psi' = conj(f_zbar), whose value at each sample lies in a
// disk.
//
// With f_z known, the positions f = Phi + conj(Psi) are linear in Psi'. This makes pins possible.
#pragma once

#include "core/bounded/bounded_space.h"
#include "core/maps/deformer.h"
#include "core/solvers/factors.h"

namespace holomorph {

/// Rows of the pins: Psi at pin i is psi.row(i) times the whitened unknowns of Psi'. The pins add a
/// term to the distance of Psi': half of `weight` times the sum of their squared distances from
/// their targets, in units of `size`.
struct PinRows {
  MatrixXc psi;
  double weight = 1000, size = 1;
};

class PsiSpace {
 public:
  /// Takes the same points and bounds as BoundedSpace. Throws Error for bounds that cannot be used.
  PsiSpace(std::shared_ptr<const BoundaryBasis> basis, const ReferencePoints& points,
           const BoundedSettings& settings, PinRows pins = {});

  /// The first step: the conformal map within the stretch bounds that is nearest to the reference's
  /// f_z, measured by settings.norm. When k > 0, the bounds are narrowed by 1 % to leave room for
  /// Psi'. The result is certified.
  BoundedMap conformal(const BoundedReference& reference, const BoundedMap* warm = nullptr) const;

  /// The second step: given l from the first step, the Psi' within the bounds that is nearest to
  /// the reference's Psi'. At the pins, Psi is pulled toward `wanted`, up to a constant common to
  /// all pins. The result is certified.
  BoundedMap nearest(const BoundedMap& conformal, const BoundedReference& reference,
                     const VectorXc& wanted, const BoundedMap* warm = nullptr) const;

  /// The nearest point in the space H, whose bounds are convex in |f_z| and Psi'. It is returned as
  /// a reference; the two steps above turn it into a map. No function of the basis has exactly the
  /// |f_z| of that point at the samples: the fit (15) of the paper leaves a residual. The second
  /// step therefore fits Psi' once more. Cost: one cone program with samples + unknowns variables.
  BoundedReference convexified(const BoundedReference& reference) const;

  /// Tries to prove that a map of this space satisfies the bounds.
  Extremes extremes(const LogMap& map) const { return conformal_.certifier().extremes(map); }
  Certificate certify(const LogMap& map) const {
    return conformal_.certifier().certify(map, settings_.bounds);
  }

 private:
  ConeTarget target_of(const BoundedReference& reference, const VectorXc& wanted) const;
  /// The disks to which the bounds restrict Psi' at samples with Re l = u, one for each bound.
  std::vector<Cone> disks(const VectorXd& u) const;
  void append_disks(const Points& points, const VectorXc& l, ConeSystem& system) const;

  std::shared_ptr<const BoundaryBasis> basis_;
  BoundedSettings settings_;
  Bounds tight_;
  BoundedSpace conformal_;
  HolomorphicDistance distance_;  ///< of Psi'
  MatrixXc pins_;                 ///< rows minus their mean, divided by the size
  double pin_weight_, size_;
  ConeSystem disks_;                ///< without the disks' radii
  ShortestLeastSquares dirichlet_;  ///< fits Re l at boundary points
};

}  // namespace holomorph
