// The conformal or nearly conformal map that takes one shape's outline onto another one: iterative
// closest conformal maps (Segall, Ben-Chen 2016).
#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "core/cauchy/cauchy_array.h"
#include "core/geometry/similarity.h"
#include "core/outline/outline_start.h"
#include "core/solvers/alternating_fit.h"

namespace holomorph {

/// An outline is met when the two-sided Hausdorff distance is below this share of its diameter.
inline constexpr double kOutlineMet = 0.01;

struct OutlineSettings {
  /// The published method: vertices at equal arc lengths, no smoothing, zeroth-order steps from an
  /// arc-length start. Otherwise: vertices where the conformal map of the insides needs them, which
  /// is the start, too, and steps of the first order.
  bool published = false;
  int vertices = 200;        ///< about so many along the outline, more when the cage has more
  double smoothness = 0.01;  ///< alpha_h: weight of mean |h^2 f''|^2
  double stiffness = 0;      ///< delta: weight of L^2 mean |f_zbar|^2; 0: f_zbar = 0
  double pin_weight = 0.1;   ///< beta
  /// How much turning the picture counts in the start, against mean squares of ln of the stretch.
  double upright = 1;
  int most_iterations = 30;
};

/// Shapes and places; all of them may be of either orientation.
struct OutlineTask {
  Cage source;
  Points outline;       ///< closed
  Points pins, pinned;  ///< at rest and wanted
};

/// f = C phi + conj(C) psi, with C over the basis; psi is empty for conformal maps.
struct OutlineMatch {
  Cage basis;  ///< the source cut into more segments
  VectorXc phi, psi;
  double rms = 0;          ///< of the source boundary's distances from the outline
  double hausdorff = 0;    ///< the largest distance either way
  double pins_missed = 0;  ///< the largest distance of a pin from where it was wanted
  int pins_held = 0;       ///< that were wanted outside of the outline, and are held just inside
  /// The number of zeros of f_z, by the argument principle, at least a thousandth of the shape's
  /// size inside (five thousandths with stiffness). The picture folds around each zero, and each
  /// adds one to the turning number. Where a corner is flattened, the exact f_z is 0 at the corner
  /// itself.
  int zeros = 0;
  int iterations = 0;
  std::vector<double>
      energies;  ///< after each iteration, the first one before any; in units of L^2
};

/// What does not depend on where pins are wanted, and the last solution.
class OutlineFit {
 public:
  /// Throws Error when the outline is open, crosses itself, encloses nothing or has less than three
  /// points. Cost: for 200 vertices about 50 ms.
  OutlineFit(const Cage& source, const Points& outline, const Points& pins,
             const OutlineSettings& settings);
  OutlineFit(const OutlineFit&) = delete;
  OutlineFit& operator=(const OutlineFit&) = delete;

  /// Cost: for 200 vertices 5 ms an iteration, and 60 ms for a basis where there are pins. Where
  /// the outline is not met (by 0.8 % of its diameter), or f' has zeros, the conformal map itself
  /// is followed with as many vertices as it needs: 0.1 to 1 s.
  void solve(const Points& pinned);
  /// The same, roughly: four iterations at most, from a start near the last one where there are
  /// pins, else from the last solution.
  void follow(const Points& pinned);

  const Cage& basis() const { return now_.given_basis; }
  /// How many bases there have been: pins that go far need another one.
  int builds() const { return builds_; }
  /// How many iterations the last call made.
  int iterations() const {
    return static_cast<int>(before_.iterates.size() + now_.iterates.size()) - 1;
  }
  /// The map after so many of them.
  OutlineMatch after(int iteration) const;

 private:
  /// Relative decrease of the energy that ends the iteration.
  static constexpr double kSettled = 1e-3;

  void build(const Correspondence& start);
  void begin(const Correspondence& start, const Points& wanted);
  void set_up_basis(const Correspondence& start);
  void set_up_graded_basis(const Correspondence& start);
  std::vector<double> vertex_lengths() const;
  VectorXc graded_targets() const;
  bool may_refine() const;
  bool is_met() const;
  /// How badly the last map serves: zeros, and distances in multiples of what is accepted.
  struct Misses {
    int zeros = 0;
    double outline = 0, pins = 0;
    /// One at most when the outline is met.
    double total() const { return zeros + outline + std::max(pins - 1, 0.0); }
  };
  Misses misses() const;
  void refine();
  void follow_start(const Correspondence& start);
  struct FitRow {
    double weight;
    Index row;
    bool is_bend;  ///< of f'' at a middle, else of f at a sample
  };
  void add_ridge(MatrixXc& left, VectorXc& right) const;
  VectorXd image_sizes() const;
  std::vector<FitRow> fit_rows(const VectorXd& sizes) const;
  double mean_square_miss() const;
  void set_up_samples();
  std::vector<FitTerm> terms();
  VectorXc start_targets(const Correspondence& start) const;
  /// Where pins can be: those wanted outside are just inside of the nearest place.
  Points held(const Points& pinned) const;
  VectorXc pin_targets(const Points& pinned) const;
  void project(const VectorXc& values, VectorXc& targets);
  void set_up_normals(const VectorXc& values, const VectorXc& targets, VectorXc& normals) const;
  void run(AlternatingFit::Mode mode, double settled, int most);

  OutlineSettings settings_;
  Cage given_;        ///< the source where it stands
  Similarity frame_;  ///< of the source's own; all that follows is in it
  Cage cage_;
  FlatCage flat_;
  Polyline source_, target_;
  Points pins_, pinned_;
  Points loop_;     ///< just inside the source, where zeros are counted
  double unit_;     ///< L
  Complex center_;  ///< what is fitted is f less this
  /// None for the published method, and for strips too long for it.
  std::unique_ptr<ConformalStart> start_;
  std::vector<BoundaryPoint> samples_, middles_;
  std::vector<double> sizes_;
  std::vector<double> cut_lengths_;  ///< of a graded basis' vertices
  std::vector<Index> hints_;
  Correspondence built_;  ///< what the basis was made for
  int builds_ = 0;
  bool refined_ = false;  ///< whether the basis is the graded one
  std::optional<AlternatingFit> fit_;
  /// A basis and the maps over it that have been found.
  struct Stage {
    Cage basis, given_basis;             ///< the source's cut self, in its own frame and as given
    MatrixXc at_samples;                 ///< C at the samples
    PlanarMatrix<double> slopes_inside;  ///< C' along the loop inside
    std::vector<VectorXc> iterates;
    std::vector<double> energies;
  };
  Stage now_;
  Stage before_;  ///< the usual fit, when another basis has replaced it; else empty
};

/// Solved from nothing.
OutlineMatch matched(const OutlineTask& task, const OutlineSettings& settings);

/// What OutlineFit would refuse an outline for.
void check_outline(std::span<const Complex> outline);

}  // namespace holomorph
