// An arc and its chord turn around w by the same angle unless w lies between them.
#include "core/maps/image_winding.h"

#include <cmath>

namespace holomorph {
namespace {

/// An upper bound on the map's rounding error near w.
double rounding_at(Complex w, Complex f) {
  return 1e-13 * (std::abs(w) + std::abs(f));
}

/// w is clear of an arc if the squared distance between w and the start of the arc's image exceeds
/// this many times the sum of the squared chord and the squared bulge.
constexpr double kFarAway = 9;

/// The angle by which a chord turns around w, if the chord is farther from w than `bulge`.
std::optional<double> turn_of_chord(Complex from, Complex to, double bulge, Complex w) {
  if (nearest_on_segment(from, to, w).distance <= bulge + rounding_at(w, from)) return {};
  const Complex a = from - w, b = to - w;
  return std::atan2(cross(a, b), dot(a, b));
}

}  // namespace

ImageWinding::Piece ImageWinding::piece_between(const Arc& arc, Complex from, Complex middle,
                                                Complex to) const {
  const auto image = [&](double fraction) { return map_.at(point_on(cage_, arc, fraction)).f; };
  Piece piece{arc, from, to, {image(0.25), middle, image(0.75)}};
  for (const Complex f : piece.inner)
    piece.bulge = std::max(piece.bulge, 2 * nearest_on_segment(from, to, f).distance);
  return piece;
}

ImageWinding::Piece ImageWinding::piece(const Arc& arc) const {
  return piece_between(arc, map_.at(arc.from).f, map_.at(point_on(cage_, arc, 0.5)).f,
                       map_.at(arc.to).f);
}

std::optional<double> ImageWinding::turn(const Piece& piece, Complex w, int depth) const {
  if (const auto chord = turn_of_chord(piece.from, piece.to, piece.bulge, w)) return chord;
  constexpr int kDeepest = 50;
  const double least = 10 * rounding_at(w, piece.from);
  if (depth == kDeepest || std::abs(piece.to - piece.from) + piece.bulge <= least) return {};
  // Half an arc bulges about a quarter as much as the whole arc. If w is clear of the half by the
  // estimate for the whole, the half's own bulge need not be known.
  const auto part = [&](const Arc& half, Complex from, Complex middle, Complex to) {
    const auto chord = turn_of_chord(from, to, piece.bulge, w);
    return chord ? chord : turn(piece_between(half, from, middle, to), w, depth + 1);
  };
  const auto halves = cut_arc(cage_, piece.arc, 0.5);
  const auto [quarter, middle, last_quarter] = piece.inner;
  const auto before = part(halves[0], piece.from, quarter, middle);
  if (!before) return {};
  const auto after = part(halves[1], middle, last_quarter, piece.to);
  if (!after) return {};
  return *before + *after;
}

// The winding number of the polygon of chords is the signed number of times it crosses the ray from
// w to the right. An arc near w may turn by more or less than its chord. This difference is added.
std::optional<int> ImageWinding::turns(std::span<const Piece> loop, Complex w) const {
  int crossings = 0;
  double more = 0;
  for (const Piece& piece : loop) {
    const Complex a = piece.from - w, b = piece.to - w;
    if ((a.imag() <= 0) != (b.imag() <= 0)) {
      const double side = cross(a, b);
      if (side == 0) return turns_by_angles(loop, w);
      if ((side > 0) == (b.imag() > 0)) crossings += side > 0 ? 1 : -1;
    }
    if (std::norm(a) > kFarAway * (std::norm(b - a) + piece.bulge * piece.bulge) &&
        std::norm(a) > kFarAway * rounding_at(w, piece.from) * rounding_at(w, piece.from))
      continue;
    const auto part = turn(piece, w);
    if (!part) return {};
    more += *part - std::atan2(cross(a, b), dot(a, b));
  }
  return crossings + static_cast<int>(std::lround(more / (2 * kPi)));
}

std::optional<int> ImageWinding::turns_by_angles(std::span<const Piece> loop, Complex w) const {
  double sum = 0;
  for (const Piece& piece : loop) {
    const auto part = turn(piece, w);
    if (!part) return {};
    sum += *part;
  }
  return static_cast<int>(std::lround(sum / (2 * kPi)));
}

}  // namespace holomorph
