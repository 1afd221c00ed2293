// Motion recorded as it is dragged: the time runs, and where handles go becomes keyframes.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

class Recording {
 public:
  /// From the workspace's time on. Where keyframes play, everything but the handles goes on moving
  /// with them; else it stays as it is shown. Tangents of segments whose degree changes with time
  /// are left out. Returns whether anything is left to record.
  bool start(Workspace& workspace, const Selection& what, double now_ms);
  bool active() const { return !samples_.empty(); }
  /// The deformation at this moment with the handles by `by` from where they were at the start. The
  /// workspace's time goes along.
  Deformation follow(Workspace& workspace, Complex by, double now_ms);
  /// Sets linear keyframes at frames, as few as keep everything within three window pixels of its
  /// way, as one step. Keys that are there already keep what was not dragged; those that do not
  /// play stay as they are.
  void finish(Workspace& workspace);
  void cancel(Workspace& workspace);

 private:
  struct RecordedPose {
    double time = 0;
    Complex by;
    Pose pose;
    Points places;  ///< of all handles
  };
  /// A deformation with the handles where they are dragged to.
  Deformation dragged(Deformation deformation, Complex by) const;
  Deformation base_at(const Workspace& workspace, double time) const;
  RecordedPose sample_at(double time) const;
  std::vector<double> needed(double tolerance) const;

  Selection what_;
  DragOptions drag_options_;
  Deformation start_;  ///< what was shown
  double start_time_ = 0, start_ms_ = 0;
  bool over_keys_ = false;
  std::vector<RecordedPose> samples_;
};

/// What to say meanwhile.
std::string recording_hint(const Timeline& timeline);

}  // namespace holomorph
