// A document has its own pose and keyframes. While a time is displayed, an edit may change either.
#include "edit/shown.h"

#include <algorithm>

namespace holomorph {

bool Shown::leaves_a_pose() const {
  return document_->history().can_undo() && !playing_keys(own()).empty() &&
         std::ranges::find(own().keyframes, whole_pose_of(own()), &Keyframe::pose) ==
             own().keyframes.end();
}

void Shown::go_to_time(double seconds) {
  preview.reset();
  if (seconds != timeline.time) timed_.reset();
  timeline.go_to(seconds);
}

Shown::Entry Shown::entry_of(Deformation edited, EditBase base) const {
  const Pose before = whole_pose_of(this->base());
  Entry entry;
  entry.shown = base == EditBase::shown ? whole_pose_of(edited) : before;
  entry.moves = base == EditBase::shown && fits(edited, before) && entry.shown != before;
  entry.sets_key = entry.moves && timeline.auto_key;
  entry.deformation = std::move(edited);
  const Pose own_pose = whole_pose_of(own());
  if (base == EditBase::shown && !entry.moves && fits(entry.deformation, own_pose))
    entry.deformation = posed_as(std::move(entry.deformation), own_pose);
  return entry;
}

void Shown::follow(const Entry& entry, bool same_layer) {
  timed_.reset();
  if (same_layer && time() && fits(own(), entry.shown)) set_timed_pose(entry.shown);
}

}  // namespace holomorph
