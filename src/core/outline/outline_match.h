// The conformal or nearly conformal map that takes the outline of one shape onto another outline:
// iterative closest conformal maps (Segall, Ben-Chen 2016).
#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "core/cauchy/cauchy_array.h"
#include "core/geometry/similarity.h"
#include "core/outline/outline_start.h"
#include "core/solvers/alternating_fit.h"

namespace holomorph {

/// An outline counts as matched when the two-sided Hausdorff distance is below this fraction of its
/// diameter.
inline constexpr double kOutlineMatched = 0.01;

struct OutlineSettings {
  /// Use the published method: vertices equally spaced in arc length, no smoothing, and
  /// zeroth-order steps from an arc-length start. Otherwise, the fit starts from the conformal map
  /// between the interiors, which also determines where vertices are needed. It then takes
  /// first-order steps (eq. 13).
  bool published = false;
  int vertices = 200;        ///< approximate number; at least as many as the cage has
  double smoothness = 0.01;  ///< alpha_h: weight of mean |h^2 f''|^2
  double stiffness = 0;      ///< delta: weight of L^2 mean |f_zbar|^2; if 0, f_zbar = 0
  double pin_weight = 0.1;   ///< beta
  /// The weight of the picture's squared rotation in the choice of the start, relative to the mean
  /// square of the logarithmic stretch. People draw an outline where the picture is, but the
  /// stretch alone would map a square onto an ellipse corner first.
  double upright = 1;
  int most_iterations = 30;
};

/// The two shapes and the pins. Each shape may be clockwise or counter-clockwise.
struct OutlineTask {
  Cage source;
  Points outline;       ///< closed
  Points pins, pinned;  ///< positions at rest, and targets
};

/// f = C phi + conj(C) psi, where C are the Cauchy coordinates of `basis`; psi is empty for
/// conformal maps.
struct OutlineMatch {
  Cage basis;  ///< the source cut into more segments
  VectorXc phi, psi;
  double rms = 0;          ///< root mean square distance from the boundary's image to the outline
  double hausdorff = 0;    ///< two-sided distance between that image and the outline
  double pins_missed = 0;  ///< the largest distance of a pin's image from its target
  int pins_held = 0;       ///< number of pins held just inside because their targets are outside
  /// The number of zeros of f_z, by the argument principle, that are inside the shape and at least
  /// a thousandth of its size away from its boundary (five thousandths with stiffness). The picture
  /// folds around each zero, and each zero adds one to the turning number. Where a corner is
  /// flattened, the exact f_z is 0 at the corner itself.
  int zeros = 0;
  int iterations = 0;
  /// Energies before the first iteration and after each one, in units of L^2.
  std::vector<double> energies;
};

/// The precomputed data that do not depend on the pins' targets, and the last solution.
class OutlineFit {
 public:
  /// Throws Error when the outline has fewer than three points, has a point that is not finite,
  /// repeats a point, crosses itself or encloses no area. Cost: for 200 vertices about 50 ms.
  OutlineFit(const Cage& source, const Points& outline, const Points& pins,
             const OutlineSettings& settings);
  OutlineFit(const OutlineFit&) = delete;
  OutlineFit& operator=(const OutlineFit&) = delete;

  /// Solves from scratch for these pin targets. If the result misses the outline by more than 0.8 %
  /// of its diameter, or if f' has zeros, the conformal map itself is fitted instead, with as many
  /// vertices as necessary. If f' still has zeros and there are no pins, this is tried
  /// without keeping the picture upright. Cost for 200 vertices: 5 ms per iteration, plus 60 ms for
  /// a basis if there are pins. Fitting the conformal map takes 0.1 to 1 s.
  void solve(const Points& pinned);
  /// What a drag continues from.
  struct Checkpoint {
    Correspondence built;         ///< the correspondence for which the basis was built
    bool refined = false;         ///< whether the basis is graded
    bool sharp = false;           ///< whether the conformal start uses its finer maps
    ConformalStart::Pairs pairs;  ///< if there is a conformal start
    VectorXc unknowns;
  };
  /// The state after the last call of `solve` or `follow`.
  Checkpoint checkpoint() const;
  /// Like `solve`, but less accurate: makes at most four iterations. If there are pins, they begin
  /// at a start near that of the checkpoint; otherwise, they begin at its solution.
  void follow(const Points& pinned, const Checkpoint& from);

