// Closed loops that are stored one after another in a single list: the outer loop of a domain, and
// then its holes.
#pragma once

#include <algorithm>
#include <span>

#include "core/types.h"

namespace holomorph {

/// The arithmetic of positions in such a list, which may hold segments, points or vertices. A view
/// of `holes`.
class Loops {
 public:
  /// A list of `size` items. `holes` are the positions at which holes start, in increasing order.
  Loops(Index size, std::span<const Index> holes) : size_(size), holes_(holes) {}

  /// The number of loops; loop 0 is the outer one.
  Index count() const { return static_cast<Index>(holes_.size()) + 1; }
  /// The position of a loop's first item, and the position after its last one.
  Index first(Index loop) const { return loop == 0 ? 0 : holes_[static_cast<size_t>(loop - 1)]; }
  Index end(Index loop) const {
    return loop + 1 < count() ? holes_[static_cast<size_t>(loop)] : size_;
  }
  Index length(Index loop) const { return end(loop) - first(loop); }
  Index loop_of(Index i) const {
    return holes_.empty() ? 0 : std::ranges::upper_bound(holes_, i) - holes_.begin();
  }
  /// The next and the previous position in the same loop.
  Index next(Index i) const {
    if (holes_.empty()) return i + 1 < size_ ? i + 1 : 0;
    const Index loop = loop_of(i);
    return i + 1 < end(loop) ? i + 1 : first(loop);
  }
  Index before(Index i) const {
    if (holes_.empty()) return i > 0 ? i - 1 : size_ - 1;
    const Index loop = loop_of(i);
    return i > first(loop) ? i - 1 : end(loop) - 1;
  }

 private:
  Index size_;
  std::span<const Index> holes_;
};

}  // namespace holomorph
