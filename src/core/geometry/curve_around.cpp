// Fits least-squares cubics between points of the outline. Pieces that cut the kept polyline are
// halved until no piece cuts it.
#include "core/geometry/curve_around.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/geometry/simplify.h"

namespace holomorph {
namespace {

constexpr double kCorner = 0.65;  ///< cosine of the smallest turning angle of a corner
constexpr int kFlat = 24;         ///< edges that represent a curve in the tests

/// The outline's points nearest to the vertices of the simplified polygon, in order.
std::set<size_t> first_breaks(const Points& outline, const Points& polygon) {
  std::set<size_t> breaks;
  for (const Complex& z : polygon) {
    const auto nearest =
        std::min_element(outline.begin(), outline.end(),
                         [&](Complex a, Complex b) { return std::norm(a - z) < std::norm(b - z); });
    breaks.insert(static_cast<size_t>(nearest - outline.begin()));
  }
  for (size_t k = 0; breaks.size() < 3 && k < 3; ++k) breaks.insert(k * outline.size() / 3);
  return breaks;
}

/// The cubic fitted to the outline between two of its points, or a line if there are too few points
/// in between.
Points piece(const Points& outline, size_t from, size_t to) {
  const size_t n = outline.size(), count = (to + n - from) % n;
  Points samples;
  std::vector<double> parameters{0};
  for (size_t k = 0; k <= count; ++k) {
    samples.push_back(outline[(from + k) % n]);
    if (k > 0) parameters.push_back(parameters.back() + std::abs(samples[k] - samples[k - 1]));
  }
  for (double& t : parameters) t /= parameters.back();
  if (samples.size() < 5) return {samples.front(), samples.back()};
  return fitted(samples, parameters, 3);
}

/// Makes the two tangents of each joint collinear, unless the joint is a corner.
void smooth_joints(Cage& cage) {
  for (Index e = 0; e < cage.size(); ++e) {
    const Index before = (e + cage.size() - 1) % cage.size();
    if (cage.degree(e) != 3 || cage.degree(before) != 3) continue;
    const Complex z = cage.vertex(e);
    Complex &in = cage.segments[before][2], &out = cage.segments[e][1];
    const double a = std::abs(z - in), b = std::abs(out - z);
    if (!(a > 0) || !(b > 0)) continue;
    const Complex u = (z - in) / a, v = (out - z) / b;
    if (dot(u, v) < kCorner) continue;
    const Complex along = (u + v) / std::abs(u + v);
    in = z - a * along;
    out = z + b * along;
  }
}

Cage loop_over(const Points& outline, const std::set<size_t>& breaks) {
  Cage cage;
  for (auto from = breaks.begin(); from != breaks.end(); ++from) {
    const auto to = std::next(from) == breaks.end() ? breaks.begin() : std::next(from);
    Points controls = piece(outline, *from, *to);
    controls.pop_back();
    cage.segments.push_back(std::move(controls));
  }
  smooth_joints(cage);
  return cage;
}

/// The segments that cut off kept points or cross other segments.
std::set<Index> bad_segments(const Cage& cage, const Points& kept) {
  const Points flat = outline_of(cage, kFlat).points;
  std::vector<Index> segment;
  for (Index e = 0; e < cage.size(); ++e)
    segment.insert(segment.end(), cage.degree(e) == 1 ? 1 : kFlat, e);
  std::set<Index> bad;
  for (const Complex& z : kept)
    if (winding_number(flat, z) != 1) bad.insert(segment[nearest_on_polygon(flat, z).edge]);
  if (const auto crossing = self_crossing(flat)) {
    bad.insert(segment[crossing->first]);
    bad.insert(segment[crossing->second]);
  }
  return bad;
}

}  // namespace

Cage curves_around(const Points& outline, const Points& kept, int wanted) {
  // Joints must be points of the outline.
  const Points polygon = simplified_around(outline, kept, wanted, Simplified::subset);
  std::set<size_t> breaks = first_breaks(outline, polygon);
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    Cage cage = loop_over(outline, breaks);
    const std::set<Index> bad = bad_segments(cage, kept);
    if (bad.empty()) {
      if (!rest_fault(cage)) return cage;
      break;
    }
    const std::vector<size_t> list(breaks.begin(), breaks.end());
    for (const Index e : bad) {
      const size_t from = list[e], to = list[(e + 1) % list.size()];
      const size_t count = (to + outline.size() - from) % outline.size();
      if (count >= 2) breaks.insert((from + count / 2) % outline.size());
    }
  }
  return polygon_cage(polygon);
}

}  // namespace holomorph
