#include "core/maps/visible_folds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

namespace holomorph {
namespace {

constexpr double kPixel = 1;        // plane units squared
constexpr double kFewFlips = 1e-4;  // as a part of the area: what a mesh flips at a branch point

double twice_area(const VectorXc& f, const Triangle& t) {
  return cross(f[t[1]] - f[t[0]], f[t[2]] - f[t[0]]);
}

/// The part of the picture's area that is flipped.
double flipped_share(const Mesh& mesh, const VectorXc& f) {
  double flipped = 0, all = 0;
  for (const Triangle& t : mesh.triangles) {
    const double area = twice_area(f, t);
    all += std::abs(area);
    flipped += std::max(0.0, -area);
  }
  return flipped / all;
}

/// Joins things that share a number.
class Sets {
 public:
  explicit Sets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int v) {
    const auto parent = [this](int of) -> int& { return parent_[static_cast<size_t>(of)]; };
    while (parent(v) != v) v = parent(v) = parent(parent(v));
    return v;
  }
  void join(int a, int b) { parent_[static_cast<size_t>(root(a))] = root(b); }

 private:
  std::vector<int> parent_;
};

}  // namespace

std::vector<Fold> visible_folds(const Mesh& mesh, const VectorXc& f, const Injectivity& found,
                                const std::vector<char>& visible) {
  const auto is_visible = [&](int triangle) {
    return visible.empty() || visible[static_cast<size_t>(triangle)] != 0;
  };
  // Triangles that share a vertex belong to the same region.
  Sets sets(mesh.vertices.size());
  std::vector<int> flipped;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    if (!(twice_area(f, triangle) < 0)) continue;
    flipped.push_back(static_cast<int>(t));
    sets.join(triangle[0], triangle[1]);
    sets.join(triangle[1], triangle[2]);
  }
  struct Region {
    Fold fold;
    double area = 0;
    Complex weighted;
  };
  std::map<int, Region> regions;
  for (const int t : flipped) {
    if (!is_visible(t)) continue;
    const Triangle& triangle = mesh.triangles[static_cast<size_t>(t)];
    Region& region = regions[sets.root(triangle[0])];
    const double area = -twice_area(f, triangle) / 2;
    region.area += area;
    region.weighted += area * (f[triangle[0]] + f[triangle[1]] + f[triangle[2]]) / 3.0;
    region.fold.triangles.push_back(t);
  }
  std::vector<Region> seen;
  for (auto& [root, region] : regions)
    if (region.area > kPixel) seen.push_back(std::move(region));
  std::ranges::sort(seen, std::greater(), &Region::area);
  std::vector<Fold> folds;
  for (Region& region : seen) {
    // A picture that is flipped as a whole folds nowhere in particular.
    region.fold.at = region.weighted / region.area;
    for (const int t : region.fold.triangles)
      for (const int v : mesh.triangles[static_cast<size_t>(t)])
        region.fold.radius = std::max(region.fold.radius, std::abs(f[v] - region.fold.at));
    folds.push_back(std::move(region.fold));
  }
  // Around a branch point, the picture winds more than once, with hardly a flipped triangle.
  if (flipped_share(mesh, f) > kFewFlips || !found.folds() || found.folds_at.empty()) return folds;
  const auto near = locate(mesh, as_span(f), found.folds_at.front());
  if (near && is_visible(near->triangle)) folds.push_back({found.folds_at.front(), 0, {}});
  return folds;
}

}  // namespace holomorph
