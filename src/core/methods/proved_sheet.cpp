#include "core/methods/proved_sheet.h"

#include <algorithm>

namespace holomorph {

ProvedSheet::ProvedSheet(const SheetSolver& solver, const VectorXc& f)
    : mesh_(*solver.domain().mesh),
      map_(std::make_unique<SmoothMap>(solver.smooth(f))),
      guarded_(map_->guard()) {}

Complex ProvedSheet::unproved() const {
  return mesh_.vertices[static_cast<size_t>(mesh_.triangles[guarded_.unproved.value()][0])];
}

SampledMap ProvedSheet::sampled(std::span<const Location> places, bool derivatives) const {
  SampledMap out;
  out.status = is_proved() ? SampledMap::Status::certified : SampledMap::Status::infeasible;
  const Index count = static_cast<Index>(places.size());
  out.f.resize(count);
  if (derivatives) out.fz.resize(count), out.fzbar.resize(count);
  for (Index i = 0; i < count; ++i) {
    const PointMap::Value at = map_->at(places[static_cast<size_t>(i)]);
    out.f[i] = at.f;
    if (!derivatives) continue;
    out.fz[i] = at.fz;
    out.fzbar[i] = at.fzbar;
  }
  return out;
}

Extremes ProvedSheet::extremes() const {
  constexpr int kDepth = 12;
  StretchBounds attained, bounds;
  for (size_t i = 0; i < mesh_.triangles.size(); ++i) attained.include(map_->cubics(i).attained());
  for (size_t i = 0; i < mesh_.triangles.size(); ++i)
    bounds.include(map_->cubics(i).bounds(kDepth, attained));
  // Without folds, shear is below 1, even where its bound is not.
  return {is_proved() ? std::min(bounds.shear, 1.0) : bounds.shear, bounds.smallest,
          bounds.largest};
}

}  // namespace holomorph
