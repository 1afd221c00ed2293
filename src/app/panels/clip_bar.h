// The bar of a film on the timeline.
#pragma once

#include "app/panels/time_ruler.h"
#include "edit/tools/clip_drag.h"

namespace holomorph {

/// Where a film plays, in the window.
class ClipBar {
 public:
  /// `middle` is the y of its row's center.
  ClipBar(const TimeRuler& ruler, const Clip& clip, float middle);

  /// Draws the bar and, fainter from `left` to `right`, where the film repeats.
  void draw(ImDrawList& list, float left, float right) const;
  /// What a drag that starts at a point does; none if it is not on the bar.
  std::optional<ClipDrag::Kind> part_at(ImVec2 point) const;

 private:
  ImVec2 from_, to_;
  bool loops_;
};

}  // namespace holomorph
