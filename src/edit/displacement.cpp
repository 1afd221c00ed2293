// Soft selection falls off smoothly to nothing at its reach.
#include "edit/displacement.h"

#include "scene/mirror.h"

namespace holomorph {
namespace {

bool is_tangent(const Handle& handle) {
  return handle.kind == Handle::Kind::cage && handle.control > 0;
}

/// 1 at 0, flat there and at 1, 0 from there on.
double falloff(double share) {
  return share >= 1 ? 0 : (1 - share * share) * (1 - share * share);
}

Displacements softly(const Scene& scene, const Selection& dragged, Complex by, Layer layer,
                     double reach) {
  Displacements all;
  for (const Handle& handle : handles_of(scene, layer)) {
    if (is_tangent(handle) || dragged.contains(handle)) continue;
    const Complex here = position_of(scene, handle, layer);
    double distance = reach;
    for (const Handle& other : dragged)
      distance = std::min(distance, std::abs(position_of(scene, other, layer) - here));
    if (const double share = falloff(distance / reach); share > 0) all[handle] = share * by;
  }
  return all;
}

Complex mirrored_way(Complex by) {
  return {-by.real(), by.imag()};
}

}  // namespace

std::optional<Handle> counterpart_of(const Scene& scene, Handle handle) {
  if (is_tangent(handle) || !exists(scene, handle, Layer::rest)) return {};
  std::vector<Handle> same;
  Points places;
  for (const Handle& other : handles_of(scene, Layer::rest))
    if (other.kind == handle.kind && !is_tangent(other)) {
      same.push_back(other);
      places.push_back(position_of(scene, other, Layer::rest));
    }
  const auto found = Mirror(scene).counterpart(places, position_of(scene, handle, Layer::rest));
  return found ? std::optional(same[*found]) : std::nullopt;
}

Displacements displacements(const Scene& scene, const Selection& dragged, Complex by, Layer layer,
                            const Influence& influence) {
  Displacements all;
  if (influence.soft) all = softly(scene, dragged, by, layer, influence.reach);
  for (const Handle& handle : dragged) all[handle] = by;
  if (!influence.symmetric) return all;
  Displacements both = all;
  for (const auto& [handle, way] : all) {
    const auto other = counterpart_of(scene, handle);
    if (!other) continue;
    if (*other == handle)
      both[handle] = 0.5 * (way + mirrored_way(way));
    else if (const auto own = all.find(*other);
             own == all.end() || std::abs(own->second) < std::abs(way))
      both[*other] = mirrored_way(way);
  }
  return both;
}

Scene displaced(Scene scene, const Displacements& by, Layer layer) {
  Displacements all = by;
  const Cage cage = cage_of(scene, layer);
  for (const auto& [handle, way] : by) {
    if (handle.kind != Handle::Kind::cage || handle.control != 0) continue;
    const Index before = (handle.index + cage.size() - 1) % cage.size();
    if (cage.degree(handle.index) > 1) all.try_emplace({Handle::Kind::cage, handle.index, 1}, way);
    if (cage.degree(before) > 1)
      all.try_emplace({Handle::Kind::cage, before, cage.degree(before) - 1}, way);
  }
  for (const auto& [handle, way] : all)
    if (exists(scene, handle, layer)) shift(scene, handle, way, layer);
  return scene;
}

}  // namespace holomorph
