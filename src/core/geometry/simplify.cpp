// A queue of candidate changes. Each change removes a triangle from the polygon or adds one. It is
// valid if its triangle contains no other vertex, which rules out crossings. A removed triangle
// must not contain a kept point either.
#include "core/geometry/simplify.h"

#include <algorithm>
#include <queue>

#include "core/geometry/orientation.h"
#include "core/geometry/polyline.h"

namespace holomorph {
namespace {

bool in_triangle(Complex a, Complex b, Complex c, Complex z) {
  const double u = cross(b - a, z - a), v = cross(c - b, z - b), w = cross(a - c, z - c);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// A simple polygon without its vertices on straight lines, up to rounding.
Points without_straight_vertices(const Points& polygon) {
  constexpr double kRounding = 1e-12;
  const double size = box_of(polygon).diagonal();
  Points kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Complex a = kept.empty() ? polygon.back() : kept.back(), b = polygon[i],
                  c = polygon[(i + 1) % polygon.size()];
    if (std::abs(cross(b - a, c - a)) > kRounding * size * std::abs(c - a)) kept.push_back(b);
  }
  return kept;
}

class Simplifier {
 public:
  Simplifier(std::span<const Complex> polygon, std::span<const Complex> kept, Simplified kind)
      : kept_(kept.begin(), kept.end()), kind_(kind), left_(static_cast<int>(polygon.size())) {
    const int n = left_;
    for (int i = 0; i < n; ++i)
      nodes_.push_back({polygon[i], (i + n - 1) % n, (i + 1) % n, 0, true});
    std::sort(kept_.begin(), kept_.end(), [](Complex a, Complex b) { return a.real() < b.real(); });
    for (int i = 0; i < n; ++i) propose(i);
  }

  Points run(int count) {
    while (left_ > std::max(count, 3) && !queue_.empty()) {
      const Change change = queue_.top();
      queue_.pop();
      if (!nodes_[change.node].alive || nodes_[change.node].version != change.version) continue;
      if (change.corner ? extend(change.node) : drop(change.node)) --left_;
    }
    Points result;
    const int start = static_cast<int>(
        std::find_if(nodes_.begin(), nodes_.end(), [](const Node& n) { return n.alive; }) -
        nodes_.begin());
    int i = start;
    do {
      result.push_back(nodes_[i].z);
      i = nodes_[i].next;
    } while (i != start);
    return result;
  }

 private:
  struct Node {
    Complex z;
    int previous, next, version;
    bool alive;
  };
  struct Change {
    double cost;
    int node, version;
    bool corner;  ///< replace this node and the next by a corner; otherwise drop this node
    bool operator<(const Change& other) const { return cost > other.cost; }
  };

  Complex at(int i) const { return nodes_[i].z; }

  /// The point where the edge before node i and the edge after the next node meet when both are
  /// extended. None if they do not meet.
  std::optional<Complex> corner_of(int i) const {
    const int j = nodes_[i].next;
    const Complex a = at(nodes_[i].previous), b = at(i), c = at(j), d = at(nodes_[j].next);
    const double turn = cross(b - a, c - d);
    if (nodes_[j].next == nodes_[i].previous || cross(b - a, c - b) <= 0 ||
        cross(c - b, d - c) <= 0 || turn >= 0)
      return {};
    const double t = cross(c - b, c - d) / turn;
    return b + t * (b - a);
  }

  void propose(int i) {
    Node& node = nodes_[i];
    ++node.version;
    const Complex a = at(node.previous), c = at(node.next);
    queue_.push({std::abs(cross(node.z - a, c - a)), i, node.version, false});
    if (kind_ == Simplified::subset) return;
    if (const auto corner = corner_of(i))
      queue_.push(
          {std::abs(cross(*corner - node.z, at(node.next) - node.z)), i, node.version, true});
  }

