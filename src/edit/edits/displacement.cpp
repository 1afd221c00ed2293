// The weight of the soft selection falls off smoothly to 0 at its radius.
#include "edit/edits/displacement.h"

#include "edit/edits/rest_edits.h"
#include "scene/mirror.h"

namespace holomorph {
namespace {

/// (1 - s^2)^2 for s < 1, and 0 for s >= 1. The value at 0 is 1, and the slope is zero at 0 and 1.
double falloff(double share) {
  return share >= 1 ? 0 : (1 - share * share) * (1 - share * share);
}

Displacements soft_displacements(const Deformation& deformation, const Selection& dragged,
                                 Complex by, EditMode mode, double reach) {
  Displacements all;
  for (const Handle& handle : handles_of(deformation, mode)) {
    if (is_tangent(handle) || dragged.contains(handle)) continue;
    const Complex here = position_of(deformation, handle, mode);
    double distance = reach;
    for (const Handle& other : dragged)
      distance = std::min(distance, std::abs(position_of(deformation, other, mode) - here));
    if (const double share = falloff(distance / reach); share > 0) all[handle] = share * by;
  }
  return all;
}

Complex mirrored(Complex by) {
  return {-by.real(), by.imag()};
}

}  // namespace

std::map<Handle, Handle> counterparts_of(const Deformation& deformation) {
  const Mirror mirror(deformation);
  std::map<Handle::Kind, std::vector<Handle>> kinds;
  for (const Handle& handle : handles_of(deformation, EditMode::rest))
    if (!is_tangent(handle)) kinds[handle.kind].push_back(handle);
  std::map<Handle, Handle> counterparts;
  for (const auto& [kind, handles] : kinds) {
    Points positions;
    for (const Handle& handle : handles)
      positions.push_back(position_of(deformation, handle, EditMode::rest));
    for (size_t i = 0; i < handles.size(); ++i)
      if (const auto found = mirror.counterpart(positions, positions[i]))
        counterparts[handles[i]] = handles[*found];
  }
  return counterparts;
}

Displacements displacements(const Deformation& deformation, const Selection& dragged, Complex by,
                            EditMode mode, const DragOptions& drag_options) {
  Displacements all;
  if (drag_options.soft)
    all = soft_displacements(deformation, dragged, by, mode, drag_options.reach);
  for (const Handle& handle : dragged) all[handle] = by;
  if (!drag_options.symmetric) return all;
  Displacements both = all;
  for (const auto& [handle, other] : counterparts_of(deformation)) {
    const auto displacement = all.find(handle), own = all.find(other);
    if (displacement == all.end()) continue;
    if (other == handle)
      both[handle] = 0.5 * (displacement->second + mirrored(displacement->second));
    else if (own == all.end() || std::abs(own->second) < std::abs(displacement->second))
      both[other] = mirrored(displacement->second);
  }
  return both;
}

Deformation displaced(Deformation deformation, const Displacements& by, EditMode mode) {
  Displacements all = by;
  for (const auto& [handle, displacement] : by)
    for (const Handle& tangent : adjacent_tangents(cage_of(deformation, mode), handle))
      all.try_emplace(tangent, displacement);
  return edited_in(mode, std::move(deformation), [&](Deformation& edited) {
    for (const auto& [handle, displacement] : all)
      if (exists(edited, handle, mode)) shift(edited, handle, displacement, mode);
  });
}

}  // namespace holomorph
