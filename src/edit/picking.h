// What lies under a point of the canvas.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// The rest position of the point of the displayed picture at z; none outside the picture or before
/// there is a map.
std::optional<Complex> rest_at(const Workspace& workspace, Complex z);

/// The image of a rest point under the map; the point itself outside the mesh or before there is a
/// map.
Complex posed_at(const LiveMap& map, Complex rest);

/// The nearest handle of the current mode within picking distance. Points have priority over
/// strokes.
std::optional<Handle> handle_at(const Workspace& workspace, Complex px);

/// The nearest point on the current mode's cage within picking distance and not at a vertex: where
/// a click can insert a vertex.
std::optional<CageHit> edge_at(const Workspace& workspace, Complex px);

/// Inserts a vertex there in one step and selects it. Returns false if the step is refused.
bool insert_at(Workspace& workspace, const CageHit& hit);

}  // namespace holomorph
