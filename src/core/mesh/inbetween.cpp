// The energy is the sum over triangles of area (|f_z - a|^2 + |f_zbar - b|^2). Its matrix is the
// cotangent Laplacian.
#include "core/mesh/inbetween.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "core/arithmetic.h"
#include "core/error.h"

namespace holomorph {

Inbetween::Inbetween(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)) {
  const Index n = static_cast<Index>(mesh_->vertices.size()),
              count = static_cast<Index>(mesh_->triangles.size());
  areas_.resize(count);
  std::vector<Eigen::Triplet<double>> entries;
  std::map<std::pair<int, int>, int> triangle_left_of;
  for (Index i = 0; i < count; ++i) {
    const Triangle& t = mesh_->triangles[static_cast<size_t>(i)];
    areas_[i] = area_of(*mesh_, t);
    for (int a = 0; a < 3; ++a) {
      triangle_left_of[{t[a], t[(a + 1) % 3]}] = static_cast<int>(i);
      for (int b = 0; b < 3; ++b)
        entries.push_back(
            {t[a], t[b],
             dot(opposite_side(*mesh_, t, a), opposite_side(*mesh_, t, b)) / (8 * areas_[i])});
    }
  }
  neighbors_.assign(static_cast<size_t>(count), {-1, -1, -1});
  for (Index i = 0; i < count; ++i) {
    const Triangle& t = mesh_->triangles[static_cast<size_t>(i)];
    for (size_t a = 0; a < 3; ++a) {
      const auto neighbor = triangle_left_of.find({t[(a + 1) % 3], t[a]});
      if (neighbor != triangle_left_of.end())
        neighbors_[static_cast<size_t>(i)][a] = neighbor->second;
    }
  }
  std::vector<char> seen(static_cast<size_t>(count), 0);
  for (int first = 0; first < static_cast<int>(count); ++first) {
    if (seen[static_cast<size_t>(first)]) continue;
    seen[static_cast<size_t>(first)] = 1;
    const int still = std::ranges::min(mesh_->triangles[static_cast<size_t>(first)]);
    anchors_.emplace_back(still, entries[static_cast<size_t>(9 * first)].value());
    entries.push_back({still, still, anchors_.back().second});
    part_starts_.push_back(order_.size());
    order_.push_back({first, -1});
    for (size_t at = part_starts_.back(); at < order_.size(); ++at)
      for (const int next : neighbors_[static_cast<size_t>(order_[at].triangle)]) {
        if (next < 0 || std::exchange(seen[static_cast<size_t>(next)], 1)) continue;
        order_.push_back({next, order_[at].triangle});
      }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  laplacian_ = std::make_shared<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>(matrix);
  check(laplacian_->info() == Eigen::Success, "inbetween: the Laplacian is definite");
}

namespace {

/// A point of these triangles at which two maps agree, always the same one if they agree
/// everywhere. If there is none, the vertex whose two images are closest to each other.
Location least_moving_among(const std::vector<int>& triangles, const Mesh& mesh, const VectorXc& a,
                            const VectorXc& b) {
  Location best{triangles.front(), {1, 0, 0}};
  // Where rounding errors are all that the maps differ by, they must not choose the point.
  constexpr double kEqual = 1e-9;
  double most = 0;
  Box box;
  for (const int i : triangles)
    for (const int v : mesh.triangles[static_cast<size_t>(i)]) {
      most = std::max(most, std::abs(b[v] - a[v]));
      box.include(a[v]);
    }
  if (most <= kEqual * box.diagonal()) return best;
  double least = INFINITY;
  for (const int i : triangles) {
    const Triangle& t = mesh.triangles[static_cast<size_t>(i)];
    const std::array<Complex, 3> displacement{b[t[0]] - a[t[0]], b[t[1]] - a[t[1]],
                                              b[t[2]] - a[t[2]]};
    const Complex u = displacement[1] - displacement[0], v = displacement[2] - displacement[0];
    if (const double area = cross(u, v); area != 0) {
      const double second = cross(-displacement[0], v) / area,
                   third = cross(u, -displacement[0]) / area;
      if (second >= 0 && third >= 0 && second + third <= 1)
        return {i, {1 - second - third, second, third}};
    }
    for (size_t k = 0; k < 3; ++k)
      if (std::norm(displacement[k]) < least) {
        least = std::norm(displacement[k]);
        best = {i, {}};
        best.weights[k] = 1;
      }
  }
  return best;
}

Inbetween::Shape turned(Inbetween::Shape shape, int turns) {
  shape.logarithm.array() += Complex(0, 2 * kPi * turns);
  shape.turns += turns;
  return shape;
}

}  // namespace

// Around a triangle that is flipped, f_z may wind around zero, so that its argument depends on the
// path. Paths therefore go through as few of them as possible, and begin in the largest region that
// is not flipped.
std::vector<Inbetween::Visit> Inbetween::order_around(const std::vector<char>& flipped) const {
  std::vector<Visit> order;
  std::vector<char> seen(flipped.size(), 0);
  // The triangles that are reached from `first` without entering those that are flipped.
  const auto region_of = [&](int first) {
    std::vector<int> region{first};
    seen[static_cast<size_t>(first)] = 1;
    for (size_t at = 0; at < region.size(); ++at)
      for (const int next : neighbors_[static_cast<size_t>(region[at])])
        if (next >= 0 && !flipped[static_cast<size_t>(next)] &&
            !std::exchange(seen[static_cast<size_t>(next)], 1))
          region.push_back(next);
    return region;
  };
  std::vector<int> starts;
  for (size_t p = 0; p < part_starts_.size(); ++p) {
    const size_t end = p + 1 < part_starts_.size() ? part_starts_[p + 1] : order_.size();
    int best = order_[part_starts_[p]].triangle;
    double largest = 0;
    for (size_t i = part_starts_[p]; i < end; ++i) {
      const int triangle = order_[i].triangle;
      if (flipped[static_cast<size_t>(triangle)] || seen[static_cast<size_t>(triangle)]) continue;
      double area = 0;
      for (const int t : region_of(triangle)) area += areas_[t];
      if (area > largest) largest = area, best = triangle;
    }
    starts.push_back(best);
  }
  std::ranges::fill(seen, 0);
  for (const int start : starts) {
    // Triangles that are flipped, and what lies beyond them, come last.
    std::vector<Visit> now{{start, -1}}, later;
    while (!now.empty()) {
      for (size_t at = 0; at < now.size(); ++at) {
        const Visit visit = now[at];
        if (std::exchange(seen[static_cast<size_t>(visit.triangle)], 1)) continue;
        order.push_back(visit);
        for (const int next : neighbors_[static_cast<size_t>(visit.triangle)])
          if (next >= 0 && !seen[static_cast<size_t>(next)])
            (flipped[static_cast<size_t>(next)] ? later : now).push_back({next, visit.triangle});
      }
      now = std::exchange(later, {});
    }
  }
  return order;
}

Inbetween::Derivatives Inbetween::derivatives(const VectorXc& f, Index triangle) const {
  const Triangle& t = mesh_->triangles[static_cast<size_t>(triangle)];
  Derivatives sum{0, 0};
  for (int a = 0; a < 3; ++a) {
    const Complex e = opposite_side(*mesh_, t, a);
    sum.fz += times(-kI * std::conj(e), f[t[a]]);
    sum.fzbar += times(kI * e, f[t[a]]);
  }
  return {sum.fz / (4 * areas_[triangle]), sum.fzbar / (4 * areas_[triangle])};
}

void Inbetween::add_right_side(Index triangle, const Derivatives& wanted, VectorXc& right) const {
  const Triangle& t = mesh_->triangles[static_cast<size_t>(triangle)];
  const Complex fz = 0.25 * wanted.fz, fzbar = 0.25 * wanted.fzbar;
  for (int c = 0; c < 3; ++c) {
    const Complex e = opposite_side(*mesh_, t, c);
    right[t[c]] += times(kI * e, fz) + times(-kI * std::conj(e), fzbar);
  }
}

Inbetween::Shape Inbetween::shape_of(const VectorXc& f, int turns) const {
  const Index count = areas_.size();
  Shape shape{f, VectorXc(count), VectorXc(count), 0};
  VectorXc fz(count), fzbar(count);
  std::vector<char> flipped(static_cast<size_t>(count), 0);
  for (Index i = 0; i < count; ++i) {
    const auto [z, zbar] = derivatives(f, i);
    fz[i] = z;
    fzbar[i] = zbar;
    flipped[static_cast<size_t>(i)] = std::norm(fzbar[i]) >= std::norm(fz[i]);
  }
  const bool folds = std::ranges::find(flipped, 1) != flipped.end();
  constexpr double kLeast = 1e-9;  // lower bound of |f_z|
  for (const auto& [triangle, from] : folds ? order_around(flipped) : order_) {
    const double square = std::norm(fz[triangle]);
    double angle = square == 0 ? 0 : std::arg(fz[triangle]);
    if (from >= 0)
      angle += 2 * kPi * std::round((shape.logarithm[from].imag() - angle) / (2 * kPi));
    const bool vanishes = square < kLeast * kLeast;
    shape.logarithm[triangle] = {vanishes ? std::log(kLeast) : 0.5 * std::log(square), angle};
    shape.nu[triangle] = vanishes ? std::conj(fzbar[triangle]) / std::polar(kLeast, angle)
                                  : quotient(std::conj(fzbar[triangle]), fz[triangle]);
  }
  return turned(std::move(shape), turns);
}

/// The areas of the triangles that neither shape flips, and 0 for the others.
VectorXd Inbetween::areas_of_upright(const Shape& a, const Shape& b) const {
  return (a.nu.array().abs() < 1 && b.nu.array().abs() < 1)
      .select(areas_, VectorXd::Zero(areas_.size()));
}

Inbetween::Shape Inbetween::shape_after(const Shape& before, Shape shape,
                                        const ExpectedTurn& expected) const {
  const VectorXd areas = areas_of_upright(before, shape);
  // The rotation of the triangles from `first` on in the order.
  const auto rotation = [&](size_t first, size_t end) {
    double sum = 0, area = 0;
    for (const VectorXd* weights : {&areas, &areas_}) {
      for (size_t i = first; i < end; ++i) {
        const int t = order_[i].triangle;
        sum += (*weights)[t] * (shape.logarithm[t] - before.logarithm[t]).imag();
        area += (*weights)[t];
      }
      if (area > 0) break;  // otherwise all of them are flipped
    }
    return sum / area;
  };
  const auto end_of = [&](size_t part) {
    return part + 1 < part_starts_.size() ? part_starts_[part + 1] : order_.size();
  };
  // Each part turns by less than half a turn more or less than the first one.
  for (size_t p = 1; p < part_starts_.size(); ++p) {
    const double beyond = rotation(part_starts_[p], end_of(p)) - rotation(0, end_of(0)),
                 turns = std::round(beyond / (2 * kPi));
    for (size_t i = part_starts_[p]; i < end_of(p); ++i)
      shape.logarithm[order_[i].triangle] -= Complex(0, 2 * kPi * turns);
  }
  double now = rotation(0, order_.size());
  if (const auto at = expected.at ? locate(*mesh_, mesh_->vertices, *expected.at) : std::nullopt;
      at && areas[at->triangle] > 0)
    now = (shape.logarithm[at->triangle] - before.logarithm[at->triangle]).imag();
  constexpr double kMostTurns = 1e6;
  return turned(std::move(shape),
                static_cast<int>(std::clamp(std::round((expected.radians - now) / (2 * kPi)),
                                            -kMostTurns, kMostTurns)));
}

VectorXc Inbetween::slopes(const Shape* before, const Shape& here, const Shape* after,
                           double to_before, double to_after) const {
  VectorXc slopes = VectorXc::Zero(here.logarithm.size());
  if (!before || !after) return slopes;
  const double w1 = 2 * to_after + to_before, w2 = to_after + 2 * to_before;
  const auto slope = [&](double left, double right) {
    return left * right > 0 ? (w1 + w2) / (w1 / left + w2 / right) : 0.0;
  };
  for (Index i = 0; i < slopes.size(); ++i) {
    const Complex left = (here.logarithm[i] - before->logarithm[i]) / to_before,
                  right = (after->logarithm[i] - here.logarithm[i]) / to_after;
    slopes[i] = {slope(left.real(), right.real()), slope(left.imag(), right.imag())};
  }
  return slopes;
}

void Inbetween::blend(const Interval& interval, double u, VectorXc& f) const {
  const auto& [from, to, duration, slopes_a, slopes_b, still] = interval;
  const Shape &a = from, &b = to;  // Clang 14 does not capture structured bindings
  if (u <= 0 || u >= 1) {
    f = u <= 0 ? a.f : b.f;
    return;
  }
  const bool cubic = slopes_a && slopes_b;
  const double weight = cubic ? smoothstep(u) : u;
  const double from_a = duration * u * (1 - u) * (1 - u), from_b = -duration * u * u * (1 - u);
  VectorXc right = VectorXc::Zero(a.f.size());
  for (Index i = 0; i < areas_.size(); ++i) {
    Complex logarithm = (1 - weight) * a.logarithm[i] + weight * b.logarithm[i];
    if (cubic) logarithm += from_a * (*slopes_a)[i] + from_b * (*slopes_b)[i];
    const Complex nu = (1 - weight) * a.nu[i] + weight * b.nu[i];
    const Complex fz = std::polar(std::exp(logarithm.real()), logarithm.imag());
    add_right_side(i, {fz, std::conj(times(nu, fz))}, right);
  }
  f = laplacian_->solve(right);  // one pass over the factor for both parts
  const auto shift_at = [&](const Location& place) {
    const auto at = [&](const VectorXc& map) { return place.in(*mesh_, as_span(map)); };
    return (1 - weight) * at(a.f) + weight * at(b.f) - at(f);
  };
  if (part_starts_.size() == 1) {
    f.array() += shift_at(still ? *still : least_moving_point(*mesh_, a.f, b.f));
    return;
  }
  for (size_t p = 0; p < part_starts_.size(); ++p) {
    const size_t first = part_starts_[p],
                 end = p + 1 < part_starts_.size() ? part_starts_[p + 1] : order_.size();
    std::vector<int> triangles;
    for (size_t i = first; i < end; ++i) triangles.push_back(order_[i].triangle);
    const Complex shift = shift_at(least_moving_among(triangles, *mesh_, a.f, b.f));
    std::vector<char> moved(mesh_->vertices.size(), 0);
    for (const int triangle : triangles)
      for (const int v : mesh_->triangles[static_cast<size_t>(triangle)])
        if (!std::exchange(moved[static_cast<size_t>(v)], 1)) f[v] += shift;
  }
}

bool Inbetween::unfold(VectorXc& f) const {
  constexpr int kRounds = 200;
  constexpr double kLargest = 0.9, kEnough = 0.95;  // |f_zbar / f_z|
  for (int round = 0; round < kRounds; ++round) {
    VectorXc right = VectorXc::Zero(f.size());
    bool folds = false;
    for (Index i = 0; i < areas_.size(); ++i) {
      Derivatives now = derivatives(f, i);
      const double z = std::abs(now.fz), zbar = std::abs(now.fzbar);
      folds = folds || zbar > kEnough * z;
      if (zbar > kLargest * z && z > 0) {
        const double nearest = (z + kLargest * zbar) / (1 + kLargest * kLargest);
        now = {nearest / z * now.fz, kLargest * nearest / zbar * now.fzbar};
      }
      add_right_side(i, now, right);
    }
    if (!folds) return true;
    for (const auto& [vertex, weight] : anchors_) right[vertex] += weight * f[vertex];
    f = laplacian_->solve(right);
  }
  return false;
}

Location least_moving_point(const Mesh& mesh, const VectorXc& a, const VectorXc& b) {
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return least_moving_among(all, mesh, a, b);
}

}  // namespace holomorph
