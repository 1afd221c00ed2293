// All parts of a picture as elastic sheets, and what follows them.
#pragma once

#include "core/methods/sheet_division.h"
#include "core/methods/sheet_part.h"

namespace holomorph {

/// One for each part; null for loose parts.
struct SheetSolutions : Solution {
  std::vector<std::shared_ptr<const SheetSolution>> parts;
};

/// What has been found for one part: the map at its samples, and at its anchors.
struct MapOfPart {
  SampledMap map;
  std::vector<PointMap::Value> anchors;
};

/// What does not change until the rest does. Immutable.
struct SheetParts {
  SheetDivision division;
  std::vector<std::unique_ptr<SheetPart>> parts;  ///< null for loose parts
  Index sample_count;
  std::shared_ptr<const Mesh> drawn;  ///< the mesh whose vertices are the samples, or null
  bool loose_stay;

  /// Parts that `previous` has in common are shared; it may be null.
  SheetParts(const Rest& rest, const SheetParts* previous);

  /// How a loose part moves, if its leader has these values at its anchors.
  PointMap::Value followed(size_t loose, std::span<const PointMap::Value> anchors, Complex z) const;
  /// The map of the whole picture, without turns and note, from those of the parts. The ones of
  /// loose parts are ignored.
  SampledMap merged(std::vector<MapOfPart> maps, bool derivatives) const;
};

/// The maps of all parts, each where the part is. Those of loose parts are null.
std::unique_ptr<PointMap> map_of_parts(std::shared_ptr<const SheetParts> sheets,
                                       std::vector<std::unique_ptr<PointMap>> maps);

/// The motion of all parts.
std::shared_ptr<const ProvedMotion> motion_of_parts(std::shared_ptr<const SheetParts> sheets);

}  // namespace holomorph
