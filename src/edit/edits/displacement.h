// The displacements of all handles when some are dragged: soft selection and symmetry.
#pragma once

#include <map>

#include "edit/edits/edits.h"

namespace holomorph {

/// Which handles follow the dragged ones.
struct DragOptions {
  bool soft = false;       ///< nearby handles follow, less the farther away they are
  double reach = 100;      ///< radius of the soft selection in plane units
  bool symmetric = false;  ///< the counterpart across the mirror axis moves as a mirror image
};
inline constexpr double kMinReach = 1, kMaxReach = 1e5;

using Displacements = std::map<Handle, Complex>;

/// The displacement of each handle that moves when `dragged` moves by `by`. Vertices, pins and
/// strokes can follow; a tangent has a displacement only if it is dragged itself. With symmetry,
/// handles on the mirror axis stay on it.
Displacements displacements(const Deformation& deformation, const Selection& dragged, Complex by,
                            EditMode mode, const DragOptions& drag_options);

/// Moves handles. The control points next to a vertex move with it unless they have their own
/// displacement.
Deformation displaced(Deformation deformation, const Displacements& by, EditMode mode);

/// Maps each vertex, pin and stroke to its counterpart: the handle of the same kind that lies at
/// its mirror image at rest. Symmetry therefore works in any pose. Handles without a counterpart
/// are left out. Cost: quadratic in the number of handles.
std::map<Handle, Handle> counterparts_of(const Deformation& deformation);

}  // namespace holomorph
