// Builds a cage around a picture's content from its alpha channel.
#pragma once

#include <optional>

#include "core/geometry/cage.h"
#include "scene/part_grid.h"

namespace holomorph {

struct AutoCageOptions {
  std::optional<int> vertices = {};   ///< 3 to 500; none: as many as the shape needs
  std::optional<double> margin = {};  ///< distance from the content in pixels; none: see `detail`
  double detail = 50;                 ///< 0 to 100: a close cage of many vertices at 100
  double hole_width = 3;  ///< percent of the size; empty regions wider than this become holes
  bool curved = false;    ///< cubic segments instead of straight edges
  /// Around which parts of the content.
  PartChoice parts = PartChoice::joined;
};

/// A simple counter-clockwise cage around a picture's content, which encloses all pixels of the
/// chosen parts. Chosen apart, each part has an outline of its own; where there is no room for
/// them, the parts are joined. Without a given margin, it follows the content at about 0.5 % of its
/// size (a quarter or four times as much at the ends of `detail`), but no farther than a third of
/// the narrowest gap between limbs, and at least 0.5 px. Limbs that are 3 px apart thus stay apart,
/// unless that takes more than 500 vertices, or with many parts 4,500 in all. Curved cages stay
/// farther away and may join limbs. With given vertices, the cage has about that many, or more if
/// fewer would cut into the content; gaps may then be closed.
///
/// Empty regions inside the content become holes if a circle with a diameter of `hole_width`
/// percent of the content's size fits into them and no other content lies in them; up to 100 holes,
/// the widest first. Content in a hole, such as the pupil of an eye, would be left behind. Smaller
/// regions are usually gaps between strokes, and each hole costs unknowns. The vertices of holes
/// are not counted in `vertices`. If the picture has no transparency or no content, the cage is the
/// picture's rectangle. Throws Error for options out of range. Cost: about 100 ns per pixel;
/// pictures with sides above 4096 px are reduced.
Cage auto_cage(const Image& image, const AutoCageOptions& options = {});

}  // namespace holomorph
