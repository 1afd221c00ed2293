// Index arithmetic over the segments of a cage. curve.h has the operations on single curves.
#include "core/geometry/cage.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/geometry/segment.h"

namespace holomorph {

Index Cage::control_count() const {
  Index count = 0;
  for (const Points& segment : segments) count += static_cast<Index>(segment.size());
  return count;
}

Points Cage::controls(Index segment) const {
  Points all = segments[segment];
  all.push_back(end_vertex(segment));
  return all;
}

Index Cage::control_offset(Index segment) const {
  Index offset = 0;
  for (Index i = 0; i < segment; ++i) offset += degree(i);
  return offset;
}

Cage polygon_cage(PolygonView polygon) {
  Cage cage;
  for (const Complex& z : polygon.points()) cage.segments.push_back({z});
  for (Index l = 1; l < polygon.loops().count(); ++l)
    cage.starts.push_back(polygon.loops().first(l));
  return cage;
}

Points vertices_of(const Cage& cage) {
  Points vertices;
  for (const Points& segment : cage.segments) vertices.push_back(segment[0]);
  return vertices;
}

VectorXc controls_of(const Cage& cage) {
  VectorXc all(cage.control_count());
  Index i = 0;
  for (const Points& segment : cage.segments)
    for (const Complex& z : segment) all[i++] = z;
  return all;
}

void check_same_loops(const Cage& rest, const Cage& pose) {
  if (pose.size() != rest.size())
    throw Error(ErrorKind::bad_input, "the posed cage has " + std::to_string(pose.size()) +
                                          " segments, but the rest cage has " +
                                          std::to_string(rest.size()) + "; they must agree");
  if (pose.starts != rest.starts || pose.parts != rest.parts)
    throw Error(ErrorKind::bad_input,
                "the holes and parts of the posed cage do not have as many segments as those of "
                "the rest cage; they must agree");
}

Cage elevated_to(const Cage& cage, const Cage& other) {
  check_same_loops(cage, other);
  Cage raised;
  raised.starts = cage.starts;
  raised.parts = cage.parts;
  for (Index i = 0; i < cage.size(); ++i) {
    Points curve = elevated(cage.controls(i), std::max(cage.degree(i), other.degree(i)));
    curve.pop_back();
    raised.segments.push_back(std::move(curve));
  }
  return raised;
}

Polygon outline_of(const Cage& cage, int per_curve) {
  Polygon outline;
  for (Index i = 0; i < cage.size(); ++i) {
    if (std::ranges::binary_search(cage.starts, i))
      outline.starts.push_back(static_cast<Index>(outline.points.size()));
    outline.points.push_back(cage.vertex(i));
    if (cage.degree(i) == 1) continue;
    const Points controls = cage.controls(i);
    for (int k = 1; k < per_curve; ++k)
      outline.points.push_back(bezier_point(controls, static_cast<double>(k) / per_curve));
  }
  return outline;
}

Cage reversed(const Cage& cage, Index loop) {
  Cage backward = cage;
  const Index first = cage.loops().first(loop), end = cage.loops().end(loop);
  for (Index i = first; i < end; ++i) {
    Points controls = cage.controls(first + end - 1 - i);
    std::ranges::reverse(controls);
    controls.pop_back();
    backward.segments[i] = std::move(controls);
  }
  return backward;
}

Cage reversed(const Cage& cage) {
  Cage backward = cage;
  for (Index l = 0; l < cage.loops().count(); ++l) backward = reversed(backward, l);
  return backward;
}

Complex point_inside_vertex(const Cage& cage, Complex z) {
  for (Index v = 0; v < cage.size(); ++v) {
    if (cage.vertex(v) != z) continue;
    const Points before = cage.controls(cage.before(v)), after = cage.controls(v);
    const Complex in = before[before.size() - 2] - z, out = after[1] - z;
    const double shorter = std::min(std::abs(before.front() - z), std::abs(after.back() - z)),
                 rounding = std::numeric_limits<double>::epsilon() * std::abs(z);
    return z + std::max(1e-9 * shorter, 64 * rounding) * interior_bisector(out, in);
  }
  return z;
}

namespace {

/// Moves the starts of loops after a segment by a number of segments.
void move_starts(Cage& cage, Index segment, Index by) {
  for (std::vector<Index>* starts : {&cage.starts, &cage.parts})
    for (Index& start : *starts) start += start > segment ? by : 0;
}

}  // namespace

void insert_vertex(Cage& cage, Index segment, double t) {
  check(segment >= 0 && segment < cage.size() && t > 0 && t < 1, "insert_vertex: on a segment");
  SplitCurve halves = split(cage.controls(segment), t);
  halves.before.pop_back();
  halves.after.pop_back();
  cage.segments[segment] = std::move(halves.before);
  cage.segments.insert(cage.segments.begin() + segment + 1, std::move(halves.after));
  move_starts(cage, segment, 1);
}

double joint_parameter(const Cage& cage, Index vertex) {
  const Index before = cage.before(vertex);
  const Points left = cage.controls(before), right = cage.controls(vertex);
  const double in = cage.degree(before) * std::abs(left.back() - left[left.size() - 2]),
               out = cage.degree(vertex) * std::abs(right[1] - right[0]);
  return in + out > 0 ? std::clamp(in / (in + out), 0.05, 0.95) : 0.5;
}

void erase_vertex(Cage& cage, Index vertex, double joint, Refit refit) {
  check(
      vertex >= 0 && vertex < cage.size() && cage.loops().length(cage.loops().loop_of(vertex)) > 3,
      "erase_vertex: more than three");
  const Index before = cage.before(vertex);
  const int degree = std::max(cage.degree(before), cage.degree(vertex));
  if (degree > 1 && refit == Refit::tangents) {
    const Points left = elevated(cage.controls(before), std::max(3, cage.degree(before))),
                 right = elevated(cage.controls(vertex), std::max(3, cage.degree(vertex)));
    cage.segments[before] = {left[0], left[1], right[right.size() - 2]};
  } else if (degree > 1) {
    const Points left = cage.controls(before), right = cage.controls(vertex);
    constexpr int kSamples = 24;
    Points samples;
    std::vector<double> parameters;
    for (int k = 0; k <= 2 * kSamples; ++k) {
      const bool first = k < kSamples;
      const double t = static_cast<double>(first ? k : k - kSamples) / kSamples;
      samples.push_back(bezier_point(first ? left : right, t));
      parameters.push_back(first ? joint * t : joint + (1 - joint) * t);
    }
    Points curve = fitted(samples, parameters, degree);
    curve.pop_back();
    cage.segments[before] = std::move(curve);
  }
  cage.segments.erase(cage.segments.begin() + vertex);
  move_starts(cage, vertex, -1);
}

void add_hole(Cage& cage, const std::vector<Points>& segments, Index part) {
  const Index loop = loops_of_part(cage, part).end, at = cage.loops().end(loop - 1);
  cage.segments.insert(cage.segments.begin() + at, segments.begin(), segments.end());
  move_starts(cage, at - 1, static_cast<Index>(segments.size()));
  cage.starts.insert(cage.starts.begin() + (loop - 1), at);
}

void erase_hole(Cage& cage, Index loop) {
  check(loop >= 1 && loop < cage.loops().count() && cage.is_hole(loop), "erase_hole: a hole");
  const Index first = cage.loops().first(loop), length = cage.loops().length(loop);
  cage.segments.erase(cage.segments.begin() + first, cage.segments.begin() + first + length);
  cage.starts.erase(cage.starts.begin() + (loop - 1));
  move_starts(cage, first, -length);
}

void add_part(Cage& cage, const Cage& part) {
  cage.parts.push_back(cage.size());
  for (Index l = 0; l < part.loops().count(); ++l)
    cage.starts.push_back(cage.size() + part.loops().first(l));
  cage.segments.insert(cage.segments.end(), part.segments.begin(), part.segments.end());
}

void erase_part(Cage& cage, Index part) {
  check(cage.part_count() > 1 && part < cage.part_count(), "erase_part: one of several");
  const Cage before = std::exchange(cage, part_of(cage, part == 0 ? 1 : 0));
  for (Index other = part == 0 ? 2 : 1; other < before.part_count(); ++other)
    if (other != part) add_part(cage, part_of(before, other));
}

LoopRange loops_of_part(const Cage& cage, Index part) {
  const auto loop_at = [&](Index p) {
    return p == 0 ? 0 : cage.loops().loop_of(cage.parts[static_cast<size_t>(p - 1)]);
  };
  return {loop_at(part), part + 1 < cage.part_count() ? loop_at(part + 1) : cage.loops().count()};
}

Cage part_of(const Cage& cage, Index part) {
  const auto [first, end] = loops_of_part(cage, part);
  Cage result = loop_of(cage, first);
  for (Index loop = first + 1; loop < end; ++loop) add_hole(result, loop_of(cage, loop).segments);
  return result;
}

Cage loop_of(const Cage& cage, Index loop) {
  const Loops loops = cage.loops();
  return {{cage.segments.begin() + loops.first(loop), cage.segments.begin() + loops.end(loop)}};
}

bool is_straight(const Cage& cage, Index segment) {
  return cage.degree(segment) == 1 || SegmentPolynomial(cage.controls(segment)).degree() <= 1;
}

bool is_straight(const Cage& cage) {
  for (Index i = 0; i < cage.size(); ++i)
    if (!is_straight(cage, i)) return false;
  return true;
}

Complex position_of(const Cage& cage, BoundaryPoint point) {
  return bezier_point(cage.controls(point.segment), point.t);
}

FlatCage flattened(const Cage& cage) {
  constexpr double kFlat = 5e-5;
  const double tolerance = kFlat * box_of(controls_of(cage)).diagonal();
  FlatCage flat;
  for (Index i = 0; i < cage.size(); ++i) {
    if (std::ranges::binary_search(cage.starts, i))
      flat.starts.push_back(static_cast<Index>(flat.points.size()));
    const Points controls = cage.controls(i);
    double bend = 0;  // upper bound on c'' / (n (n - 1)): the largest second difference
    for (size_t m = 0; m + 2 < controls.size(); ++m)
      bend = std::max(bend, std::abs(controls[m] - 2.0 * controls[m + 1] + controls[m + 2]));
    const double n = cage.degree(i), sagitta = n * (n - 1) * bend / 8;
    const int pieces =
        is_straight(cage, i)
            ? 1
            : static_cast<int>(std::clamp(std::ceil(std::sqrt(sagitta / tolerance)), 2.0, 1024.0));
    for (int k = 0; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      flat.points.push_back(k == 0 ? cage.vertex(i) : bezier_point(controls, t));
      flat.locations.push_back({i, t});
    }
  }
  return flat;
}

PartFinder::PartFinder(const Cage& cage) {
  for (Index part = 0; part < cage.part_count(); ++part)
    outlines_.push_back(flattened(part_of(cage, part)));
}

Index PartFinder::at(Complex z) const {
  Index best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t part = 0; part < outlines_.size() && outlines_.size() > 1; ++part) {
    if (encloses(outlines_[part], z)) return static_cast<Index>(part);
    const double distance = nearest_on_polygon(outlines_[part], z).distance;
    if (distance < nearest) nearest = distance, best = static_cast<Index>(part);
  }
  return best;
}

