// Cuts a boundary into pieces that are short enough to approximate a conformal map by a linear map
// on each piece.
#pragma once

#include <functional>
#include <vector>

#include "core/types.h"

namespace holomorph {

struct CutRules {
  double length = 1;  ///< length of the boundary
  double size = 1;    ///< size of the image
  /// Limit for a piece in units of `length`, and for its image in units of `size`.
  double longest = 1.0 / 80;
  double off = 2e-3;  ///< largest distance of the image from its chord, over `size`
  /// Largest ratio of that distance to the chord, for pieces longer than `shortest`.
  double bent = 0.1;
  double shortest = 2e-4;  ///< in units of `length`
  double least = 1e-12;    ///< in units of `length`; shorter pieces are not halved
  size_t most = 1100;      ///< number of cuts after which pieces are no longer halved
};

/// Increasing arc lengths, once around, that include all of `kept` (increasing). Pieces are halved
/// until three conditions hold: (1) no piece is longer than the value of `longest` at its midpoint;
/// (2) the image of each midpoint is as near to the midpoint of the image's chord as `rules`
/// require; (3) no piece is more than three times as long as a neighbor. Pieces thus shrink
/// geometrically toward points where the map behaves like a power or a logarithm.
std::vector<double> graded_cuts(const std::vector<double>& kept,
                                const std::function<Complex(double)>& image,
                                const std::function<double(double)>& longest,
                                const CutRules& rules);

}  // namespace holomorph
