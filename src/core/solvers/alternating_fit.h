// Least squares with moving targets: alternates between the best map for given targets and the
// nearest targets for a given map (Segall, Ben-Chen 2016, alg. 1).
//
// Each term is a weighted mean of |rows . x - target|^2. Some terms compute their targets from the
// current values of the map (moving targets). The other terms have given targets. The rows are
// factored once. Householder QR is used because the condition number of the rows grows with the
// square of the number of unknowns. Each iteration then takes only two products with the rows that
// have moving targets. The energy of the other rows follows, because |Q g| = |g| for orthonormal Q.
#pragma once

#include <functional>

#include "core/types.h"

namespace holomorph {

/// weight * mean |rows x - targets|^2.
struct FitTerm {
  MatrixXc rows;
  double weight = 1;
  /// Computes moving targets from the current values rows x. If empty, the targets are given by
  /// set_targets and are 0 before the first call.
  std::function<void(const VectorXc& values, VectorXc& targets)> project = {};
  /// Computes unit normals of the target curve, one at each target. Only for terms whose targets
  /// may slide along a curve.
  std::function<void(const VectorXc& values, const VectorXc& targets, VectorXc& normals)> normals =
      {};
};

class AlternatingFit {
 public:
  enum class Mode { zeroth, anderson, first_order };

  /// There must be at least as many rows as unknowns (checked), and the rows must have full rank
  /// (not checked). Cost: a QR factorization of all rows.
  explicit AlternatingFit(std::vector<FitTerm> terms);

  /// Replaces the `project` function of a term that was constructed with one.
  void set_projection(size_t term, decltype(FitTerm::project) project) {
    terms_[term].project = std::move(project);
  }
  /// Sets the targets of a term. Call `start` or `resume` before the next step.
  void set_targets(size_t term, const VectorXc& targets);
  /// Starts from the map that best fits these targets of the first term. The other moving targets
  /// are computed from the last map or, if there is none, from zero unknowns.
  void start(const VectorXc& first_targets);
  /// Forgets the last map, or replaces it by the given one.
  void reset();
  void reset(const VectorXc& unknowns);
  /// One iteration. If a first-order or Anderson step raises the energy, it is undone and replaced
  /// by a zeroth-order step, which never raises it. Cost: two products of moving rows x unknowns; a
  /// first-order step also costs (2 unknowns)^2 x rows and a Cholesky factorization.
  void step(Mode mode);
  /// Continues from the last map after given targets have changed.
  void resume();
  /// Repeats `step` until one step lowers the energy by at most the fraction `settled`, but takes
  /// at most `most` steps. Calls `see` before the first step and after each one. Returns the number
  /// of steps.
  int run(
      Mode mode, double settled, int most, const std::function<void()>& see = [] {});

  double energy() const { return energy_; }
  VectorXc unknowns() const;
  /// Root mean square distance between the values and the targets of a term with moving targets.
  double distance(size_t term) const;

 private:
  struct Term {
    MatrixXc q;        ///< the term's rows of Q
    double scale = 1;  ///< square root of weight / number of rows
    decltype(FitTerm::project) project;
    decltype(FitTerm::normals) normals;
    VectorXc values, targets;
  };
  struct Memory {
    std::vector<VectorXc> g, change;  ///< the last iterates and their steps, for Anderson's method
  };

  void evaluate(const VectorXc& g);
  VectorXc zeroth() const;
  VectorXc anderson();
  VectorXc first_order() const;

  std::vector<Term> terms_;
  MatrixXc r_;           ///< upper triangular; the scaled rows of all terms are Q R
  VectorXc given_;       ///< Q* times the scaled given targets
  double given_square_;  ///< squared norm of the scaled given targets
  VectorXc g_;           ///< R x
  double energy_ = 0;
  Memory memory_;
};

}  // namespace holomorph
