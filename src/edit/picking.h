// Finds what is under a point of the canvas.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// The rest position of the picture point that is displayed at z. None if z is outside the picture,
/// or if a pose has no map yet.
std::optional<Complex> rest_at(const Workspace& workspace, Complex z);
/// The rest position of the point of a layer's picture that is displayed at a position of the
/// canvas, in window px. Outside the cage, the picture does not move. None if the posed picture
/// does not cover the position, even if it would at rest.
std::optional<Complex> rest_in_layer(const Workspace& workspace, size_t layer, Complex px);
/// Whether an eye sees the picture at a rest position: its alpha is at least 5 %.
bool is_visible_at(const Image& picture, Complex rest);
/// Whether z is in a hole of the picture as it is shown.
bool is_in_hole(const Workspace& workspace, Complex z);

/// The image of a rest point under the map. Returns the point itself if it is outside the mesh or
/// no map is available yet.
Complex posed_at(const LiveMap& map, Complex rest);

/// The rotation at a pin in radians: the pin's own, or else that of the picture as it is shown.
double rotation_at(const Workspace& workspace, Index pin);

/// The nearest handle of the current mode within picking distance. Points have priority over
/// strokes.
std::optional<Handle> handle_at(const Workspace& workspace, Complex px);

/// The nearest point of the current mode's cage, where a click can insert a vertex. None if it is
/// beyond picking distance or at a vertex.
std::optional<CageHit> edge_at(const Workspace& workspace, Complex px);

/// Inserts a vertex at a point of the cage in one step and selects it. Returns false if the step is
/// refused.
bool insert_at(Workspace& workspace, const CageHit& hit);

}  // namespace holomorph
