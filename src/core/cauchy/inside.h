// Which points lie inside a cage.
#pragma once

#include "core/cauchy/cauchy.h"

namespace holomorph {

/// The inside of a cage, prepared for many points.
class Inside {
 public:
  explicit Inside(const Cage& cage);

  /// The same as contains(cage, z). Cost: 5 ns per segment, plus the roots for each curved segment
  /// whose box contains z.
  bool contains(Complex z) const;

 private:
  /// How often a loop winds around z, which is not on it.
  int winding(Index loop, Complex z) const;
  /// By how many turns a curved segment winds around z more often than its chord.
  int turns_beyond_chord(const SegmentPolynomial& segment, Complex z) const;

  Polygon chords_;  ///< from vertex to vertex
  std::vector<SegmentPolynomial> segments_;
};

}  // namespace holomorph
