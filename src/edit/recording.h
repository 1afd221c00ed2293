// Motion recorded as it is dragged: the time runs, and where handles go becomes keyframes.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

class Recording {
 public:
  /// From the workspace's time on, with what is shown; what has keyframes already goes on moving
  /// beside the handles.
  void start(Workspace& workspace, Selection what, double now_ms);
  bool active() const { return !samples_.empty(); }
  /// The scene at this moment with the handles by `by` from where they were at the start. The
  /// workspace's time goes along.
  Scene follow(Workspace& workspace, Complex by, double now_ms);
  /// Sets the keyframes, as few as keep handles within three window pixels of their ways
  /// were they even between, as one step; those that were there in that time keep theirs.
  void finish(Workspace& workspace);
  void cancel(Workspace& workspace);

 private:
  struct Sample {
    double time = 0;
    Pose pose;
    Points handles;
  };
  Points handles_in(const Scene& scene) const;
  std::vector<size_t> needed(double tolerance) const;

  Selection what_;
  Scene start_;  ///< what was shown
  double start_time_ = 0, start_ms_ = 0;
  bool over_keys_ = false;       ///< keyframes are what was shown
  std::vector<Sample> samples_;  ///< the first of each frame
  Sample last_;
};

/// What to say meanwhile.
std::string recording_hint(const Timeline& timeline);

}  // namespace holomorph
