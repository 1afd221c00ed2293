// Least squares whose targets move: the best map for given targets, the nearest targets for a given
// map, in turn (Segall, Ben-Chen 2016, alg. 1).
//
// All terms are weighted means of |rows . x - target|^2; each says what its targets are for the
// values that the map has now. Rows are factored once (Householder QR: their condition grows with
// the square of the unknowns), so that an iteration is two matrix-vector products.
#pragma once

#include <functional>

#include "core/types.h"

namespace holomorph {

/// weight * mean |rows x - targets|^2.
struct FitTerm {
  MatrixXc rows;
  double weight = 1;
  /// Targets for the present values of the rows. A fixed term ignores the values.
  std::function<void(const VectorXc& values, VectorXc& targets)> project = {};
  /// Whether `normals` are known: unit vectors from the target, across the curve it lies on.
  std::function<void(const VectorXc& values, const VectorXc& targets, VectorXc& normals)> normals =
      {};
};

class AlternatingFit {
 public:
  enum class Mode { zeroth, anderson, first_order };

  /// Cost: a QR factorisation of all rows. There must be as many rows as unknowns at least, of full
  /// rank (a check).
  explicit AlternatingFit(std::vector<FitTerm> terms);

  /// Starts from the map that is best for these targets of the first term and those that the others
  /// have for the values 0.
  void start(const VectorXc& first_targets);
  /// One iteration. A step that raises the energy is taken back and done in a simpler mode: first
  /// order and Anderson's steps fall back to the zeroth order, which never raises it. Cost: two
  /// products of rows x unknowns; first order, (2 unknowns)^2 rows and a Cholesky factorisation.
  void step(Mode mode);

  double energy() const { return energy_; }
  VectorXc unknowns() const;
  /// Root of the mean square distance of a term's values from its targets.
  double distance(size_t term) const;
  const VectorXc& values(size_t term) const { return values_[term]; }
  const VectorXc& targets(size_t term) const { return targets_[term]; }

 private:
  struct Memory {
    std::vector<VectorXc> g, change;  ///< Anderson's last iterates and their steps
  };

  void evaluate(const VectorXc& g);
  VectorXc zeroth() const;
  VectorXc anderson();
  VectorXc first_order() const;

  std::vector<FitTerm> terms_;
  std::vector<Index> first_;   ///< row of each term
  std::vector<double> scale_;  ///< root of weight / rows of each term
  MatrixXc q_, r_;             ///< of all scaled rows, r_ upper triangular
  VectorXc g_;                 ///< R x
  std::vector<VectorXc> values_, targets_;
  double energy_ = 0;
  Memory memory_;
};

}  // namespace holomorph