  const Cage& basis() const { return now_.given_basis; }
  /// How many bases have been built. Pins that move far require another basis.
  int builds() const { return builds_; }
  /// The number of iterations in the last call of `solve` or `follow`.
  int iterations() const {
    return static_cast<int>(before_.iterates.size() + now_.iterates.size()) - 1;
  }
  /// The map after this many iterations.
  OutlineMatch after(int iteration) const;

 private:
  /// The iteration ends when the relative decrease of the energy falls below this.
  static constexpr double kSettled = 1e-3;

  void solve_from(std::optional<double> upright);
  void build(const Correspondence& start);
  void begin(const Correspondence& start, const Points& wanted);
  void set_up_basis(const Correspondence& start);
  void set_up_graded_basis(const Correspondence& start);
  std::vector<double> vertex_lengths() const;
  VectorXc graded_targets() const;
  bool may_refine() const;
  bool is_matched() const;
  /// The defects of the last map: zeros, and distances as multiples of the tolerance.
  struct Misses {
    int zeros = 0;
    double outline = 0, pins = 0;
    /// At most one when the outline is matched.
    double total() const { return zeros + outline + std::max(pins - 1, 0.0); }
  };
  Misses misses() const;
  void refine();
  void follow_start(const Correspondence& start);
  struct FitRow {
    double weight;
    Index row;
    bool is_bend;  ///< whether this is a row of f'' at a midpoint or of f at a sample
  };
  void add_ridge(MatrixXc& left, VectorXc& right) const;
  VectorXd image_sizes() const;
  std::vector<FitRow> fit_rows(const VectorXd& sizes) const;
  double mean_square_miss() const;
  void set_up_samples();
  std::vector<FitTerm> terms();
  VectorXc start_targets(const Correspondence& start) const;
  /// Targets that pins can reach. A target outside the outline is moved to a point just inside,
  /// near the nearest point of the outline.
  Points held(const Points& pinned) const;
  VectorXc pin_targets(const Points& pinned) const;
  void project(const VectorXc& values, VectorXc& targets);
  void set_up_normals(const VectorXc& values, const VectorXc& targets, VectorXc& normals) const;
  void run(AlternatingFit::Mode mode, double settled, int most);

  OutlineSettings settings_;
  Cage given_;        ///< the source as given
  Similarity frame_;  ///< the source's own frame, which all members below use
  Cage cage_;
  FlatCage flat_;
  Polyline source_, target_;
  Points pins_, pinned_;
  Points loop_;     ///< just inside the source; zeros inside this loop are counted
  double unit_;     ///< L
  Complex center_;  ///< subtracted from f for the fit
  /// Null for the published method, and for strips too long for a conformal start.
  std::unique_ptr<ConformalStart> start_;
  std::vector<BoundaryPoint> samples_, middles_;
  std::vector<double> sizes_;
  std::vector<double> cut_lengths_;  ///< arc lengths of the vertices of a graded basis
  std::vector<Index> hints_;
  Correspondence built_;  ///< the correspondence for which the basis was built
  int builds_ = 0;
  bool refined_ = false;  ///< whether the basis is graded
  std::optional<AlternatingFit> fit_;
  /// A basis, and the maps found with it.
  struct Stage {
    Cage basis, given_basis;             ///< the cut source, in its own frame and as given
    MatrixXc at_samples;                 ///< C at the samples
    PlanarMatrix<double> slopes_inside;  ///< C' along `loop_`
    std::vector<VectorXc> iterates;
    std::vector<double> energies;
  };
  Stage now_;
  Stage before_;  ///< the usual fit if a graded basis has replaced it, else empty
};

/// Solves a task from scratch.
OutlineMatch matched(const OutlineTask& task, const OutlineSettings& settings);

/// Throws Error for the outlines that OutlineFit rejects.
void check_outline(std::span<const Complex> outline);

}  // namespace holomorph
