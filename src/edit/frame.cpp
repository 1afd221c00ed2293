#include "edit/frame.h"

namespace holomorph {

bool is_upright_rectangle(const Cage& cage) {
  if (cage.size() != 4 || !cage.holes.empty() || !is_straight(cage)) return false;
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

}  // namespace holomorph
