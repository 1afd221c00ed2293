// Where a boundary is cut so that a map that is linear along each piece follows a conformal one.
#pragma once

#include <functional>
#include <vector>

#include "core/types.h"

namespace holomorph {

struct CutRules {
  double length = 1;          ///< of the boundary
  double size = 1;            ///< of the image
  double longest = 1.0 / 80;  ///< piece, and its image, in lengths and sizes
  double off = 2e-3;          ///< of the image from the chord, in sizes
  double bent = 0.1;          ///< the same in chords, while the piece is longer than `shortest`
  double shortest = 2e-4;     ///< in lengths
  double least = 1e-12;       ///< pieces are not halved below this, in lengths
  size_t most = 1100;         ///< cuts; what comes after them stays as it is
};

/// Increasing arc lengths, once around, with all of `kept` (increasing) among them: pieces are
/// halved until they are at most as long as `longest` has it at their middles, until the image of
/// the middle is as near the middle of the images as `rules` want it,
/// and until none is more than three times as long as its neighbors. Pieces thus shrink
/// geometrically towards points where the map has powers or logarithms.
std::vector<double> graded_cuts(const std::vector<double>& kept,
                                const std::function<Complex(double)>& image,
                                const std::function<double(double)>& longest,
                                const CutRules& rules);

}  // namespace holomorph