BoundaryPoint FlatCage::on_edge(Index i, double t) const {
  const auto& [segment, from] = locations[static_cast<size_t>(i)];
  const Index next = PolygonView(*this).loops().next(i);
  const BoundaryPoint& end = locations[static_cast<size_t>(next)];
  // The last edge of a segment ends at the start of the next segment.
  const double to = end.segment == segment && end.t > from ? end.t : 1;
  return {segment, from + t * (to - from)};
}

BoundaryPoint nearest_on(const Cage& cage, const FlatCage& flat, Complex z) {
  const NearestPoint near = nearest_on_polygon(flat, z);
  auto [segment, t] = flat.on_edge(near.edge, near.t);
  if (!is_straight(cage, segment)) {
    const SegmentPolynomial curve(cage.controls(segment));
    constexpr int kSteps = 6;  // Gauss-Newton steps, starting within 5e-5 of the cage's size
    for (int step = 0; step < kSteps; ++step) {
      const Root at{t, 1 - t};
      const Complex slope = curve.derivative(at);
      if (slope == 0.0) break;
      t = std::clamp(t - dot(slope, curve.at(at) - z) / std::norm(slope), 0.0, 1.0);
    }
  }
  return t < 1 ? BoundaryPoint{segment, t} : BoundaryPoint{cage.next(segment), 0};
}

