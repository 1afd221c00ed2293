// Records a drag as motion: time runs while handles are dragged, and their paths become keyframes.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Radius of a pin's ring, in multiples of the picking distance.
inline constexpr double kRingRadius = 3.4;

/// What a recorded gesture does to a deformation.
struct RecordedEdit {
  /// Makes a deformation ready for the edit, for example by fixing a pin's rotation.
  std::function<Deformation(Deformation)> prepare;
  /// Sets the edited handles of a deformation to their poses at the start of the gesture, changed
  /// by an amount.
  std::function<Deformation(Deformation deformation, const Deformation& start, Complex amount)> set;
};
/// The edit that rotates a pin by the real part of the amount, in radians. A pin without a rotation
/// starts from this one.
RecordedEdit recorded_rotation(Index pin, double from);

class Recording {
 public:
  /// Starts to record a gesture at the workspace's current time. If keyframes play, everything
  /// that the gesture does not edit keeps moving with them. Otherwise everything else keeps its
  /// displayed pose. If the edit needs other handles than the keyframes have, shows a toast and
  /// returns false.
  bool start(Workspace& workspace, RecordedEdit edit, double now_ms);
  /// Starts at the workspace's current time. If keyframes play, everything except the dragged
  /// handles keeps moving with them. Otherwise everything else keeps its displayed pose. Tangents
  /// of segments whose degree changes with time are left out. If nothing is left to record, shows a
  /// toast and returns false.
  bool start(Workspace& workspace, const Selection& what, double now_ms);
  bool active() const { return !samples_.empty(); }
  /// The deformation at the recorded time that corresponds to `now_ms`, with the dragged handles
  /// displaced by `by` from their positions at the start, or edited by this amount. Sets the
  /// workspace's time to that time.
  Deformation follow(Workspace& workspace, Complex by, double now_ms);
  /// Sets keyframes with linear easing at whole frames, in one step. Smooth easing would come to
  /// rest at both ends of each interval. It sets only the keyframes needed to keep all handles
  /// within about three window px of their paths. In existing keyframes, only the dragged handles
  /// move. Keyframes that do not play are not changed.
  void finish(Workspace& workspace);
  void cancel(Workspace& workspace);

 private:
  struct RecordedPose {
    double time = 0;
    Complex by;
    Pose pose;
    Points positions;  ///< of all handles, and points that stand for their rotations
  };
  bool begin(Workspace& workspace, double now_ms);
  Deformation dragged(Deformation deformation, Complex by) const {
    return edit_.set(std::move(deformation), start_, by);
  }
  Deformation base_at(Workspace& workspace, double time) const;
  RecordedPose sample_at(double time) const;
  std::vector<double> keyframe_times(double tolerance) const;

  RecordedEdit edit_;
  Deformation start_;      ///< the displayed deformation at the start, ready for the edit
  double turn_reach_ = 0;  ///< plane units at which a rotation counts as a movement
  double start_time_ = 0, start_ms_ = 0;
  bool keyframes_play_ = false;
  std::vector<RecordedPose> samples_;
};

/// The status hint during a recording.
std::string recording_hint(const Timeline& timeline);

}  // namespace holomorph
