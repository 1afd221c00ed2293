// How a map's image of an arc turns around a point, exactly enough to count preimages.
//
// The image of a loop turns around w once for each preimage of w inside the loop (the argument
// principle), with its sign where a map is not holomorphic.
#pragma once

#include <array>
#include <optional>

#include "core/maps/deformer.h"

namespace holomorph {

/// A straight line in a map's domain, or a part of one of its boundary's segments.
struct Arc {
  Complex from, to;
  Index segment = -1;
  double start = 0, end = 1;  ///< parameters on the segment
};

class ImageWinding {
 public:
  /// Both must outlive this.
  ImageWinding(const Cage& cage, const PointMap& map) : cage_(cage), map_(map) {}

  /// An arc, the image of its ends and by how much its image may differ from their chord: twice of
  /// what it does at three points.
  struct Piece {
    Arc arc;
    Complex from, to;
    double bulge = 0;
  };
  /// Cost: five evaluations of the map.
  Piece piece(const Arc& arc) const;

  /// The angle in radians by which f - w turns along a piece; none when w is on its image as well
  /// as rounding can tell. Pieces are halved until w is clear of them. Cost: none when w is not
  /// near, four evaluations for each halving.
  std::optional<double> turn(const Piece& piece, Complex w) const { return turn(piece, w, 0); }
  /// The same along a closed loop, in whole turns.
  std::optional<int> turns(std::span<const Piece> loop, Complex w) const;

  /// The point of an arc at a share between 0 and 1, and the two arcs that it cuts it into.
  Complex point(const Arc& arc, double share) const;
  std::array<Arc, 2> cut(const Arc& arc, double share) const;

 private:
  Piece piece_between(const Arc& arc, Complex from, Complex to) const;
  std::optional<double> turn(const Piece& piece, Complex w, int depth) const;
  std::optional<int> turns_by_angles(std::span<const Piece> loop, Complex w) const;

  const Cage& cage_;
  const PointMap& map_;
};

}  // namespace holomorph
