// Folds in transparent parts, or smaller than a pixel, are no reason for an alarm.
#include "edit/visible_folds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "core/maps/injectivity.h"
#include "edit/picking.h"

namespace holomorph {
namespace {

constexpr double kPixel = 1;        // plane units squared
constexpr double kFewFlips = 1e-4;  // as a part of the area: what a mesh flips at a branch point
constexpr int kSamplesPerSide = 8;  // of a triangle

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

std::vector<char> visible_triangles(const Mesh& mesh, const Image* picture) {
  std::vector<char> visible(mesh.triangles.size(), 1);
  if (!picture) return visible;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [i, j, k] = mesh.triangles[t];
    const Points& z = mesh.vertices;
    const Complex a = z[static_cast<size_t>(i)], b = z[static_cast<size_t>(j)],
                  c = z[static_cast<size_t>(k)];
    bool any = false;
    for (int u = 0; u <= kSamplesPerSide && !any; ++u)
      for (int v = 0; u + v <= kSamplesPerSide && !any; ++v)
        any = is_visible_at(*picture, a + (b - a) * (static_cast<double>(u) / kSamplesPerSide) +
                                          (c - a) * (static_cast<double>(v) / kSamplesPerSide));
    visible[t] = any;
  }
  return visible;
}

std::vector<Fold> visible_folds(const Mesh& mesh, const VectorXc& f,
                                const std::vector<char>& visible) {
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
    if (!visible[static_cast<size_t>(t)]) continue;
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
  return folds;
}

const std::vector<Fold>& FoldFinder::folds(const LiveMap& map,
                                           const std::shared_ptr<const Image>& picture) {
  if (!map.has_map()) {
    folds_.clear();
    f_.resize(0);
    return folds_;
  }
  const std::shared_ptr<const Mesh> mesh = map.prepared()->mesh;
  const bool same_picture = mesh == mesh_ && picture == picture_;
  if (same_picture && f_.size() == map.map().f.size() && f_ == map.map().f) return folds_;
  if (!same_picture) {
    mesh_ = mesh;
    picture_ = picture;
    visible_ = visible_triangles(*mesh, picture.get());
  }
  f_ = map.map().f;
  find(map);
  return folds_;
}

void FoldFinder::find(const LiveMap& map) {
  folds_ = visible_folds(*mesh_, f_, visible_);
  // Around a branch point, the picture winds more than once, with hardly a flipped triangle.
  const Injectivity& found = map.injectivity();
  if (flipped_share(*mesh_, f_) > kFewFlips || !found.folds() || found.folds_at.empty()) return;
  const auto near = locate(*mesh_, as_span(f_), found.folds_at.front());
  if (near && visible_[static_cast<size_t>(near->triangle)])
    folds_.push_back({found.folds_at.front(), 0, {}});
}

}  // namespace holomorph
