// If the basis is on the boundary, derivatives have poles at its corners, and a few tiny triangles
// next to the corners are always flipped. Such triangles do not count as folds.
#include "core/maps/injectivity.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "core/arithmetic.h"
#include "core/maps/distortion.h"

namespace holomorph {
namespace {

/// The flipped regions, the largest first. Each is represented by the center of its largest
/// triangle. Empty when all regions together are too small to be seen.
Points flipped_regions(const Mesh& mesh, const VectorXc& f) {
  constexpr double kVisible = 1e-4, kSpeck = 1e-5;  // relative areas: of all regions, of one region
  double turned = 0, total = 0;
  std::vector<std::pair<double, const Triangle*>> over;
  for (const Triangle& t : mesh.triangles) {
    const auto [i, j, k] = t;
    const double twice = cross(f[j] - f[i], f[k] - f[i]);
    total += std::abs(twice);
    if (twice >= 0) continue;
    turned -= twice;
    over.push_back({-twice, &t});
  }
  if (turned <= kVisible * total) return {};
  // Triangles that share a vertex belong to the same region.
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [area, t] : over)
    for (const int v : *t) parent[root(v)] = root((*t)[0]);
  struct Region {
    double area = 0, largest = 0;
    Complex at;
  };
  std::map<int, Region> parts;
  for (const auto& [area, t] : over) {
    const auto [i, j, k] = *t;
    Region& part = parts[root(i)];
    part.area += area;
    if (area > part.largest) part.largest = area, part.at = (f[i] + f[j] + f[k]) / 3.0;
  }
  std::vector<Region> sorted;
  for (const auto& [v, part] : parts) sorted.push_back(part);
  std::ranges::sort(sorted, std::greater(), &Region::area);
  Points positions;
  for (const Region& part : sorted)
    if (positions.empty() || part.area > kSpeck * total) positions.push_back(part.at);
  return positions;
}

/// |f_z| - |f_zbar| of the linear map that takes the edges z1 and z2 of a triangle to f1 and f2.
double stretch(Complex z1, Complex z2, Complex f1, Complex f2) {
  const Complex fz = times(f1, std::conj(z2)) - times(f2, std::conj(z1)),
                fzbar = times(z1, f2) - times(z2, f1);  // both times -4 i area
  return (std::sqrt(std::norm(fz)) - std::sqrt(std::norm(fzbar))) / (2 * std::abs(cross(z1, z2)));
}

struct Shrunken {
  double least = 1;
  Complex at;  ///< posed
};

Shrunken most_shrunken(const Mesh& mesh, const VectorXc& f) {
  constexpr double kSpecks = 1e-3;
  struct Part {
    double stretch, area;
    const Triangle* triangle;
  };
  std::vector<Part> parts;
  double total = 0;
  const Points& z = mesh.vertices;
  for (const Triangle& t : mesh.triangles) {
    const auto [i, j, k] = t;
    const double area = cross(z[j] - z[i], z[k] - z[i]);
    parts.push_back({stretch(z[j] - z[i], z[k] - z[i], f[j] - f[i], f[k] - f[i]), area, &t});
    total += area;
  }
  if (parts.empty()) return {};
  // A heap suffices, because only the smallest values are needed.
  const auto later = [](const Part& a, const Part& b) { return a.stretch > b.stretch; };
  std::ranges::make_heap(parts, later);
  for (double left = kSpecks * total; parts.size() > 1 && parts.front().area < left;) {
    left -= parts.front().area;
    std::ranges::pop_heap(parts, later);
    parts.pop_back();
  }
  const auto [i, j, k] = *parts.front().triangle;
  return {parts.front().stretch, (f[i] + f[j] + f[k]) / 3.0};
}

/// A closed polygon simplified to within a tolerance (Douglas, Peucker 1973). The first vertex and
/// the vertex farthest from it are kept.
class SimplifiedPolygon {
 public:
  SimplifiedPolygon(std::span<const Complex> polygon, double tolerance)
      : polygon_(polygon), tolerance_(tolerance) {
    const auto farthest = std::ranges::max_element(
        polygon, {}, [&](Complex z) { return std::abs(z - polygon.front()); });
    const size_t middle = static_cast<size_t>(farthest - polygon.begin());
    points_.push_back(polygon.front());
    keep_between(0, middle);
    points_.push_back(polygon[middle]);
    keep_between(middle, polygon.size());
  }
  const Points& points() const { return points_; }

 private:
  void keep_between(size_t from, size_t to) {
    const Complex a = polygon_[from], b = polygon_[to % polygon_.size()];
    double farthest = tolerance_;
    size_t at = 0;
    for (size_t i = from + 1; i < to; ++i)
      if (const double off = nearest_on_segment(a, b, polygon_[i]).distance; off > farthest)
        farthest = off, at = i;
    if (at == 0) return;
    keep_between(from, at);
    points_.push_back(polygon_[at]);
    keep_between(at, to);
  }

  std::span<const Complex> polygon_;
  double tolerance_;
  Points points_;
};

}  // namespace

Injectivity injectivity_of(const Mesh& mesh, const VectorXc& f) {
  Injectivity found;
  found.folds_at = flipped_regions(mesh, f);
  Polygon image{{}, mesh.starts};
  for (const int v : mesh.boundary) image.points.push_back(f[v]);
  if (image.points.empty()) return found;
  constexpr double kVisible = 3e-4;
  const PolygonView loops = image;
  Polygon simplified;
  for (Index l = 0; l < loops.loops().count(); ++l) {
    if (l > 0) simplified.starts.push_back(static_cast<Index>(simplified.points.size()));
    const Points loop =
        SimplifiedPolygon(loops.loop(l), kVisible * box_of(image).diagonal()).points();
    simplified.points.insert(simplified.points.end(), loop.begin(), loop.end());
  }
  found.turning_number = turning_number(simplified, part_count(mesh));
  // In a part that is wound up thinly, the simplified boundary may turn more often. Only then are
  // the angles needed, which take long.
  if (std::round(found.turning_number) == 1 || is_immersion(mesh, f)) found.turning_number = 1;
  const Shrunken shrunken = most_shrunken(mesh, f);
  found.least_stretch = shrunken.least;
  if (found.folds_at.empty() && found.folds()) found.folds_at = {shrunken.at};
  if (const auto crossing = self_crossing(image)) found.crossing = crossing->point;
  return found;
}

}  // namespace holomorph
