// Least squares whose targets move: the best map for given targets, the nearest targets for a given
// map, in turn (Segall, Ben-Chen 2016, alg. 1).
//
// All terms are weighted means of |rows . x - target|^2. Targets of some terms follow from the
// values that the map has now; those of the others are given. Rows are factored once (Householder
// QR: their condition grows with the square of the unknowns), so that an iteration is two products
// with the rows whose targets move.
#pragma once

#include <functional>

#include "core/types.h"

namespace holomorph {

/// weight * mean |rows x - targets|^2.
struct FitTerm {
  MatrixXc rows;
  double weight = 1;
  /// Targets for the present values of the rows; none: they are given, and 0 until then.
  std::function<void(const VectorXc& values, VectorXc& targets)> project = {};
  /// Unit vectors across the curve that the targets lie on, for terms whose targets may slide.
  std::function<void(const VectorXc& values, const VectorXc& targets, VectorXc& normals)> normals =
      {};
};

class AlternatingFit {
 public:
  enum class Mode { zeroth, anderson, first_order };

  /// Cost: a QR factorisation of all rows. There must be as many rows as unknowns at least (a
  /// check), of full rank (not checked).
  explicit AlternatingFit(std::vector<FitTerm> terms);

  /// How the targets of a term that was made with `project` follow from its values from now on.
  void project_by(size_t term, decltype(FitTerm::project) project) {
    terms_[term].project = std::move(project);
  }
  /// Gives a term's targets. `start` comes before the next step.
  void give(size_t term, const VectorXc& targets);
  /// Starts from the map that is best for these targets of the first term. Other terms whose
  /// targets move have those of the last map, or of `unknowns` = 0 when there is none.
  void start(const VectorXc& first_targets);
  /// Forgets the last map, or puts another one in its place.
  void reset();
  void reset(const VectorXc& unknowns);
  /// One iteration. A step that raises the energy is taken back and done in a simpler mode: first
  /// order and Anderson's steps fall back to the zeroth order, which never raises it. Cost: two
  /// products of moving rows x unknowns; first order, (2 unknowns)^2 rows and a Cholesky
  /// factorisation.
  void step(Mode mode);
  /// Goes on from the last map with targets that were given anew.
  void resume();
  /// Steps until one lowers the energy by less than this share of it, `most` at most; `see` is
  /// called before the first one and after each. Returns the number of steps.
  int run(
      Mode mode, double settled, int most, const std::function<void()>& see = [] {});

  double energy() const { return energy_; }
  VectorXc unknowns() const;
  /// Root of the mean square distance of a moving term's values from its targets.
  double distance(size_t term) const;

 private:
  struct Term {
    MatrixXc q;        ///< its rows of Q
    double scale = 1;  ///< root of weight / rows
    decltype(FitTerm::project) project;
    decltype(FitTerm::normals) normals;
    VectorXc values, targets;
  };
  struct Memory {
    std::vector<VectorXc> g, change;  ///< Anderson's last iterates and their steps
  };

  void evaluate(const VectorXc& g);
  VectorXc zeroth() const;
  VectorXc anderson();
  VectorXc first_order() const;

  std::vector<Term> terms_;
  MatrixXc r_;           ///< upper triangular: all scaled rows are Q R
  VectorXc given_;       ///< Q* of the scaled targets that are given
  double given_square_;  ///< their square
  VectorXc g_;           ///< R x
  double energy_ = 0;
  Memory memory_;
};

}  // namespace holomorph
