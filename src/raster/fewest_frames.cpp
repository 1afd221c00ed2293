// Goes as far as possible from each chosen time to the next (Imai, Iri 1986, without their graph:
// the farthest reachable time is usually the best one).
#include "raster/fewest_frames.h"

#include <algorithm>

#include "core/error.h"

namespace holomorph {
namespace {

using MeshPositions = std::vector<Points>;

/// Whether positions at the fraction u of the way from a to b are within `tolerance` of those in
/// `exact`.
bool are_near(const MeshPositions& a, const MeshPositions& b, double u, const MeshPositions& exact,
              double tolerance) {
  for (size_t k = 0; k < exact.size(); ++k)
    for (size_t v = 0; v < exact[k].size(); ++v)
      if (std::norm((1 - u) * a[k][v] + u * b[k][v] - exact[k][v]) > tolerance * tolerance)
        return false;
  return true;
}

class FrameChooser {
 public:
  FrameChooser(double tolerance, const std::function<MeshPositions(double)>& exact)
      : tolerance_(tolerance), exact_(exact) {}

  Frames choose(const std::vector<double>& times) {
    Sample last{times[0], exact_(times[0])};
    take(last);
    for (size_t i = 1; i < times.size(); ++i) {
      Sample next{times[i], exact_(times[i])};
      add_between(last, next, 0);
      last = next;
      add(std::move(next), true);
    }
    if (best_) take(passed_[*best_]);
    return std::move(frames_);
  }

 private:
  struct Sample {
    double time = 0;
    MeshPositions at;
  };

  void take(const Sample& sample) {
    frames_.times.push_back(sample.time);
    frames_.positions.push_back(sample.at);
  }

  void add_between(const Sample& a, const Sample& b, int depth) {
    constexpr int kDeepest = 6;
    if (is_jump(a.time, b.time)) return;
    Sample middle{0.5 * (a.time + b.time), {}};
    middle.at = exact_(middle.time);
    if (depth == kDeepest || are_near(a.at, b.at, 0.5, middle.at, tolerance_))
      return add(std::move(middle), false);
    add_between(a, middle, depth + 1);
    add(Sample(middle), true);
    add_between(middle, b, depth + 1);
  }

  /// Passes a sample after the chosen one, which the next frame may follow.
  void add(Sample sample, bool can_be_chosen) {
    passed_.push_back(std::move(sample));
    if (!can_be_chosen) return;
    constexpr size_t kMost = 200;
    const size_t here = passed_.size() - 1;
    if (best_ && (passed_.size() > kMost || !reaches(here))) {
      take(passed_[*best_]);
      passed_.erase(passed_.begin(), passed_.begin() + static_cast<std::ptrdiff_t>(*best_) + 1);
      best_ = here - *best_ - 1;
    } else {
      best_ = here;
    }
  }

  bool reaches(size_t end) const {
    const MeshPositions &from = frames_.positions.back(), &to = passed_[end].at;
    const double start = frames_.times.back(), length = passed_[end].time - start;
    for (size_t i = end; i-- > 0;)
      if (!are_near(from, to, (passed_[i].time - start) / length, passed_[i].at, tolerance_))
        return false;
    return true;
  }

  double tolerance_;
  const std::function<MeshPositions(double)>& exact_;
  Frames frames_;
  std::vector<Sample> passed_;  ///< since the last frame
  std::optional<size_t> best_;  ///< the last of them that the next frame can be
};

}  // namespace

Frames fewest_frames(const std::vector<double>& times, double tolerance,
                     const std::function<std::vector<Points>(double time)>& exact) {
  check(!times.empty(), "fewest_frames: there are times");
  return FrameChooser(tolerance, exact).choose(times);
}

}  // namespace holomorph
