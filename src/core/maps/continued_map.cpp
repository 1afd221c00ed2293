// An edge from a to b that goes to f(a) and f(b) has the factor (f(b) - f(a)) / (b - a). A vertex
// has the mean of its two edges' factors, which are interpolated along the edges.
#include "core/maps/continued_map.h"

#include <algorithm>
#include <optional>

#include "core/geometry/polygon.h"

namespace holomorph {

ContinuedMap::ContinuedMap(std::shared_ptr<const Mesh> mesh, VectorXc f, const PointMap& map)
    : mesh_(std::move(mesh)), locator_(*mesh_), f_(std::move(f)), linear_(mesh_, f_), map_(map) {
  const Loops loops = mesh_->boundary_loops();
  const size_t count = mesh_->boundary.size();
  std::vector<Complex> of_edges(count);
  factors_.resize(count);
  for (const int v : mesh_->boundary) boundary_.push_back(mesh_->vertices[static_cast<size_t>(v)]);
  for (size_t i = 0; i < count; ++i) {
    const auto next = static_cast<size_t>(loops.next(static_cast<Index>(i)));
    of_edges[i] =
        (f_[mesh_->boundary[next]] - f_[mesh_->boundary[i]]) / (boundary_[next] - boundary_[i]);
    if (!is_finite(of_edges[i])) of_edges[i] = 1;
  }
  for (size_t i = 0; i < count; ++i)
    factors_[i] =
        0.5 * (of_edges[i] + of_edges[static_cast<size_t>(loops.before(static_cast<Index>(i)))]);
}

ContinuedMap::Foot ContinuedMap::foot_of(Complex z) const {
  const NearestPoint nearest = nearest_on_polygon({boundary_, mesh_->starts}, z);
  const auto from = static_cast<size_t>(nearest.edge),
             to = static_cast<size_t>(mesh_->boundary_loops().next(nearest.edge));
  const Complex along = boundary_[to] - boundary_[from];
  const double length = std::abs(along), t = std::clamp(nearest.t, 0.0, 1.0);
  return {nearest.point, along / length, factors_[from] + t * (factors_[to] - factors_[from]),
          (factors_[to] - factors_[from]) / length, t == 0 || t == 1};
}

PointMap::Value ContinuedMap::finite_value(Complex z, const Value& value) const {
  const auto is_good = [](const Value& v) {
    return is_finite(v.f) && is_finite(v.fz) && is_finite(v.fzbar);
  };
  if (is_good(value)) return value;
  Value linear = linear_.at(z);
  if (is_good(linear)) return linear;
  return {z, 1, 0};
}

std::vector<PointMap::Value> ContinuedMap::values_at(std::span<const Complex> points) const {
  Points asked(points.begin(), points.end());
  std::vector<std::optional<Foot>> feet(points.size());
  for (size_t i = 0; i < points.size(); ++i)
    if (!locator_.at(points[i])) {
      feet[i] = foot_of(points[i]);
      asked[i] = feet[i]->at;
    }
  std::vector<Value> values = map_.values_at(asked);
  for (size_t i = 0; i < points.size(); ++i) {
    values[i] = finite_value(asked[i], values[i]);
    if (!feet[i]) continue;
    const auto& [at, edge, factor, factor_speed, is_corner] = *feet[i];
    const Complex away = points[i] - at;
    const Value inside = values[i];
    values[i] = {inside.f + factor * away, factor, 0};
    if (is_corner) continue;
    // The derivatives along the edge, with which the foot moves, and across.
    const Complex along = inside.fz * edge + inside.fzbar * std::conj(edge) + factor_speed * away;
    const Complex across = factor * edge * kI;
    values[i].fz = 0.5 * (along - kI * across) / edge;
    values[i].fzbar = 0.5 * (along + kI * across) / std::conj(edge);
  }
  return values;
}

}  // namespace holomorph
