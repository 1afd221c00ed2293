// A grid over the posed triangles provides the starting points of Newton's method. A step is halved
// until it reduces the residual.
#include "core/maps/inverse.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/cauchy/cauchy.h"
#include "core/geometry/orientation.h"
#include "core/maps/distortion.h"

namespace holomorph {
namespace {

constexpr double kNearby =
    1e-4;  ///< relative to the control points' box; twice the error of `flattened`
constexpr double kSame = 1e-7;  ///< relative to the size; preimages closer than this are the same
constexpr double kOn = 1e-12;
constexpr double kBranch = 1e-5;

int oriented(const std::vector<Preimage>& found) {
  int sum = 0;
  for (const Preimage& preimage : found) sum += preimage.orientation;
  return sum;
}

}  // namespace

InverseMap::InverseMap(const Cage& rest, const Mesh& mesh, std::span<const Complex> positions,
                       const PointMap& map)
    : rest_(oriented(rest)),
      inside_(rest_),
      mesh_(mesh),
      positions_(positions.begin(), positions.end()),
      map_(map),
      winding_(rest_, map) {
  size_ = box_of(mesh.vertices).diagonal();
  flat_ = flattened(rest_);
  near_ = kNearby * std::max(size_, box_of(controls_of(rest_)).diagonal());
  grid_ = BoxGrid(box_of(positions_), mesh.triangles.size());
  cells_.resize(grid_.size());
  outer_ = boundary_marks(mesh);
  fill_cells();
  set_up_boundary();
}

/// Makes two passes over the triangles. The first counts the triangles in each cell; the second
/// stores them.
void InverseMap::fill_cells() {
  const auto box_of_triangle = [&](int t) {
    Box box;
    for (const int v : mesh_.triangles[t]) box.include(positions_[v]);
    return box;
  };
  const int count = static_cast<int>(mesh_.triangles.size());
  for (int t = 0; t < count; ++t)
    for_each_cell(box_of_triangle(t), [](Cell& cell) { ++cell.count; });
  int total = 0;
  for (Cell& here : cells_) {
    here.first = total;
    total += std::exchange(here.count, 0);
  }
  triangles_.resize(static_cast<size_t>(total));
  for (int t = 0; t < count; ++t)
    for_each_cell(box_of_triangle(t),
                  [&](Cell& cell) { triangles_[cell.first + cell.count++] = t; });
  constexpr double kSheared = 0.7;  // for larger |f_zbar| / |f_z|, a fold may be near
  const VectorXc f =
      Eigen::Map<const VectorXc>(positions_.data(), static_cast<Index>(positions_.size()));
  for (int t = 0; t < count; ++t) {
    const auto [fz, fzbar] = derivatives_in(mesh_, mesh_.triangles[t], f);
    if (std::abs(fzbar) <= kSheared * std::abs(fz)) continue;
    Box box = box_of_triangle(t);
    const Complex around = 0.5 * Complex(box.width(), box.height());
    box.include(Complex(box.left, box.bottom) - around);
    box.include(Complex(box.right, box.top) + around);
    for_each_cell(box, [](Cell& cell) { cell.may_fold = true; });
  }
}

void InverseMap::set_up_boundary() {
  piece_at_.assign(mesh_.vertices.size(), -1);
  const std::vector<Arc> arcs = boundary_arcs(rest_, mesh_);
  for (size_t i = 0; i < arcs.size(); ++i) {
    const int v = mesh_.boundary[i];
    boundary_.push_back(positions_[v]);
    piece_at_[v] = static_cast<int>(pieces_.size());
    pieces_.push_back(winding_.piece(arcs[i]));
    const ImageWinding::Piece& piece = pieces_.back();
    reach_ = std::max(reach_, std::abs(piece.to - piece.from));
    Box box;
    for (const Complex& z : {piece.from, piece.to})
      for (const Complex& by : {Complex(1, 1), Complex(-1, -1)}) box.include(z + piece.bulge * by);
    for_each_cell(box, [](Cell& cell) { cell.on_boundary = true; });
  }
}

std::optional<int> InverseMap::winding(Complex w) const {
  if (grid_.box.contains(w) && !cells_[grid_.cell_of(w)].on_boundary)
    return winding_number({boundary_, mesh_.starts}, w);
  return winding_.turns(pieces_, w);
}

bool InverseMap::improve(Complex w, Preimage& at) const {
  PointMap::Value value = map_.at(at.z);
  at.residual = std::abs(w - value.f);
  const double scale = std::abs(w) + size_, enough = 1e-15 * scale, good = 1e-11 * scale;
  for (int step = 0; step < 40 && at.residual > enough; ++step) {
    // Solve f_z d + f_zbar conj(d) = w - f for the step d.
    const Complex miss = w - value.f;
    const double area = std::norm(value.fz) - std::norm(value.fzbar);
    Complex move = (std::conj(value.fz) * miss - value.fzbar * std::conj(miss)) / area;
    if (!is_finite(move)) return false;
    if (std::abs(move) > 0.1 * size_) move *= 0.1 * size_ / std::abs(move);
    bool nearer = false;
    const int halves =
        at.residual <= good ? 1 : 8;  // close to rounding error, halving does not help
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
  at.orientation = std::norm(value.fz) < std::norm(value.fzbar) ? -1 : 1;
  return at.residual <= good;
}

/// The start. If it lies outside a curved cage, it is moved toward the center of its boundary
/// triangle, because the map may be undefined between a curve and the mesh's chord.
Complex InverseMap::pulled_inside(Complex start, int triangle) const {
  if (triangle < 0) return start;
  const auto [a, b, c] = mesh_.triangles[triangle];
  if ((!outer_[a] && !outer_[b] && !outer_[c]) || is_straight(rest_)) return start;
  const Complex middle = (mesh_.vertices[a] + mesh_.vertices[b] + mesh_.vertices[c]) / 3.0;
  for (int half = 0; half < 8 && !inside_.contains(start); ++half) start = 0.5 * (start + middle);
  return start;
}

void InverseMap::add(Complex w, Complex start, int triangle, std::vector<Preimage>& found) const {
  Preimage preimage{pulled_inside(start, triangle), 0, triangle};
  if (!improve(w, preimage)) return;
  for (const Preimage& other : found)
    if (std::abs(other.z - preimage.z) < kSame * size_) return;
  if (is_in_inner_triangle(preimage) || is_inside(preimage.z)) found.push_back(preimage);
}

/// Whether a preimage lies in its own triangle and no vertex of that triangle is on the boundary.
/// Such a preimage is inside the cage.
bool InverseMap::is_in_inner_triangle(const Preimage& preimage) const {
  if (preimage.triangle < 0) return false;
  const auto [i, j, k] = mesh_.triangles[preimage.triangle];
  if (outer_[i] || outer_[j] || outer_[k]) return false;
  const Complex a = mesh_.vertices[i] - preimage.z, b = mesh_.vertices[j] - preimage.z,
                c = mesh_.vertices[k] - preimage.z;
  return cross(a, b) >= 0 && cross(b, c) >= 0 && cross(c, a) >= 0;
}

bool InverseMap::is_inside(Complex z) const {
  const PolygonView outline = flat_;
  const NearestPoint near = nearest_on_polygon(outline, z);
  if (near.distance > near_) return encloses(outline, z);
  // On the boundary the result depends on rounding. A point therefore also counts as inside if a
  // tiny step inward moves it inside.
  const Complex side = outline[outline.loops().next(near.edge)] - outline[near.edge];
  return inside_.contains(z) || inside_.contains(z + 1e-10 * size_ * kI * side / std::abs(side));
}

std::vector<Preimage> InverseMap::at(Complex w) const {
  if (!is_finite(w)) return {};
  std::vector<Preimage> found = find(w);
  if (found.size() < 2) return found;
  for (Preimage& preimage : found)
    if (preimage.triangle < 0) preimage.triangle = locate_near(mesh_, preimage.z).triangle;
  std::ranges::stable_sort(found, std::ranges::greater{}, &Preimage::triangle);
  return found;
}

/// All preimages, in any order. Those that were found from a vertex have no triangle.
std::vector<Preimage> InverseMap::find(Complex w) const {
  const std::optional<int> wanted = winding(w);
  std::vector<Preimage> found = newton_from_grid(w, wanted);
  if (!wanted || oriented(found) == *wanted) return found;
  // The count may include points slightly outside the cage. On the boundary itself the count is
  // undefined.
  std::vector<Preimage> inner;
  for (const Preimage& preimage : found) {
    if (nearest_on_polygon(flat_, preimage.z).distance <= kOn * size_) return found;
    if (inside_.contains(preimage.z)) inner.push_back(preimage);
  }
  if (oriented(inner) == *wanted) return inner;
  std::vector<Preimage> all = search_triangles(w, *wanted);
  const auto off = [&](const std::vector<Preimage>& some) {
    return std::abs(oriented(some) - *wanted);
  };
  return off(all) < off(found) ? all : found;
}

/// Runs Newton's method from the triangles whose images contain w or are near w.
std::vector<Preimage> InverseMap::newton_from_grid(Complex w, std::optional<int> wanted) const {
  std::vector<Preimage> found;
  constexpr double kSlack = 0.3;  // a triangle's image is not exactly a triangle
  constexpr int kAll = std::numeric_limits<int>::max();
  const auto try_cell = [&](size_t cell, double slack, int enough) {
    for (int i = cells_[cell].count; i-- > 0 && static_cast<int>(found.size()) < enough;) {
      const int t = triangles_[cells_[cell].first + i];
      const auto [a, b, c] = mesh_.triangles[t];
      const Complex p = positions_[a] - w, q = positions_[b] - w, r = positions_[c] - w;
      const double wa = cross(q, r), wb = cross(r, p), wc = cross(p, q), area = wa + wb + wc;
      if (area == 0 || std::min({wa / area, wb / area, wc / area}) < -slack) continue;
      add(w, (wa * mesh_.vertices[a] + wb * mesh_.vertices[b] + wc * mesh_.vertices[c]) / area, t,
          found);
    }
  };
  // Next to a fold, preimages of opposite orientation cancel in the count, so all starts are tried.
  const size_t cell = grid_.cell_of(w);
  const bool may_fold = cells_[cell].may_fold;
  const auto is_enough = [&] {
    return !may_fold && (wanted ? oriented(found) == *wanted : !found.empty());
  };
  try_cell(cell, 1e-9, kAll);
  if (is_enough()) return found;
  // w may lie between the images of the mesh's boundary and of the cage, or the triangles may be
  // too coarse here. Try the neighboring cells.
  const int column = static_cast<int>(cell) % grid_.columns,
            row = static_cast<int>(cell) / grid_.columns;
  const int enough = may_fold ? kAll : wanted ? std::max(std::abs(*wanted), 1) : 1;
  for (int r = std::max(0, row - 1); r <= std::min(grid_.rows - 1, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(grid_.columns - 1, column + 1); ++c)
      try_cell(static_cast<size_t>(r * grid_.columns + c), kSlack, enough);
  if (is_enough()) return found;
  std::vector<std::pair<double, int>> near;
  for (const int v : mesh_.boundary) near.push_back({std::norm(positions_[v] - w), v});
  const size_t starts = std::min<size_t>(near.size(), 6);
  std::partial_sort(near.begin(), near.begin() + static_cast<long>(starts), near.end());
  for (size_t i = 0; i < starts; ++i) add(w, mesh_.vertices[near[i].second], -1, found);
  return found;
}

Arc InverseMap::side(int from, int to) const {
  const int own = piece_at_[from], back = piece_at_[to];
  if (own >= 0 && pieces_[own].arc.to == mesh_.vertices[to]) return pieces_[own].arc;
  if (back >= 0 && pieces_[back].arc.to == mesh_.vertices[from]) {
    const Arc& arc = pieces_[back].arc;
    return {arc.to, arc.from, arc.segment, arc.end, arc.start};
  }
  return {mesh_.vertices[from], mesh_.vertices[to]};
}

std::optional<int> InverseMap::turns(const Region& region, Complex w) const {
  std::array<ImageWinding::Piece, 3> loop;
  for (size_t k = 0; k < 3; ++k) loop[k] = winding_.piece(region[k]);
  return winding_.turns(loop, w);
}

/// Searches triangle by triangle with the argument principle, starting with triangles near w.
std::vector<Preimage> InverseMap::search_triangles(Complex w, int wanted) const {
  std::vector<Preimage> found;
  std::vector<std::pair<double, int>> order;
  for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const auto [a, b, c] = mesh_.triangles[t];
    Box box;
    for (const int v : {a, b, c}) box.include(positions_[v]);
    const double slack = box.diagonal() + (outer_[a] || outer_[b] || outer_[c] ? reach_ : 0);
    order.emplace_back(std::abs(w - box.center()) / std::max(slack, 1e-300), static_cast<int>(t));
  }
  std::ranges::sort(order);
  constexpr double kFarthest = 8;  // in triangle sizes; a triangle's image does not extend that far
  for (const auto& [distance, t] : order) {
    if (distance > 1 && (distance > kFarthest || oriented(found) == wanted)) break;
    const auto [a, b, c] = mesh_.triangles[t];
    const Region region{side(a, b), side(b, c), side(c, a)};
    const auto count = turns(region, w);
    const size_t before = found.size();
    if (count && *count != 0) search_region(region, *count, w, 0, found);
    for (size_t i = before; i < found.size(); ++i) found[i].triangle = t;
  }
  return found;
}

/// The preimages in a region that Newton's method finds from a few starting points.
std::vector<Preimage> InverseMap::inside(const Region& region, Complex w) const {
  const Complex a = region[0].from, b = region[1].from, c = region[2].from;
  const double area = cross(b - a, c - a), sign = area < 0 ? -1 : 1;
  const bool curved = std::ranges::any_of(region, [](const Arc& arc) { return arc.segment >= 0; });
  const double beyond = -(curved ? 0.2 : 1e-9) * std::abs(area);
  const auto is_in = [&](Complex z) {
    return sign * cross(b - a, z - a) >= beyond && sign * cross(c - b, z - b) >= beyond &&
           sign * cross(a - c, z - c) >= beyond && (!curved || is_inside(z));
  };
  std::vector<Preimage> here;
  for (const Complex start : {(a + b + c) / 3.0, (4.0 * a + b + c) / 6.0, (a + 4.0 * b + c) / 6.0,
                              (a + b + 4.0 * c) / 6.0}) {
    Preimage preimage{start};
    if (!improve(w, preimage) || !is_in(preimage.z)) continue;
    if (std::ranges::none_of(here, [&](const Preimage& other) {
          return std::abs(other.z - preimage.z) < kSame * size_;
        }))
      here.push_back(preimage);
  }
  return here;
}

/// Adds the preimages in a region. The image of the region's boundary winds around w `count` times.
void InverseMap::search_region(const Region& region, int count, Complex w, int depth,
                               std::vector<Preimage>& found) const {
  const std::vector<Preimage> here = inside(region, w);
  if (oriented(here) == count) {
    found.insert(found.end(), here.begin(), here.end());
    return;
  }
  const Complex a = region[0].from, b = region[1].from, c = region[2].from;
  const double size = std::max({std::abs(b - a), std::abs(c - b), std::abs(a - c)});
  constexpr int kDeepest = 40;
  // Cut into four parts. If a cut passes through a preimage, cut at another fraction.
  for (const double fraction : {0.5, 0.43, 0.59, 0.37}) {
    if (size < kBranch * size_ || depth == kDeepest) break;
    std::array<std::array<Arc, 2>, 3> halves;
    for (size_t k = 0; k < 3; ++k) halves[k] = cut_arc(rest_, region[k], fraction);
    const Complex p = halves[0][0].to, q = halves[1][0].to, r = halves[2][0].to;
    const std::array<Region, 4> parts{Region{halves[0][0], Arc{p, r}, halves[2][1]},
                                      Region{halves[0][1], halves[1][0], Arc{q, p}},
                                      Region{halves[1][1], halves[2][0], Arc{r, q}},
                                      Region{Arc{p, q}, Arc{q, r}, Arc{r, p}}};
    std::array<int, 4> counts{};
    int sum = 0;
    bool known = true;
    for (size_t k = 0; k < 4 && known; ++k) {
      const auto turned = turns(parts[k], w);
      known = turned.has_value();
      if (known) sum += counts[k] = *turned;
    }
    if (!known || sum != count) continue;
    for (size_t k = 0; k < 4; ++k)
      if (counts[k] != 0) search_region(parts[k], counts[k], w, depth + 1, found);
    return;
  }
  // Sheets meet here, or are too close together to be separated in floating point. If Newton's
  // method does not converge to a point inside, no preimage is reported.
  Preimage branch{here.empty() ? (a + b + c) / 3.0 : here[0].z};
  if (!improve(w, branch) || !is_inside(branch.z)) return;
  branch.orientation = count < 0 ? -1 : 1;
  found.insert(found.end(), static_cast<size_t>(std::abs(count)), branch);
}

}  // namespace holomorph
