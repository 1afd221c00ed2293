// A grid over the posed triangles finds the starts; a step of Newton's method is shortened until it
// brings the point nearer.
#include "core/inverse.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/cauchy.h"

namespace holomorph {
namespace {

constexpr double kNear = 1e-4;  ///< of the control points' box: what `flattened` may be off, twice

}  // namespace

InverseMap::InverseMap(const Cage& rest, const Mesh& mesh, std::span<const Complex> positions,
                       const PointMap& map)
    : rest_(rest), mesh_(mesh), positions_(positions.begin(), positions.end()), map_(map) {
  size_ = box_of(mesh.vertices).diagonal();
  flat_ = flattened(rest);
  near_ = kNear * std::max(size_, box_of(controls_of(rest)).diagonal());
  for (const int v : mesh.boundary) boundary_.push_back(positions_[v]);
  for (size_t i = 0; i < boundary_.size(); ++i)
    reach_ = std::max(reach_, std::abs(boundary_[(i + 1) % boundary_.size()] - boundary_[i]));
  box_ = box_of(positions_);
  const double cell = std::sqrt(std::max(box_.width() * box_.height(), 1e-300) /
                                static_cast<double>(mesh.triangles.size() + 1));
  columns_ = static_cast<int>(std::clamp(box_.width() / cell, 1.0, 4096.0));
  rows_ = static_cast<int>(std::clamp(box_.height() / cell, 1.0, 4096.0));
  cells_.resize(static_cast<size_t>(columns_) * rows_);
  // Twice over the triangles: how many a cell has, then which.
  const auto for_each_cell = [&](int t, auto visit) {
    Box box;
    for (const int v : mesh.triangles[t]) box.include(positions_[v]);
    const size_t low = cell_of({box.left, box.bottom}), high = cell_of({box.right, box.top});
    for (size_t r = low / columns_; r <= high / columns_; ++r)
      for (size_t c = low % columns_; c <= high % columns_; ++c) visit(cells_[r * columns_ + c]);
  };
  const int count = static_cast<int>(mesh.triangles.size());
  for (int t = 0; t < count; ++t) for_each_cell(t, [](Cell& cell) { ++cell.count; });
  int total = 0;
  for (Cell& here : cells_) {
    here.first = total;
    total += std::exchange(here.count, 0);
  }
  triangles_.resize(total);
  for (int t = 0; t < count; ++t)
    for_each_cell(t, [&](Cell& cell) { triangles_[cell.first + cell.count++] = t; });
}

size_t InverseMap::cell_of(Complex w) const {
  const auto index = [](double x, double low, double width, int cells) {
    return static_cast<size_t>(
        std::clamp((x - low) / std::max(width, 1e-300) * cells, 0.0, cells - 1.0));
  };
  return index(w.imag(), box_.bottom, box_.height(), rows_) * columns_ +
         index(w.real(), box_.left, box_.width(), columns_);
}

int InverseMap::expected(Complex w) const {
  return winding_number(boundary_, w);
}

bool InverseMap::improve(Complex w, Preimage& at) const {
  PointMap::Value value = map_.at(at.z);
  at.residual = std::abs(w - value.f);
  const double scale = std::abs(w) + size_, enough = 1e-15 * scale, good = 1e-11 * scale;
  for (int step = 0; step < 40 && at.residual > enough; ++step) {
    // f_z d + f_zbar conj(d) = w - f.
    const Complex miss = w - value.f;
    const double area = std::norm(value.fz) - std::norm(value.fzbar);
    Complex move = (std::conj(value.fz) * miss - value.fzbar * std::conj(miss)) / area;
    if (!is_finite(move)) return false;
    if (std::abs(move) > 0.1 * size_) move *= 0.1 * size_ / std::abs(move);
    bool nearer = false;
    const int halves = at.residual <= good ? 1 : 8;  // rounding is not fought
    for (int half = 0; half < halves && !nearer; ++half, move *= 0.5) {
      const PointMap::Value next = map_.at(at.z + move);
      if (!(std::abs(w - next.f) < at.residual)) continue;
      nearer = true;
      value = next;
      at.z += move;
      at.residual = std::abs(w - next.f);
      break;
    }
    if (!nearer) break;
  }
  return at.residual <= good;
}

void InverseMap::add(Complex w, Complex start, std::vector<Preimage>& found) const {
  Preimage preimage{start, 0};
  if (!improve(w, preimage)) return;
  for (const Preimage& other : found)
    if (std::abs(other.z - preimage.z) < 1e-7 * size_) return;
  if (is_inside(preimage.z)) found.push_back(preimage);
}

bool InverseMap::is_inside(Complex z) const {
  const Points& outline = flat_.points;
  const NearestPoint near = nearest_on_polygon(outline, z);
  if (near.distance > near_) return winding_number(outline, z) != 0;
  // On the boundary rounding decides: a little inwards counts.
  const Complex side = outline[(near.edge + 1) % outline.size()] - outline[near.edge];
  const double left = signed_area(outline) > 0 ? 1 : -1;
  return contains(rest_, z) ||
         contains(rest_, z + left * 1e-10 * size_ * kI * side / std::abs(side));
}

std::vector<Preimage> InverseMap::at(Complex w) const {
  std::vector<Preimage> found;
  if (!is_finite(w)) return found;
  constexpr double kSlack = 0.3;  // a triangle's image is not the image's triangle
  constexpr size_t kAll = std::numeric_limits<size_t>::max();
  const auto try_cell = [&](size_t cell, double slack, size_t enough) {
    for (int i = cells_[cell].count; i-- > 0 && found.size() < enough;) {
      const auto [a, b, c] = mesh_.triangles[triangles_[cells_[cell].first + i]];
      const Complex p = positions_[a] - w, q = positions_[b] - w, r = positions_[c] - w;
      const double wa = cross(q, r), wb = cross(r, p), wc = cross(p, q), area = wa + wb + wc;
      if (area == 0 || std::min({wa / area, wb / area, wc / area}) < -slack) continue;
      add(w, (wa * mesh_.vertices[a] + wb * mesh_.vertices[b] + wc * mesh_.vertices[c]) / area,
          found);
    }
  };
  const size_t cell = cell_of(w);
  try_cell(cell, 1e-9, kAll);
  const size_t wanted = static_cast<size_t>(std::abs(expected(w)));
  if (!found.empty() && found.size() >= wanted) return found;
  if (wanted == 0 && nearest_on_polygon(boundary_, w).distance > reach_) return found;
  // Between the mesh's edge and the map's, or where triangles are too coarse: look around.
  const int column = static_cast<int>(cell % columns_), row = static_cast<int>(cell / columns_);
  for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(columns_ - 1, column + 1); ++c)
      try_cell(static_cast<size_t>(r) * columns_ + c, kSlack, std::max<size_t>(wanted, 1));
  if (!found.empty() && found.size() >= wanted) return found;
  std::vector<std::pair<double, int>> near;
  for (const int v : mesh_.boundary) near.push_back({std::norm(positions_[v] - w), v});
  const size_t starts = std::min<size_t>(near.size(), 6);
  std::partial_sort(near.begin(), near.begin() + static_cast<long>(starts), near.end());
  for (size_t i = 0; i < starts; ++i) add(w, mesh_.vertices[near[i].second], found);
  return found;
}

}  // namespace holomorph
