#include "edit/settling.h"

#include "core/arithmetic.h"
#include "core/maps/distortion.h"

namespace holomorph {
namespace {

constexpr double kDuration = 150;  // milliseconds

VectorXc blended(const VectorXc& from, const VectorXc& to, double u) {
  return from + smoothstep(u) * (to - from);
}

}  // namespace

bool Settling::fades_to(const LiveMap& map) const {
  constexpr double kVisible = 1e-3;  // of the size
  const VectorXc& f = map.map().f;
  if (!was_draft_ || map.shows_draft() || preparation_ != map.preparation() ||
      shown_.size() != f.size())
    return false;
  const Mesh& mesh = *map.prepared()->mesh;
  if ((f - shown_).cwiseAbs().maxCoeff() < kVisible * box_of(mesh.vertices).diagonal())
    return false;
  for (const double u : {0.25, 0.5, 0.75})
    if (flipped_triangles(mesh, blended(shown_, f, u)) > 0) return false;
  return true;
}

const VectorXc& Settling::positions(const LiveMap& map, double now) {
  const VectorXc& f = map.map().f;
  if (!map.has_map()) {
    *this = {};
    return f;
  }
  if (revision_ != map.revision() || preparation_ != map.preparation()) {
    if (fades_to(map))
      from_ = shown_, start_ = now;
    else
      from_.resize(0);
    was_draft_ = map.shows_draft();
    revision_ = map.revision();
    preparation_ = map.preparation();
  }
  const double u = (now - start_) / kDuration;
  if (from_.size() > 0 && u < 1) return shown_ = blended(from_, f, u);
  from_.resize(0);
  return shown_ = f;
}

}  // namespace holomorph