std::string point_text(Complex z) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.6g, %.6g)", z.real(), z.imag());
  return text;
}

namespace {

/// Rounding must not change on which side of a nearby edge a vertex lies. This includes the
/// rounding of points that a mesher inserts on the edges. Each vertex must therefore keep some
/// distance from these edges: a needle must have an angle of at least kNeedle.
std::optional<Error> gap_fault(const FlatCage& flat) {
  constexpr double kNeedle = 1e-7;
  const Points& polygon = flat.points;
  const Loops loops = PolygonView(flat).loops();
  const Index n = static_cast<Index>(polygon.size());
  std::vector<double> along(polygon.size() + 1, 0);  // arc length of all edges up to each vertex
  for (Index e = 0; e < n; ++e)
    along[e + 1] = along[e] + std::abs(polygon[loops.next(e)] - polygon[e]);
  // The distance along the boundary between a vertex and an edge, in the shorter direction. No path
  // along the boundary leads to another loop, so the whole length counts.
  const auto boundary_distance = [&](Index vertex, Index edge) {
    const Index loop = loops.loop_of(edge);
    if (loops.loop_of(vertex) != loop) return along[n];
    const double length = along[loops.end(loop)] - along[loops.first(loop)];
    const double forward = along[vertex] - along[edge + 1], back = along[edge] - along[vertex];
    return forward >= 0 ? std::min(forward, length - along[vertex] + along[edge])
                        : std::min(back, length - along[edge + 1] + along[vertex]);
  };
  double largest = 0;
  for (const Complex& z : polygon) largest = std::max(largest, std::abs(z));
  const double gap =
      64 * std::numeric_limits<double>::epsilon() * (largest + box_of(polygon).diagonal());
  std::vector<Index> by_x(polygon.size());
  std::iota(by_x.begin(), by_x.end(), Index{0});
  std::ranges::sort(by_x, {}, [&](Index v) { return polygon[v].real(); });
  const double most = std::max(gap, kNeedle * along[n]);
  for (Index e = 0; e < n; ++e) {
    const Complex a = polygon[e], b = polygon[loops.next(e)];
    const auto [left, right] = std::minmax({a.real(), b.real()});
    const auto [low, high] = std::minmax({a.imag(), b.imag()});
    auto v =
        std::ranges::lower_bound(by_x, left - most, {}, [&](Index i) { return polygon[i].real(); });
    for (; v != by_x.end() && polygon[*v].real() <= right + most; ++v) {
      const Complex z = polygon[*v];
      if (*v == e || *v == loops.next(e) || z.imag() < low - most || z.imag() > high + most)
        continue;
      if (nearest_on_segment(a, b, z).distance <= std::max(gap, kNeedle * boundary_distance(*v, e)))
        return Error(ErrorKind::bad_input,
                     "the rest cage touches itself: point " +
                         std::to_string(flat.locations[*v].segment + 1) + " at " + point_text(z) +
                         " lies on segment " + std::to_string(flat.locations[e].segment + 1) +
                         "; move them apart",
                     z);
    }
  }
  return {};
}

/// A curve must have nonzero speed. At a point where c' = 0, it has a cusp, and the derivative of
/// the map has no limit there.
std::optional<Error> speed_fault(const Cage& cage, Index segment) {
  if (is_straight(cage, segment)) return {};
  const Points controls = cage.controls(segment);
  Points slopes;
  for (size_t m = 0; m + 1 < controls.size(); ++m) slopes.push_back(controls[m + 1] - controls[m]);
  const SegmentPolynomial speed(slopes);
  std::vector<Root> stops(std::max(speed.degree(), 0));
  if (speed.degree() > 0) speed.roots(Complex(0), stops);
  constexpr double kNear = 1e-5;
  for (const Root& stop : stops) {
    const double t = stop.s.real();
    if (std::abs(stop.s.imag()) > kNear || t < -kNear || t > 1 + kNear) continue;
    const Complex z = bezier_point(controls, std::clamp(t, 0.0, 1.0));
    const bool at_end = t < kNear || t > 1 - kNear;
    return Error(
        ErrorKind::bad_input,
        "rest cage segment " + std::to_string(segment + 1) +
            (at_end ? " has a tangent handle on top of its point at " : " has a cusp at ") +
            point_text(z) + "; pull its handles apart",
        z);
  }
  return {};
}

/// Two segments must not leave their common vertex in the same direction: rounding makes angles of
/// 0 and 2 pi indistinguishable there.
std::optional<Error> tip_fault(const Cage& cage) {
  constexpr double kTip = 1e-7;  // radians
  for (Index i = 0; i < cage.size(); ++i) {
    const Points before = cage.controls(cage.before(i)), own = cage.controls(i);
    const Complex z = own[0], in = before[before.size() - 2] - z, out = own[1] - z;
    if (dot(in, out) > 0 && std::abs(cross(in, out)) <= kTip * std::abs(in) * std::abs(out))
      return Error(ErrorKind::bad_input,
                   "the rest cage has a cusp at point " + std::to_string(i + 1) + ", " +
                       point_text(z) +
                       ": both of its segments start in the same direction; spread them apart",
                   z);
  }
  return {};
}

/// Rejects segments that are not polynomials, and coordinates so large that products of areas
/// overflow.
std::optional<Error> numbers_fault(const Cage& cage) {
  const auto fault = [](Index i, const std::string& what) {
    return Error(ErrorKind::bad_input, "rest cage segment " + std::to_string(i + 1) + " " + what);
  };
  for (Index i = 0; i < cage.size(); ++i) {
    if (cage.degree(i) < 1) return fault(i, "has no control points");
    if (cage.degree(i) > kHighestDegree)
      return fault(i, "has degree " + std::to_string(cage.degree(i)) + "; the highest degree is " +
                          std::to_string(kHighestDegree));
    for (const Complex& z : cage.segments[i]) {
      if (!is_finite(z)) return fault(i, "has a coordinate that is not a finite number");
      if (!is_moderate(z)) return fault(i, "has a coordinate that is too large (more than 1e70)");
    }
  }
  return {};
}

std::optional<Error> length_fault(const Cage& cage) {
  for (Index i = 0; i < cage.size(); ++i) {
    const Points controls = cage.controls(i);
    const bool moves =
        std::any_of(controls.begin(), controls.end(), [&](Complex z) { return z != controls[0]; });
    if (!moves || (cage.vertex(i) == cage.end_vertex(i) && is_straight(cage, i)))
      return Error(ErrorKind::bad_input,
                   "rest cage segment " + std::to_string(i + 1) + " at " +
                       point_text(cage.vertex(i)) + " has no length; delete one of its two points",
                   cage.vertex(i));
  }
  return {};
}

/// "hole 2", "part 3", "hole 1 of part 3"; empty for the first part.
std::string short_name(const Cage& cage, Index loop) {
  Index part = 0;
  while (part + 1 < cage.part_count() && loops_of_part(cage, part + 1).first <= loop) ++part;
  const Index hole = loop - loops_of_part(cage, part).first;
  return (hole > 0 ? "hole " + std::to_string(hole) : "") + (hole > 0 && part > 0 ? " of " : "") +
         (part > 0 ? "part " + std::to_string(part + 1) : "");
}

/// "the rest cage", "hole 2 of the rest cage", "hole 1 of part 3 of the rest cage".
std::string loop_name(const Cage& cage, Index loop) {
  const std::string name = short_name(cage, loop);
  return name + (name.empty() ? "" : " of ") + "the rest cage";
}

std::optional<Error> size_fault(const Cage& cage) {
  const Loops loops = cage.loops();
  for (Index l = 0; l < loops.count(); ++l)
    if (loops.length(l) < 3)
      return Error(ErrorKind::bad_input,
                   loop_name(cage, l) + " has " + std::to_string(loops.length(l)) + " segments; " +
                       (cage.is_hole(l) ? "a hole" : "a cage") + " needs at least three");
  return {};
}

std::optional<Error> crossing_fault(const Cage& cage, const FlatCage& flat) {
  const auto crossing = self_crossing(flat);
  if (!crossing) return {};
  const Loops loops = PolygonView(flat).loops();
  const Index first = loops.loop_of(crossing->first), second = loops.loop_of(crossing->second);
  const std::string outer = cage.parts.empty() ? "outer loop" : "first outline";
  const std::string what =
      first == second ? loop_name(cage, first) + " crosses itself"
      : first == 0    ? short_name(cage, second) + " crosses the " + outer + " of the rest cage"
      : cage.parts.empty() ? "holes " + std::to_string(first) + " and " + std::to_string(second) +
                                 " of the rest cage cross"
                           : short_name(cage, first) + " and " + short_name(cage, second) +
                                 " of the rest cage cross";
  return Error(ErrorKind::bad_input,
               what + ": segments " + std::to_string(flat.locations[crossing->first].segment + 1) +
                   " and " + std::to_string(flat.locations[crossing->second].segment + 1) +
                   " meet near " + point_text(crossing->point) + "; move one of their points",
               crossing->point);
}

/// Rejects loops without area, holes outside the outline of their part or inside other holes, and
/// parts inside other parts. The loops do not cross, so one point of each loop decides.
std::optional<Error> nesting_fault(const Cage& cage, const FlatCage& flat) {
  const PolygonView polygon = flat;
  const double size = box_of(flat).diagonal();
  for (Index l = 0; l < polygon.loops().count(); ++l) {
    const Complex start = polygon.loop(l)[0];
    if (!(std::abs(signed_area(polygon.loop(l))) > 1e-14 * size * size))
      return Error(ErrorKind::bad_input,
                   loop_name(cage, l) + " has no area; move its points off a common line", start);
  }
  for (Index part = 0; part < cage.part_count(); ++part) {
    const auto [first, end] = loops_of_part(cage, part);
    for (Index l = first + 1; l < end; ++l) {
      const Complex start = polygon.loop(l)[0];
      if (winding_number(polygon.loop(first), start) == 0)
        return Error(ErrorKind::bad_input,
                     short_name(cage, l) + " lies outside " + loop_name(cage, first) + ", at " +
                         point_text(start) + "; move it inside or delete it",
                     start);
      for (Index other = first + 1; other < end; ++other)
        if (other != l && winding_number(polygon.loop(other), start) != 0)
          return Error(ErrorKind::bad_input,
                       short_name(cage, l) + " lies inside " + short_name(cage, other) + ", at " +
                           point_text(start) + "; delete one of them",
                       start);
    }
  }
  if (cage.parts.empty()) return {};
  const std::vector<int> around = nesting_of(polygon);
  for (Index l = 0; l < polygon.loops().count(); ++l)
    if ((around[static_cast<size_t>(l)] % 2 == 1) != cage.is_hole(l))
      return Error(ErrorKind::bad_input,
                   loop_name(cage, l) + " lies inside another part, at " +
                       point_text(polygon.loop(l)[0]) +
                       "; parts must be apart, or in each other's holes",
                   polygon.loop(l)[0]);
  return {};
}

}  // namespace

std::optional<Error> rest_fault(const Cage& cage) {
  if (auto fault = size_fault(cage)) return fault;
  if (auto fault = numbers_fault(cage)) return fault;
  if (auto fault = length_fault(cage)) return fault;
  for (Index i = 0; i < cage.size(); ++i)
    if (auto fault = speed_fault(cage, i)) return fault;
  if (auto fault = tip_fault(cage)) return fault;
  const FlatCage flat = flattened(cage);
  if (auto fault = crossing_fault(cage, flat)) return fault;
  if (auto fault = gap_fault(flat)) return fault;
  return nesting_fault(cage, flat);
}

void check_rest_cage(const Cage& cage) {
  if (const auto fault = rest_fault(cage)) throw *fault;
}

}  // namespace holomorph
