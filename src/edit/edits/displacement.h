// Where handles go when some of them are dragged: those near them, and their mirror images.
#pragma once

#include <map>

#include "edit/edits/edits.h"

namespace holomorph {

/// What a drag takes along besides what is dragged.
struct DragOptions {
  bool soft = false;
  double reach = 100;      ///< plane units: handles nearer than this go along softly, less and less
  bool symmetric = false;  ///< what lies on the other side at rest goes the mirrored way
};
inline constexpr double kLeastReach = 1, kMostReach = 1e5;

using Displacements = std::map<Handle, Complex>;

/// How far each handle goes when these are dragged by so much. Vertices, pins and strokes take
/// part, tangents where they are dragged themselves; what lies on the mirror's line stays on it.
Displacements displacements(const Deformation& deformation, const Selection& dragged, Complex by,
                            EditMode mode, const DragOptions& drag_options);

/// Moves handles; control points beside a vertex go along unless they have a way of their own.
Deformation displaced(Deformation deformation, const Displacements& by, EditMode mode);

/// For each vertex, pin and stroke the one that lies where the mirror takes it at rest, where there
/// is one. Cost: the square of their number.
std::map<Handle, Handle> counterparts_of(const Deformation& deformation);

}  // namespace holomorph
