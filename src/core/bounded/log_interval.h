// The motion from one map without folds to the next.
#pragma once

#include <array>
#include <optional>

#include "core/bounded/log_sums.h"
#include "core/mesh/inbetween.h"
#include "core/mesh/locator.h"

namespace holomorph {

/// A certified key: its map with a continuous argument, the proved extremes of its distortion, and
/// f at the mesh's vertices.
struct LogKey {
  LogMap map;
  Extremes extremes;
  VectorXc f;
  double time = 0;
};

/// The extremes of two keys together.
Extremes extremes_of(const LogKey& a, const LogKey& b);

/// Four points of a Bezier curve in the space of maps, as weights of four keys: the one before,
/// both ends, and the one after. The first and the last point are the ends.
struct LogCurve {
  std::array<const LogKey*, 4> keys{};  ///< null: there is none
  std::array<std::array<double, 4>, 4> controls{};
  bool smooth = false;  ///< else a straight line

  /// The sum of the keys' maps with the given weights.
  LogSum sum(const std::array<double, 4>& weights, const LogSums& sums) const;
  /// The sum of maps at the fraction u of the time.
  LogSum at(double u, const LogSums& sums) const;
  /// The progress of the motion, from 0 to 1.
  double share(double u) const;
  const LogKey& from() const { return *keys[1]; }
  const LogKey& to() const { return *keys[2]; }
};

/// The stations that both ends hold. Only the first `kept` of them are held in between.
struct StillStations {
  std::vector<Index> numbers;
  Points positions;
  size_t kept = 0;
};

/// The maps between two keys. Threads: const functions may run at the same time.
class LogInterval {
 public:
  /// By how much the largest size may grow between keys. Without corrections, it is 6.2 % at most.
  static constexpr double kGrowth = 0.3;

  /// The keys and the sums must outlive it.
  LogInterval(const LogSums& sums, const MeshLocator& locator, LogCurve curve,
              const StillStations& still);

  /// A map between the keys.
  struct Blend {
    VectorXc f;
    Derivatives first;  ///< at the mesh's vertices
    /// Whether it is proved that |nu| and the smallest size stay within 1 % of the keys' extremes,
    /// and that the largest size exceeds both by at most kGrowth.
    bool certified = false;
    LogSum map;  ///< up to a constant; it refers to the keys
    /// If they are measured, and both keys are in the space L_nu.
    std::optional<Extremes> extremes;
    /// The stations that are not still (kStillPin) although both keys hold them, and how far they
    /// are from their places: they are not kept, or no larger correction could be proved.
    struct Slide {
      Index station;
      double distance;
    };
    std::vector<Slide> slides;
    /// By how much f jumped before the jumps were spread over the picture; 0 without holes.
    double gap = 0;
  };
  /// The map at the fraction u of the time, 0 < u < 1, with or without `extremes`. Cost: usually
  /// that of MapOnMesh::values, three products with the nodes of the paths, and a proof; a few
  /// dozen times these where stations are hard to hold.
  Blend at(double u, bool measures) const;

 private:
  using Constraints = LogSums::Constraints;
  /// At an end: the constant combinations, the images of the placed points, and the key's f minus
  /// what integration along the mesh gives. Blended, the latter is added to maps in between, so
  /// that these are as accurate.
  struct End {
    VectorXc constant, places, off;
  };
  End measured(const LogKey& key) const;
  bool certifies(LogSum& sum, LogMap change) const;
  bool certifies(LogSum& sum, LogMap change, const Constraints& kept) const;
  bool keeps(const Constraints& kept, LogSum& sum, const LogMap& least) const;
  bool keeps_within_limits(const Constraints& kept, LogSum& sum, const LogMap& least) const;
  bool keeps_partly(const Constraints& closed, LogSum& sum, const LogMap& least,
                    const LogMap& whole) const;
  bool correct(const VectorXc& wanted, LogSum& sum) const;
  void draw(const LogSum& sum, double share, Blend& blend) const;
  VectorXc images(const LogSum& sum, const VectorXc& f) const;
  VectorXc misses(const LogSum& sum, double share, const VectorXc& f) const;

  const LogSums* sums_;
  LogCurve curve_;
  Extremes limits_;  ///< the extremes of both ends
  bool conformal_;   ///< both ends are
  /// Combinations of integrals that stay: around holes, and between stations that both ends hold.
  MatrixXd constant_;
  std::vector<Index> still_;
  /// For each point that moves straight, the vertex from which its images are integrated: still
  /// stations, the kept ones first, or one point.
  std::vector<int> anchors_;
  LineIntegrals lines_;  ///< from these vertices to the points
  Index held_count_;     ///< the number of points that are held: kept stations, or the one point
  End from_, to_;
};

}  // namespace holomorph
