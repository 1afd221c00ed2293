// Maps between two maps without folds, which do not fold either.
//
// With l and nu of both keys blended by the same convex weights, |nu| and the smallest stretch stay
// within the bounds of the keys, because they are convex. Smooth motion is a Bezier curve whose
// inner points are certified, so all of its points are. Then the smallest change keeps those
// stations still that both keys hold, and closes holes. If it does not certify, the smallest change
// within the keys' extremes is tried, and then smaller changes, which still close holes.
#pragma once

#include <array>
#include <optional>

#include "core/bounded/certificate.h"
#include "core/bounded/map_on_mesh.h"
#include "core/bounded/path_integral.h"
#include "core/bounded/tree_integrals.h"
#include "core/maps/deformer.h"
#include "core/mesh/hole_loops.h"
#include "core/mesh/locator.h"

namespace holomorph {

/// Blends maps of one basis. Threads: const functions may run at the same time.
class LogInbetween {
 public:
  /// `stations` are points in the domain that keys may hold.
  LogInbetween(std::shared_ptr<const BoundaryBasis> basis, std::shared_ptr<const Mesh> mesh,
               const Points& stations);

  /// A certified key: its map with a continuous argument, the proved extremes of its distortion,
  /// and f at the mesh's vertices.
  struct Key {
    LogMap map;
    Extremes extremes;
    VectorXc f;
    double time = 0;
  };
  /// The mean of Im l over the mesh's vertices: the average rotation of the picture.
  double mean_argument(const LogMap& map) const { return on_mesh_.function(map.l).imag().mean(); }

  /// Stations that both keys hold stay within this fraction of the size of the straight line from
  /// their place in one key to their place in the other, unless the frame has a `slide`.
  static constexpr double kStill = 1e-4;
  /// By how much the largest size may grow between keys. Without corrections, it is 6 % at most.
  static constexpr double kGrowth = 0.3;
  /// By how much stations that both keys hold leave their places halfway without a correction, at
  /// most. It shows whether the whole turns between the keys are the right ones.
  double slide(const Key& from, const Key& to, const std::vector<char>& held) const;

  /// The map between two keys.
  struct Blend {
    VectorXc f;
    Derivatives first;  ///< at the mesh's vertices
    /// Whether it is proved that |nu| and the smallest size stay within 1 % of the keys' extremes,
    /// and that the largest size exceeds both by at most kGrowth.
    bool certified = false;
    /// If both keys are in the space L_nu: the map, up to a constant, and its extremes, if they are
    /// measured.
    std::optional<LogMap> map;
    std::optional<Extremes> extremes;
    /// The station that is farthest from its place although both keys hold it, and its distance
    /// from there, if that is more than kStill of the size: no larger correction could be proved.
    struct Slide {
      Index station;
      double distance;
    };
    std::optional<Slide> slide;
    /// By how much f jumped before the jumps were spread over the picture; 0 without holes.
    double gap = 0;
  };

 private:
  /// The sum of weighted maps, and a change in L_nu.
  struct Sum {
    std::vector<std::pair<double, const LogMap*>> terms;
    LogMap change;
  };
  /// Combinations of integrals, and what they should be.
  struct Kept {
    MatrixXd combinations;
    VectorXc targets;
  };

 public:
  /// The motion from one key to the next. The keys must outlive it.
  class Interval {
   public:
    /// The map at the fraction u of the time, 0 < u < 1, with or without `extremes`. Cost: usually
    /// that of MapOnMesh::values, three products with the nodes of the paths, and a proof; a few
    /// dozen times these where stations are hard to hold.
    Blend at(double u, bool measures) const;

   private:
    friend class LogInbetween;
    bool certifies(Sum& sum, LogMap change) const;
    bool certifies(Sum& sum, LogMap change, const Kept& kept) const;
    bool keeps(const Kept& kept, Sum& sum) const;
    bool keeps_within_limits(const Kept& kept, Sum& sum, const LogMap& least) const;
    void correct(const VectorXc& wanted, Sum& sum, Blend& blend) const;
    void draw(const Sum& sum, double share, Blend& blend) const;
    VectorXc images(const Sum& sum, const VectorXc& f) const;
    VectorXc misses(const Sum& sum, double share, const VectorXc& f) const;
    const LogInbetween* owner = nullptr;
    std::array<const Key*, 4> keys{};  ///< the one before, both ends, and the one after
    /// Four points of a Bezier curve, as weights of the keys.
    std::array<std::array<double, 4>, 4> controls{};
    bool smooth = false;
    bool conformal = false;  ///< both ends are
    /// Combinations of integrals that stay: around holes, and between stations that both ends hold.
    MatrixXd constant;
    VectorXc at_from, at_to;   ///< their values at the ends
    std::vector<Index> still;  ///< the stations that both ends hold
    /// Points that move straight: still stations, or one point. Each is at the end of a line that
    /// starts at the vertex from which its images are integrated.
    std::vector<Line> placed;
    std::vector<int> anchors;         ///< these vertices
    VectorXc placed_from, placed_to;  ///< the images at the ends
    /// The ends minus what integration along the mesh gives for them. Blended, it is added to maps
    /// in between, so that these are as accurate.
    VectorXc off_from, off_to;
  };
  /// Linear motion, or smooth motion that passes through an end with the velocity given by the keys
  /// on both sides, if there are any there. `held` says which stations both ends hold.
  Interval interval(const Key* before, const Key& from, const Key& to, const Key* after,
                    bool smooth, const std::vector<char>& held) const;

 private:
  static bool is_nu(const Sum& sum);
  static LogMap single(const Sum& sum);
  Sum sum_of(const std::array<const Key*, 4>& keys, const std::array<double, 4>& weights) const;
  Derivatives weighted(const Sum& sum) const;
  bool certify(const Sum& sum, std::span<const Key* const> within, double growth) const;
  double norm(const Sum& sum) const;
  double distance(const Key& a, const Key& b) const;
  std::array<double, 4> velocity(const std::array<const Key*, 4>& keys, size_t at) const;
  LogMap constrained_change(const Kept& kept, Sum sum, bool conformal) const;
  LogMap bounded_change(const Kept& kept, Sum sum, const Extremes& bounds, bool conformal) const;
  MapOnMesh::Values on_mesh(const Sum& sum) const;
  VectorXc without_jumps(VectorXc f, const VectorXc& gaps) const;

  std::shared_ptr<const BoundaryBasis> basis_;
  std::shared_ptr<const Mesh> mesh_;
  Certifier certifier_;
  MapOnMesh on_mesh_;
  HoleLoops loops_;
  TreeIntegrals integrals_;
  Points stations_;
  MeshLocator locator_;
  double size_;
};

}  // namespace holomorph
