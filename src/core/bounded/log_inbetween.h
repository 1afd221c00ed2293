// Maps between two maps without folds, which do not fold either.
//
// With l and nu of both keys blended by the same convex weights, |nu| and the smallest stretch stay
// within the bounds of the keys, because they are convex. Smooth motion is a Bezier curve whose
// inner points are certified, so all of its points are. Then the smallest change keeps those
// stations still that both keys hold, and closes holes. If it does not certify, the smallest change
// within the keys' extremes is tried, and then smaller changes, which still close holes.
#pragma once

#include <limits>

#include "core/bounded/log_interval.h"

namespace holomorph {

/// Blends maps of one basis. Threads: const functions may run at the same time.
class LogInbetween {
 public:
  /// `stations` are points in the domain that keys may hold.
  LogInbetween(std::shared_ptr<const BoundaryBasis> basis, std::shared_ptr<const Mesh> mesh,
               const Points& stations);

  /// The mean of Im l over the mesh's vertices: the average rotation of the picture.
  double mean_argument(const LogMap& map) const;
  /// Im l at a station: the rotation of the picture there.
  double argument_at(const LogMap& map, size_t station) const;
  /// By how much stations that both keys hold leave their places between the keys without a
  /// correction, at most, at three times. It shows whether the whole turns between the keys are the
  /// right ones. Halfway alone, a turn to the left would look the same as one to the right.
  double slide(const LogKey& from, const LogKey& to, const std::vector<char>& held) const;

  /// Linear motion, or smooth motion that passes through an end with the velocity given by the keys
  /// on both sides, if there are any there. `keys` are the key before, which may be null, the two
  /// ends, and the key after, which may be null. `held` says which stations both ends hold, and at
  /// most `most` of these are held in between. The keys and this object must outlive the interval.
  LogInterval interval(const std::array<const LogKey*, 4>& keys, bool smooth,
                       const std::vector<char>& held,
                       size_t most = std::numeric_limits<size_t>::max()) const;

 private:
  double distance(const LogKey& a, const LogKey& b) const;
  std::array<double, 4> velocity(const LogCurve& curve, size_t at) const;

  LogSums sums_;
  Points stations_;
  MeshLocator locator_;
};

}  // namespace holomorph
