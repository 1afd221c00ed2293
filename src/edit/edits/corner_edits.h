// Edits to the corners of a cage, for the method `angles`, which prescribes angles at corners.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// Whether a cage vertex is a corner. If the list of corners is empty, all vertices are corners.
bool is_corner(const Deformation& deformation, Index vertex);
/// The angles of a corner, or the default angles if the vertex is not in the list.
PoseCorner corner_at(const Deformation& deformation, Index vertex);

/// How far a corner is opened, in radians: the angle by which its two edges have turned away from
/// each other. corner_opened increases it by twice `by`.
double corner_opening(const Deformation& deformation, Index vertex);

/// Makes a vertex a corner. Both of its edges get the rotation that the undivided edge has there.
Deformation with_corner(Deformation deformation, Index vertex);
/// Turns a corner into a plain vertex. Throws Error if there are only three corners.
Deformation without_corner(Deformation deformation, Index vertex);
/// Makes all vertices corners.
Deformation with_all_corners(Deformation deformation);

/// Sets the angles and the tension of a corner.
Deformation with_corner_pose(Deformation deformation, Index vertex, const PoseCorner& pose);
/// Turns a corner by an angle in radians. This function, with_corner_pose, corner_opened and
/// with_tension make the vertex a corner and switch to the method for corners if needed. If parts
/// of the cage are joined for that method, vertices are those of the joined cage.
Deformation corner_turned(Deformation deformation, Index vertex, double by);
/// Opens a corner: turns each of its two edges away from the other by an angle in radians.
Deformation corner_opened(Deformation deformation, Index vertex, double by);

/// The corner that starts the edge containing this segment of the cage.
Index corner_before(const Deformation& deformation, Index segment);
/// Sets the tension of the edge that starts at a corner, clamped to 0 ... 1.
Deformation with_tension(Deformation deformation, Index corner, double tension);

/// Renumbers the corners after a vertex has been inserted into a segment or erased.
void follow_insertion(std::vector<Corner>& corners, Index segment);
void follow_erasure(std::vector<Corner>& corners, Index vertex);
/// The same for the corners of a pose, given those of the deformation before the change.
void follow_erasure(std::vector<PoseCorner>& pose, const std::vector<Corner>& corners,
                    Index vertex);

}  // namespace holomorph