  /// Whether the triangle contains no vertex except `corners` and, if it is removed, no kept point.
  bool is_free(Complex a, Complex b, Complex c, std::initializer_list<int> corners,
               bool loss) const {
    const double left = std::min({a.real(), b.real(), c.real()}),
                 right = std::max({a.real(), b.real(), c.real()});
    if (loss) {
      auto point = std::lower_bound(kept_.begin(), kept_.end(), left,
                                    [](Complex z, double x) { return z.real() < x; });
      for (; point != kept_.end() && point->real() <= right; ++point)
        if (in_triangle(a, b, c, *point)) return false;
    }
    const int start = *corners.begin();
    for (int i = nodes_[start].next; i != start; i = nodes_[i].next) {
      const double x = at(i).real();
      if (x < left || x > right || std::find(corners.begin(), corners.end(), i) != corners.end())
        continue;
      if (in_triangle(a, b, c, at(i))) return false;
    }
    return true;
  }

  /// Whether no other edge crosses the sides bp and pc of the new triangle (b, p, c), where bc is
  /// the edge after node i.
  bool is_uncut(int i, Complex p) const {
    const int j = nodes_[i].next;
    const auto crosses = [](Complex a, Complex b, Complex c, Complex d) {
      return cross(b - a, c - a) * cross(b - a, d - a) <= 0 &&
             cross(d - c, a - c) * cross(d - c, b - c) <= 0;
    };
    // Tests the edges from d around to a. The added edges extend the edges ab and cd and cannot
    // cross them.
    for (int k = nodes_[j].next; k != nodes_[i].previous; k = nodes_[k].next)
      if (crosses(at(i), p, at(k), at(nodes_[k].next)) ||
          crosses(p, at(j), at(k), at(nodes_[k].next)))
        return false;
    return true;
  }

  void refresh_around(int i) {
    for (const int k : {nodes_[nodes_[i].previous].previous, nodes_[i].previous, i, nodes_[i].next})
      propose(k);
  }

  bool drop(int i) {
    const int before = nodes_[i].previous, after = nodes_[i].next;
    const Complex a = at(before), b = at(i), c = at(after);
    const bool loss = cross(b - a, c - a) > 0;
    if (!is_free(a, b, c, {i, before, after}, loss)) return false;
    if (nodes_[nodes_[after].next].z == a) return false;
    nodes_[i].alive = false;
    nodes_[before].next = after;
    nodes_[after].previous = before;
    refresh_around(after);
    return true;
  }

  bool extend(int i) {
    const auto corner = corner_of(i);
    const int j = nodes_[i].next;
    if (!corner || !is_free(at(i), *corner, at(j), {i, j}, false) || !is_uncut(i, *corner))
      return false;
    nodes_[i].z = *corner;
    nodes_[j].alive = false;
    nodes_[i].next = nodes_[j].next;
    nodes_[nodes_[j].next].previous = i;
    refresh_around(i);
    return true;
  }

  std::vector<Node> nodes_;
  Points kept_;
  Simplified kind_;
  std::priority_queue<Change> queue_;
  int left_;
};

}  // namespace

Points simplified_around(std::span<const Complex> polygon, std::span<const Complex> kept, int count,
                         Simplified kind) {
  if (static_cast<int>(polygon.size()) <= std::max(count, 3))
    return {polygon.begin(), polygon.end()};
  return Simplifier(polygon, kept, kind).run(count);
}

Cage thinned_around(const Cage& cage, double tolerance) {
  if (!is_straight(cage)) return oriented(cage);
  const Cage whole = oriented(cage);
  const Points outer = without_straight_vertices(vertices_of(loop_of(whole, 0)));
  const Polyline boundary(outer, true);
  const auto is_near = [&](const Points& polygon) {
    const Polyline other(polygon, true);
    return std::max(one_sided_distance(other, boundary), one_sided_distance(boundary, other)) <=
           tolerance;
  };
  Points best = outer;
  int fewest = 3, most = static_cast<int>(outer.size());
  while (fewest < most) {
    const int middle = (fewest + most) / 2;
    Points polygon = simplified_around(outer, outer, middle);
    // Fewer vertices than that may be impossible.
    const int reached = static_cast<int>(polygon.size());
    if (is_near(polygon)) {
      most = std::min(middle, reached);
      best = std::move(polygon);
    } else {
      fewest = middle + 1;
    }
    if (reached > middle) fewest = std::max(fewest, reached);
  }
  Cage result = polygon_cage(best);
  for (Index l = 1; l < whole.loops().count(); ++l)
    add_hole(result,
             polygon_cage(without_straight_vertices(vertices_of(loop_of(whole, l)))).segments);
  return result;
}

}  // namespace holomorph
