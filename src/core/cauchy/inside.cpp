// A loop of chords winds around a point as often as a ray from the point crosses it. A curve can
// wind differently from its chord only around points in the box of its control points. There, its
// roots give the angle that it subtends.
#include "core/cauchy/inside.h"

#include <array>
#include <cmath>

namespace holomorph {

Inside::Inside(const Cage& cage) : chords_{vertices_of(cage), cage.starts} {
  for (Index e = 0; e < cage.size(); ++e) segments_.emplace_back(cage.controls(e));
}

int Inside::turns_beyond_chord(const SegmentPolynomial& segment, Complex z) const {
  std::array<Root, kHighestDegree> storage;
  const std::span<Root> roots(storage.data(), static_cast<size_t>(segment.degree()));
  segment.roots(z, roots);
  double angle = 0;
  for (const Root& root : roots) angle += angle_of(root);
  // On the chord, the sign of the angle is that with which the chord was counted.
  const Complex from = segment.start() - z, to = segment.end() - z;
  const double of_chord =
      std::copysign(std::arg(to / from), is_left_of(segment.start(), segment.end(), z) ? 1 : -1);
  return static_cast<int>(std::lround((angle - of_chord) / (2 * kPi)));
}

int Inside::winding(Index loop, Complex z) const {
  const PolygonView chords = chords_;
  int winding = winding_number(chords.loop(loop), z);
  for (Index e = chords.loops().first(loop); e < chords.loops().end(loop); ++e) {
    const SegmentPolynomial& segment = segments_[static_cast<size_t>(e)];
    if (segment.degree() > 1 && segment.box().contains(z))
      winding += turns_beyond_chord(segment, z);
  }
  return winding;
}

bool Inside::contains(Complex z) const {
  if (contact_of(segments_, z)) return true;
  const Index loops = PolygonView(chords_).loops().count();
  int around = 0;
  for (Index l = 0; l < loops; ++l) around += winding(l, z) != 0;
  return around % 2 == 1;
}

bool contains(const Cage& cage, Complex z) {
  return Inside(cage).contains(z);
}

}  // namespace holomorph
