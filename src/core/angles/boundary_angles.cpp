// Measures how far both cages turn at each vertex and along each segment, and sums the differences
// along the boundary.
#include "core/angles/boundary_angles.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace holomorph {
namespace {

double angle_between(Complex from, Complex to) {
  return std::arg(to * std::conj(from));
}

/// The directions of a segment at its start and end, and how far it turns between them.
struct SegmentTurn {
  Complex start = 0, end = 0;  ///< 0 if the segment's length is 0
  double turn = 0;
};

SegmentTurn segment_turn(const Points& controls) {
  double size = 0;
  for (const Complex& z : controls) size = std::max(size, std::abs(z));
  Points directions;
  constexpr double kRounding = 1e-13;  // due to degree elevation of a zero-length segment
  for (size_t i = 0; i + 1 < controls.size(); ++i)
    if (std::abs(controls[i + 1] - controls[i]) > kRounding * size)
      directions.push_back(controls[i + 1] - controls[i]);
  SegmentTurn course;
  if (directions.empty()) return course;
  course.start = directions.front();
  course.end = directions.back();
  if (controls.size() == 2) return course;
  constexpr int kSteps = 48;
  Points all;
  for (size_t i = 0; i + 1 < controls.size(); ++i) all.push_back(controls[i + 1] - controls[i]);
  Complex last = course.start;
  for (int k = 1; k <= kSteps; ++k) {
    const Complex direction =
        k < kSteps ? bezier_point(all, static_cast<double>(k) / kSteps) : course.end;
    if (direction == 0.0) continue;
    course.turn += angle_between(last, direction);
    last = direction;
  }
  return course;
}

/// How far a closed loop turns at its vertices and along its segments. The sum is 2 pi.
struct LoopTurns {
  std::vector<SegmentTurn> segments;
  std::vector<double> vertices;
};

LoopTurns turns_of(const Cage& cage, const LoopTurns* fallback) {
  LoopTurns turns;
  const size_t n = static_cast<size_t>(cage.size());
  double sum = 0;
  for (size_t e = 0; e < n; ++e) {
    turns.segments.push_back(segment_turn(cage.controls(static_cast<Index>(e))));
    if (turns.segments[e].start == 0.0 && fallback) turns.segments[e] = fallback->segments[e];
    sum += turns.segments[e].turn;
  }
  for (size_t j = 0; j < n; ++j) {
    turns.vertices.push_back(
        angle_between(turns.segments[(j + n - 1) % n].end, turns.segments[j].start));
    sum += turns.vertices[j];
  }
  for (; sum < kPi; sum += 2 * kPi) *std::ranges::min_element(turns.vertices) += 2 * kPi;
  for (; sum > 3 * kPi; sum -= 2 * kPi) *std::ranges::max_element(turns.vertices) -= 2 * kPi;
  return turns;
}

}  // namespace

BoundaryAngles boundary_angles(const Cage& rest, const Cage& pose,
                               const std::vector<Index>& corners,
                               const std::vector<PoseCorner>& own) {
  check(rest.size() == pose.size() && corners.size() == own.size(),
        "boundary angles: pose and rest match");
  const LoopTurns at_rest = turns_of(rest, nullptr), posed = turns_of(pose, &at_rest);
  const size_t n = static_cast<size_t>(rest.size()), p = corners.size();
  std::vector<double> starts(n);  // the angle at the start of each segment
  double angle = angle_between(at_rest.segments[0].start, posed.segments[0].start);
  for (size_t e = 0; e < n; ++e) {
    if (e > 0) angle += posed.vertices[e] - at_rest.vertices[e];
    starts[e] = angle;
    angle += posed.segments[e].turn - at_rest.segments[e].turn;
  }
  BoundaryAngles angles;
  angles.theta.resize(2 * static_cast<Index>(p));
  VectorXd jumps(static_cast<Index>(p));
  for (size_t k = 0; k < p; ++k) {
    const size_t j = static_cast<size_t>(corners[k]);
    const double after = starts[j] + own[k].after,
                 jump = posed.vertices[j] - at_rest.vertices[j] + own[k].after - own[k].before;
    jumps[static_cast<Index>(k)] = jump;
    angles.theta[static_cast<Index>(2 * k)] = after - jump;
    angles.theta[static_cast<Index>(2 * k + 1)] = after;
  }
  for (size_t k = 0; k < p; ++k) {
    const size_t next = (k + 1) % p;
    const double slack = 0.5 * (1 - own[k].tension);
    if (slack == 0) continue;
    angles.theta[static_cast<Index>(2 * k + 1)] -= slack * jumps[static_cast<Index>(k)];
    angles.theta[static_cast<Index>(2 * next)] += slack * jumps[static_cast<Index>(next)];
  }
  for (size_t k = 0; k < p; ++k) {
    const double inner = kPi - at_rest.vertices[static_cast<size_t>(corners[k])],
                 most = inner - std::min(kLeastCornerAngle, inner);
    double &before = angles.theta[static_cast<Index>(2 * k)],
           &after = angles.theta[static_cast<Index>(2 * k + 1)];
    const double excess = after - before - most;
    if (excess <= 0) continue;
    if (excess > 1e-9) angles.limited.push_back(corners[k]);
    before += excess / 2;
    after -= excess / 2;
  }
  return angles;
}

}  // namespace holomorph
