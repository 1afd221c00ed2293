#include "edit/fold_finder.h"

#include "edit/picking.h"

namespace holomorph {
namespace {

constexpr int kSamplesPerSide = 8;  // of a triangle

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
  folds_ = visible_folds(*mesh_, f_, map.injectivity(), visible_);
  return folds_;
}

}  // namespace holomorph
