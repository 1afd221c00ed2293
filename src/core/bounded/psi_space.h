// The spaces L_psi and H of locally injective harmonic maps (Levi, Weber 2016). The first step
// finds f_z = e^l, the second Psi' = conj(f_zbar), which lies in a disk at each sample.
//
// With f_z known, the positions f = Phi + conj(Psi) are linear in Psi'. This makes pins possible.
#pragma once

#include "core/bounded/bounded_space.h"

namespace holomorph {

/// Rows of the pins: Psi at pin i = psi.row(i) . the whitened unknowns of Psi'. Half of `weight`
/// times the sum of the squared distances of the pins, in units of `size`, is added to the distance
/// of Psi'.
struct PinRows {
  MatrixXc psi;
  double weight = 1000, size = 1;
};

class PsiSpace {
 public:
  /// Takes the same points and bounds as BoundedSpace. Throws Error for bounds that cannot be used.
  PsiSpace(std::shared_ptr<const BoundaryBasis> basis, const ReferencePoints& points,
           const BoundedSettings& settings, PinRows pins = {});

  /// The first step: the conformal map nearest to the reference's f_z, by settings.norm, within the
  /// stretch bounds. When k > 0, these are narrowed by 1 % to leave room for Psi'. Certified.
  BoundedMap conformal(const BoundedReference& reference, const BoundedMap* warm = nullptr) const;

  /// The second step: with l from the first step, the Psi' within the bounds that is nearest to the
  /// reference's, with Psi near `wanted` at the pins up to one constant for all. Certified.
  BoundedMap nearest(const BoundedMap& conformal, const BoundedReference& reference,
                     const VectorXc& wanted, const BoundedMap* warm = nullptr) const;

  /// The nearest point in H, where the bounds are convex in |f_z| and Psi', as a reference for
  /// which the two steps above give the map of H. No function of the basis has exactly these |f_z|
  /// at the samples (the fit (15) of the paper leaves a residual), so the second step fits Psi'
  /// once more. Cost: a program of samples + unknowns.
  BoundedReference convexified(const BoundedReference& reference) const;

  /// Tries to prove that a map of this space keeps the bounds.
  Certificate certify(const LogMap& map) const {
    return conformal_.certifier().certify(map, settings_.bounds);
  }

 private:
  ConeTarget target_of(const BoundedReference& reference, const VectorXc& wanted) const;
  /// The disks that contain Psi' at samples where Re l = u, one for each bound.
  std::vector<Cone> disks(const VectorXd& u) const;
  void append_disks(const Points& points, const VectorXc& l, ConeSystem& system) const;

  std::shared_ptr<const BoundaryBasis> basis_;
  BoundedSettings settings_;
  Bounds tight_;
  BoundedSpace conformal_;
  HolomorphicDistance distance_;  ///< of Psi'
  MatrixXc pins_;                 ///< rows minus their mean, divided by the size
  double pin_weight_, size_;
  ConeSystem disks_;                                            ///< without the disks' radii
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> dirichlet_;  ///< fits Re l at boundary points
};

}  // namespace holomorph
