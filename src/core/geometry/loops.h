// Closed loops that are stored one after another in a single list: an outline, and then its holes.
// Domains with several parts have an outline and holes for each of them.
#pragma once

#include <algorithm>
#include <span>

#include "core/types.h"

namespace holomorph {

/// The arithmetic of positions in such a list, which may hold segments, points or vertices. A view
/// of `starts`.
class Loops {
 public:
  /// A list of `size` items. `starts` are the positions at which the loops after the first one
  /// start, in increasing order.
  Loops(Index size, std::span<const Index> starts) : size_(size), starts_(starts) {}

  /// The number of loops; loop 0 is an outline.
  Index count() const { return static_cast<Index>(starts_.size()) + 1; }
  /// The position of a loop's first item, and the position after its last one.
  Index first(Index loop) const { return loop == 0 ? 0 : starts_[static_cast<size_t>(loop - 1)]; }
  Index end(Index loop) const {
    return loop + 1 < count() ? starts_[static_cast<size_t>(loop)] : size_;
  }
  Index length(Index loop) const { return end(loop) - first(loop); }
  Index loop_of(Index i) const {
    return starts_.empty() ? 0 : std::ranges::upper_bound(starts_, i) - starts_.begin();
  }
  /// The next and the previous position in the same loop.
  Index next(Index i) const {
    if (starts_.empty()) return i + 1 < size_ ? i + 1 : 0;
    const Index loop = loop_of(i);
    return i + 1 < end(loop) ? i + 1 : first(loop);
  }
  Index before(Index i) const {
    if (starts_.empty()) return i > 0 ? i - 1 : size_ - 1;
    const Index loop = loop_of(i);
    return i > first(loop) ? i - 1 : end(loop) - 1;
  }

 private:
  Index size_;
  std::span<const Index> starts_;
};

}  // namespace holomorph
