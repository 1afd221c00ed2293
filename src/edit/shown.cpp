// A document has its own pose and keyframes. While a time is displayed, an edit may change either.
#include "edit/shown.h"

#include <algorithm>

#include "edit/edits/rest_edits.h"

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
  // An edit of the rest shape poses nothing: points that are not posed only follow it.
  const bool edits_rest =
      base == EditBase::shown && fits(edited, before) && differs_at_rest(this->base(), edited);
  if (edits_rest) entry.moves = false;
  entry.sets_key = entry.moves && timeline.auto_key;
  entry.deformation = std::move(edited);
  const Pose own_pose = whole_pose_of(own());
  if (base == EditBase::shown && !entry.moves && fits(entry.deformation, own_pose)) {
    const Pose kept =
        edits_rest ? pose_following_rest(this->base(), entry.deformation, own_pose) : own_pose;
    entry.deformation = posed_as(std::move(entry.deformation), kept);
  }
  return entry;
}

void Shown::follow(const Entry& entry, bool same_layer) {
  timed_.reset();
  if (same_layer && time() && fits(own(), entry.shown)) set_timed_pose(entry.shown);
}

}  // namespace holomorph
