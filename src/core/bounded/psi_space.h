// The spaces L_psi and H of locally injective harmonic maps (Levi, Weber 2016): first f_z = e^l,
// then Psi' = conj(f_zbar) in a disc at each sample.
//
// With f_z known, places f = Phi + conj(Psi) are linear in Psi': so pins can be asked for.
#pragma once

#include "core/bounded/bounded_space.h"

namespace holomorph {

/// Pins by their rows: Psi at pin i = psi.row(i) . the whitened unknowns of Psi'. Half of weight
/// times the squares of their distances, in units of size, is added to the distance of Psi'.
struct PinRows {
  MatrixXc psi;
  double weight = 1000, size = 1;
};

class PsiSpace {
 public:
  /// As BoundedSpace, for the same points and bounds. Throws Error for bounds that cannot be used.
  PsiSpace(std::shared_ptr<const BoundaryBasis> basis, const ReferencePoints& points,
           const BoundedSettings& settings, PinRows pins = {});

  /// The first step: the conformal map nearest to the reference's f_z, by settings.norm, within the
  /// bounds on stretch, and 1 % narrower ones when k > 0: some room is left for Psi'. Certified.
  BoundedMap conformal(const BoundedReference& reference, const BoundedMap* warm = nullptr) const;

  /// The second step: with the first one's l, the Psi' within the bounds that is nearest to the
  /// reference's and Psi nearest to `wanted` at the pins, up to one constant for all. Certified.
  BoundedMap nearest(const BoundedMap& conformal, const BoundedReference& reference,
                     const VectorXc& wanted, const BoundedMap* warm = nullptr) const;

  /// What is nearest in H, where the bounds are convex in |f_z| and Psi': a reference whose two
  /// steps above give the map of H. |f_z| at samples is no exact boundary value of a function of
  /// the basis, therefore Psi' is fitted once more, by the second step. Cost: a program of samples
  /// + unknowns.
  BoundedReference convexified(const BoundedReference& reference) const;

  /// Tries to prove the bounds for a map of this space.
  Certificate certify(const LogMap& map) const {
    return conformal_.certifier().certify(map, settings_.bounds);
  }

 private:
  ConeTarget target_of(const BoundedReference& reference, const VectorXc& wanted) const;
  /// The discs of Psi' where these are Re l, one for each bound.
  std::vector<Cone> discs(const VectorXd& u) const;
  void append_discs(const Points& points, const VectorXc& l, ConeSystem& system) const;

  std::shared_ptr<const BoundaryBasis> basis_;
  BoundedSettings settings_;
  Bounds tight_;
  BoundedSpace conformal_;
  HolomorphicDistance distance_;  ///< of Psi'
  MatrixXc pins_;                 ///< rows less their mean, over the size
  double pin_weight_, size_;
  ConeSystem discs_;                                            ///< but for their radii
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> dirichlet_;  ///< of Re l at boundary points
};

}  // namespace holomorph
