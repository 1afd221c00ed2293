// The times that hosts of frei0r filters pass, which are not always seconds.
#pragma once

#include <cmath>
#include <optional>

namespace holomorph {

/// Turns the times that a host passes, frame by frame, into seconds. frei0r asks for seconds, which
/// MLT and GStreamer pass. ffmpeg passes milliseconds, rounded as in the file, and nonsense where
/// rows of pixels are padded.
class HostTime {
 public:
  /// `rate` is the number of frames per second. If it is `certain`, times that are not whole frames
  /// are ignored; otherwise, it is only used to count frames. `seconds`: the host is known to pass
  /// seconds, so that all times are used.
  HostTime(double rate, bool certain, bool seconds = false)
      : rate_(rate),
        certain_(certain && !seconds),
        unit_(seconds ? Unit::seconds : Unit::unknown) {}

  /// The time of the next frame. If the host passes nonsense, that is the frame after the last one.
  double seconds(double passed) {
    constexpr double kLatest = 1e9;  // above what any film lasts, even in milliseconds
    if (!(passed >= 0 && passed < kLatest)) return at_frame(next_);
    find_unit(passed);
    const double time = is_seconds(passed) ? passed : passed / 1000;
    const double frame = std::round(time * rate_);
    if (std::abs(time - frame / rate_) < kRounding) return at_frame(frame);
    if (certain_) return at_frame(next_);
    next_ = frame + 1;
    return time;
  }

 private:
  enum class Unit { unknown, seconds, milliseconds };
  static constexpr double kRounding = 0.0006;  ///< seconds; many files have whole milliseconds

  /// The first step tells the unit: frames are not shorter than a millisecond, and hosts that pass
  /// seconds do not happen to step by a thousand frames.
  void find_unit(double passed) {
    const double step = last_ ? std::abs(passed - *last_) : 0;
    last_ = passed;
    if (unit_ != Unit::unknown || step == 0) return;
    const double frames = std::round(step / 1000 * rate_);
    if (step < 1)
      unit_ = Unit::seconds;
    else if (frames >= 1 && std::abs(step / 1000 - frames / rate_) < 2 * kRounding)
      unit_ = Unit::milliseconds;
  }
  bool is_seconds(double passed) const {
    return unit_ == Unit::seconds || (unit_ == Unit::unknown && passed < 1);
  }
  double at_frame(double frame) {
    next_ = frame + 1;
    return frame / rate_;
  }

  double rate_;
  bool certain_;
  Unit unit_;
  std::optional<double> last_;  ///< what was passed before
  double next_ = 0;             ///< the number of the frame after the last one
};

}  // namespace holomorph
