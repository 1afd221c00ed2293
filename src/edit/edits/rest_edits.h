// Edits of the rest shape. Points that are not posed move along with it, so that the picture stays
// at rest there. Posed points keep their pose.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// Whether the rest positions of handles differ between two deformations with the same handles.
bool differs_at_rest(const Deformation& a, const Deformation& b);
/// A pose that fits the handles of `before`, after their rest positions were edited: points whose
/// pose equaled their rest position follow it. Segments of the cage whose degree has changed follow
/// only as a whole.
Pose pose_following_rest(const Deformation& before, const Deformation& after, Pose pose);
/// Applies pose_following_rest to the deformation's pose and to its keyframes.
Deformation with_poses_following_rest(const Deformation& before, Deformation after);

/// Applies an edit of the pose or of the rest shape. `edit` changes the deformation that it gets.
template <class Edit>
Deformation edited_in(EditMode mode, Deformation deformation, Edit edit) {
  if (mode == EditMode::pose) {
    edit(deformation);
    return deformation;
  }
  const Deformation before = deformation;
  edit(deformation);
  return with_poses_following_rest(before, std::move(deformation));
}

}  // namespace holomorph
