// The angle by which the image of an arc turns around a point, accurate enough to count preimages.
//
// By the argument principle, the image of a loop winds around w once for each preimage of w inside
// the loop. If the map is not holomorphic, each preimage counts with the sign of its orientation.
#pragma once

#include <array>
#include <optional>

#include "core/maps/arc.h"
#include "core/maps/deformer.h"

namespace holomorph {

class ImageWinding {
 public:
  /// `cage` and `map` must outlive this object.
  ImageWinding(const Cage& cage, const PointMap& map) : cage_(cage), map_(map) {}

  /// An arc, the images of its ends and those of the points at a quarter, a half and three quarters
  /// of it. `bulge` estimates how far the arc's image deviates from its chord: twice the largest
  /// deviation at these three points.
  struct Piece {
    Arc arc;
    Complex from, to;
    std::array<Complex, 3> inner;
    double bulge = 0;
  };
  /// Cost: five evaluations of the map.
  Piece piece(const Arc& arc) const;

  /// The angle in radians by which f - w turns along a piece. Empty when w lies on the piece's
  /// image to within rounding error. If w is near the image, the piece is halved repeatedly. Cost:
  /// two evaluations of the map for each half that w is near.
  std::optional<double> turn(const Piece& piece, Complex w) const { return turn(piece, w, 0); }
  /// The number of whole turns of f - w along a closed loop. Empty when w lies on the loop's image
  /// to within rounding error.
  std::optional<int> turns(std::span<const Piece> loop, Complex w) const;

 private:
  Piece piece_between(const Arc& arc, Complex from, Complex middle, Complex to) const;
  std::optional<double> turn(const Piece& piece, Complex w, int depth) const;
  std::optional<int> turns_by_angles(std::span<const Piece> loop, Complex w) const;

  const Cage& cage_;
  const PointMap& map_;
};

}  // namespace holomorph
