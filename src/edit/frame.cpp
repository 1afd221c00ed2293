#include "edit/frame.h"

#include <algorithm>

namespace holomorph {

bool is_upright_rectangle(const Cage& cage) {
  if (cage.size() != 4 || !cage.starts.empty() || !is_straight(cage)) return false;
  const Points corners = vertices_of(cage);
  for (size_t k = 0; k < 4; ++k) {
    const Complex side = corners[(k + 1) % 4] - corners[k],
                  next = corners[(k + 2) % 4] - corners[(k + 1) % 4];
    if ((side.real() != 0) == (side.imag() != 0) || dot(side, next) != 0) return false;
  }
  return true;
}

Deformation with_usual_frame(const Workspace& workspace, Deformation deformation) {
  const auto image = workspace.document.image();
  if (deformation.frame == Frame::free && method_named(deformation.method).uses_frame && image &&
      is_upright_rectangle(deformation.rest) && is_opaque(*image))
    deformation.frame = Frame::slide;
  return deformation;
}

bool can_choose_frame(const Workspace& workspace) {
  const Deformation& deformation = workspace.shown.deformation();
  return method_named(deformation.method).uses_frame && is_upright_rectangle(deformation.rest);
}

Deformation held_beyond(Deformation deformation, double radius) {
  constexpr double kLeast = 0.02;  // of the size
  const double size = box_of(vertices_of(deformation.rest)).diagonal();
  deformation.held_beyond =
      std::clamp(radius, std::max(kMinPinRadius, kLeast * size), std::min(kMaxPinRadius, size));
  return deformation;
}

bool can_hold_beyond(const Workspace& workspace) {
  const Deformation& deformation = workspace.shown.deformation();
  return can_choose_frame(workspace) && !deformation.pins.empty() && !deformation.held_beyond;
}

void hold_beyond(Workspace& workspace) {
  constexpr double kUsual = 0.15;  // of the size
  const Deformation& before = workspace.shown.deformation();
  const double size = box_of(vertices_of(before.rest)).diagonal();
  workspace.commit("Hold the rest", held_beyond(before, kUsual * size));
}

void let_go(Workspace& workspace) {
  Deformation after = workspace.shown.deformation();
  after.held_beyond.reset();
  workspace.commit("Let the rest go", std::move(after));
}

}  // namespace holomorph
