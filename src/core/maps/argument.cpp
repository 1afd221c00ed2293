// The winding number of a triangle is the number of times its edges cross the positive real axis,
// counted with signs. The winding numbers of all triangles add up to that of the boundary.
#include "core/maps/argument.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "core/error.h"

namespace holomorph {
namespace {

/// arg(b / a) in (-pi, pi]; exactly the negative of increment(b, a).
double increment(Complex a, Complex b) {
  return std::atan2(cross(a, b), dot(a, b));
}

/// How often the segment from a to b crosses the positive real axis: 1 upward, -1 downward, or 0.
int crossing(Complex a, Complex b) {
  const bool up = a.imag() < 0 && b.imag() >= 0, down = a.imag() >= 0 && b.imag() < 0;
  if (up && cross(a, b) > 0) return 1;
  if (down && cross(a, b) < 0) return -1;
  return 0;
}

/// The crossings along an edge, always computed from its lower vertex index to its higher one.
int edge_crossing(const VectorXc& values, int from, int to) {
  return from < to ? crossing(values[from], values[to]) : -crossing(values[to], values[from]);
}

}  // namespace

int winding_around_zero(const VectorXc& values) {
  double turn = 0;
  for (Index i = 0; i < values.size(); ++i)
    turn += increment(values[i], values[(i + 1) % values.size()]);
  return static_cast<int>(std::lround(turn / (2 * kPi)));
}

std::vector<Zero> zeros_of(const Mesh& mesh, const VectorXc& values) {
  std::vector<Zero> zeros;
  for (const auto& [a, b, c] : mesh.triangles) {
    const int winding =
        edge_crossing(values, a, b) + edge_crossing(values, b, c) + edge_crossing(values, c, a);
    if (winding != 0)
      zeros.push_back({(mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0, winding});
  }
  return zeros;
}

namespace {

/// Whether the argument may change by a full turn or more between two values.
bool is_uncertain(Complex from, Complex to) {
  constexpr double kCertain = 0.5, kRatio = 4;
  const Complex ratio = to / from;
  return !(std::abs(std::arg(ratio)) <= kCertain) || !(std::norm(ratio) < kRatio * kRatio) ||
         !(std::norm(ratio) > 1 / (kRatio * kRatio));
}

}  // namespace

VectorXd argument_changes(const std::vector<Step>& steps, const FunctionValues& at) {
  constexpr int kRounds = 20;
  struct Part {
    Index step;
    Step of;
  };
  VectorXd changes = VectorXd::Zero(static_cast<Index>(steps.size()));
  std::vector<Part> parts;
  for (const Step& step : steps) parts.push_back({static_cast<Index>(parts.size()), step});
  for (int round = 0; !parts.empty(); ++round) {
    std::vector<Part> unsure;
    Points middles;
    for (const Part& part : parts) {
      if (round < kRounds && is_uncertain(part.of.value_from, part.of.value_to)) {
        unsure.push_back(part);
        middles.push_back(0.5 * (part.of.from + part.of.to));
      } else {
        changes[part.step] += std::arg(part.of.value_to / part.of.value_from);
      }
    }
    parts.clear();
    if (middles.empty()) break;
    const VectorXc between = at(middles);
    for (size_t i = 0; i < unsure.size(); ++i) {
      const auto& [step, of] = unsure[i];
      const Complex value = between[static_cast<Index>(i)];
      parts.push_back({step, {of.from, middles[i], of.value_from, value}});
      parts.push_back({step, {middles[i], of.to, value, of.value_to}});
    }
  }
  return changes;
}

// Next to a zero that is close to the boundary, the argument changes by half a turn along a short
// piece of an edge, which other changes may hide. Edges of the boundary therefore start in pieces.
std::vector<Zero> zeros_of(const Mesh& mesh, const Points& points, const VectorXc& values,
                           const FunctionValues& at) {
  constexpr int kPieces = 8;
  std::map<std::pair<int, int>, int> uses;
  for (const Triangle& t : mesh.triangles)
    for (size_t a = 0; a < 3; ++a) ++uses[std::minmax(t[a], t[(a + 1) % 3])];
  Points inner;
  const auto point_on = [&](const std::pair<int, int>& edge, int k) {
    const Complex from = points[static_cast<size_t>(edge.first)],
                  to = points[static_cast<size_t>(edge.second)];
    return from + (to - from) * (1.0 * k / kPieces);
  };
  for (const auto& [edge, count] : uses)
    for (int k = 1; count == 1 && k < kPieces; ++k) inner.push_back(point_on(edge, k));
  const VectorXc between = inner.empty() ? VectorXc() : at(inner);
  std::vector<Step> steps;
  std::map<std::pair<int, int>, std::pair<Index, Index>> steps_of;  // first and number
  Index next = 0;
  for (const auto& [edge, count] : uses) {
    const int pieces = count == 1 ? kPieces : 1;
    steps_of[edge] = {static_cast<Index>(steps.size()), pieces};
    Complex from = points[static_cast<size_t>(edge.first)], value = values[edge.first];
    for (int k = 1; k < pieces; ++k) {
      const Complex to = point_on(edge, k), there = between[next++];
      steps.push_back({from, to, value, there});
      from = to;
      value = there;
    }
    steps.push_back({from, points[static_cast<size_t>(edge.second)], value, values[edge.second]});
  }
  const VectorXd changes = argument_changes(steps, at);
  std::vector<Zero> zeros;
  for (const Triangle& t : mesh.triangles) {
    double turn = 0;
    for (size_t a = 0; a < 3; ++a) {
      const int from = t[a], to = t[(a + 1) % 3];
      const auto [first, count] = steps_of.at(std::minmax(from, to));
      const double change = changes.segment(first, count).sum();
      turn += from < to ? change : -change;
    }
    if (const int winding = static_cast<int>(std::lround(turn / (2 * kPi))); winding != 0)
      zeros.push_back(
          {(mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0, winding});
  }
  return zeros;
}

namespace {

/// The samples at which a zero's jump may be placed: the sample nearest to the zero, and the
/// nearest sample across the domain. The two are more than a twentieth of the boundary apart.
std::vector<Index> jump_samples(std::span<const Complex> samples, Complex zero) {
  const Index m = static_cast<Index>(samples.size());
  const auto distance = [&](Index i) { return std::norm(samples[static_cast<size_t>(i)] - zero); };
  Index nearest = 0;
  for (Index i = 1; i < m; ++i)
    if (distance(i) < distance(nearest)) nearest = i;
  Index across = -1;
  const Index apart = m / 20;
  for (Index i = 0; i < m; ++i) {
    const Index gap = std::abs(i - nearest);
    if (std::min(gap, m - gap) <= apart) continue;
    if (distance(i) > distance((i + 1) % m) || distance(i) > distance((i + m - 1) % m)) continue;
    if (across < 0 || distance(i) < distance(across)) across = i;
  }
  if (across < 0) return {nearest};
  return {nearest, across};
}

VectorXd summed(double first, const VectorXd& steps) {
  VectorXd theta(steps.size());
  theta[0] = first;
  for (Index i = 1; i < steps.size(); ++i) theta[i] = theta[i - 1] + steps[i - 1];
  return theta;
}

/// The argument along a single loop.
VectorXd loop_argument(std::span<const Complex> samples, const VectorXc& values,
                       const std::vector<Zero>& zeros) {
  const Index m = values.size();
  check(m > 2 && static_cast<Index>(samples.size()) == m, "boundary_argument: sizes agree");
  VectorXd steps(m);
  for (Index i = 0; i < m; ++i) {
    if (values[i] == Complex(0) || !is_finite(values[i]))
      throw Error(ErrorKind::failed,
                  "the reference map's derivative is zero or not finite at a boundary sample; move "
                  "the handles near it",
                  samples[static_cast<size_t>(i)]);
    steps[i] = increment(values[i], values[(i + 1) % m]);
  }
  int turns = winding_around_zero(values);
  std::vector<std::vector<Index>> candidates;
  for (const Zero& zero : zeros) {
    candidates.push_back(jump_samples(samples, zero.position));
    turns -= zero.multiplicity;
  }
  std::vector<Index> order(static_cast<size_t>(m));  // order of jumps for unlisted zeros
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order, {}, [&](Index i) { return std::norm(values[i]); });
  for (size_t i = 0; turns != 0; ++i) {
    const int sign = turns > 0 ? 1 : -1;
    steps[order[i % order.size()]] -= 2 * kPi * sign;
    turns -= sign;
  }
  // In a narrow part of the domain, the jump can be on either side. The choice decides in which
  // direction the part turns. Take the combination with the smallest variance of theta, but prefer
  // the nearest sides unless the gain is clear.
  constexpr size_t kMostChoices = 6;
  constexpr double kClearly = 0.9;
  VectorXd best;
  double least = 0;
  const size_t choices = size_t{1} << std::min(zeros.size(), kMostChoices);
  for (size_t choice = 0; choice < choices; ++choice) {
    VectorXd jumped = steps;
    for (size_t i = 0; i < zeros.size(); ++i) {
      const bool across = candidates[i].size() > 1 && i < kMostChoices && (choice >> i & 1);
      jumped[candidates[i][across ? 1 : 0]] -= 2 * kPi * zeros[i].multiplicity;
    }
    VectorXd theta = summed(std::arg(values[0]), jumped);
    const double spread = (theta.array() - theta.mean()).square().sum();
    if (choice > 0 && spread >= least) continue;
    best = std::move(theta);
    least = choice == 0 ? kClearly * spread : spread;
  }
  return best;
}

/// The loop whose samples are nearest to z.
Index nearest_loop(PolygonView samples, Complex z) {
  Index nearest = 0;
  for (Index i = 1; i < samples.size(); ++i)
    if (std::norm(samples[i] - z) < std::norm(samples[nearest] - z)) nearest = i;
  return samples.loops().loop_of(nearest);
}

/// Adds whole turns to the argument of the loops until it is continuous from each loop to the
/// nearest one before it.
void join_loops(PolygonView samples, VectorXd& theta) {
  const Loops loops = samples.loops();
  std::vector<char> joined(static_cast<size_t>(loops.count()), 0);
  joined[0] = 1;
  for (Index round = 1; round < loops.count(); ++round) {
    Index from = 0, to = -1;
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < samples.size(); ++i)
      for (Index j = 0; j < samples.size(); ++j)
        if (joined[static_cast<size_t>(loops.loop_of(i))] &&
            !joined[static_cast<size_t>(loops.loop_of(j))])
          if (const double gap = std::norm(samples[i] - samples[j]); gap < least)
            least = gap, from = i, to = j;
    const Index loop = loops.loop_of(to);
    const double turns = std::round((theta[from] - theta[to]) / (2 * kPi));
    theta.segment(loops.first(loop), loops.length(loop)).array() += 2 * kPi * turns;
    joined[static_cast<size_t>(loop)] = 1;
  }
}

}  // namespace

bool winds_around_zero(PolygonView samples, const VectorXc& values) {
  const Loops loops = samples.loops();
  for (Index l = 0; l < loops.count(); ++l)
    if (winding_around_zero(values.segment(loops.first(l), loops.length(l))) != 0) return true;
  return false;
}

VectorXd boundary_argument(PolygonView samples, const VectorXc& values,
                           const std::vector<Zero>& zeros) {
  const Loops loops = samples.loops();
  check(samples.size() == values.size(), "boundary_argument: sizes agree");
  std::vector<std::vector<Zero>> of_loop(static_cast<size_t>(loops.count()));
  for (const Zero& zero : zeros)
    of_loop[static_cast<size_t>(nearest_loop(samples, zero.position))].push_back(zero);
  VectorXd theta(values.size());
  for (Index l = 0; l < loops.count(); ++l)
    theta.segment(loops.first(l), loops.length(l)) =
        loop_argument(samples.loop(l), values.segment(loops.first(l), loops.length(l)),
                      of_loop[static_cast<size_t>(l)]);
  join_loops(samples, theta);
  return theta;
}

}  // namespace holomorph
