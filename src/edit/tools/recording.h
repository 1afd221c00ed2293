// Records a drag as motion: time runs while handles are dragged, and their paths become keyframes.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

class Recording {
 public:
  /// Starts at the workspace's current time. If keyframes play, everything except the dragged
  /// handles keeps moving with them. Otherwise everything else keeps its displayed pose. Tangents
  /// of segments whose degree changes with time are left out. If nothing is left to record, shows a
  /// toast and returns false.
  bool start(Workspace& workspace, const Selection& what, double now_ms);
  bool active() const { return !samples_.empty(); }
  /// The deformation at the recorded time that corresponds to `now_ms`, with the dragged handles
  /// displaced by `by` from their positions at the start. Sets the workspace's time to that time.
  Deformation follow(Workspace& workspace, Complex by, double now_ms);
  /// Sets keyframes with linear easing at whole frames, in one step. It sets only the keyframes
  /// needed to keep all handles within about three window px of their paths. In existing keyframes,
  /// only the dragged handles move. Keyframes that do not play are not changed.
  void finish(Workspace& workspace);
  void cancel(Workspace& workspace);

 private:
  struct RecordedPose {
    double time = 0;
    Complex by;
    Pose pose;
    Points positions;  ///< positions of all handles
  };
  /// A deformation with the handles at the positions to which they are dragged.
  Deformation dragged(Deformation deformation, Complex by) const;
  Deformation base_at(Workspace& workspace, double time) const;
  RecordedPose sample_at(double time) const;
  std::vector<double> keyframe_times(double tolerance) const;

  Selection what_;
  DragOptions drag_options_;
  Deformation start_;  ///< the displayed deformation at the start
  double start_time_ = 0, start_ms_ = 0;
  bool keyframes_play_ = false;
  std::vector<RecordedPose> samples_;
};

/// The status hint during a recording.
std::string recording_hint(const Timeline& timeline);

}  // namespace holomorph
