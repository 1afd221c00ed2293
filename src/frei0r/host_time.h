// The times that hosts of frei0r filters pass, which are not always seconds.
#pragma once

#include <cmath>
#include <optional>

namespace holomorph {

/// Turns the times that a host passes, frame by frame, into seconds. frei0r asks for seconds, which
/// MLT passes. ffmpeg passes milliseconds, rounded as in the file, and nonsense where rows of
/// pixels are padded.
class HostTime {
 public:
  /// `rate` is the number of frames in a second. If it is `certain`, a time that is no whole number
  /// of frames is nonsense. Otherwise, it is only used to count frames.
  HostTime(double rate, bool certain, bool seconds = false)
      : rate_(rate), certain_(certain), seconds_(seconds) {}

  /// The time of the next frame. After nonsense, it is that of the frame after the last one.
  double seconds(double passed) {
    constexpr double kLatest = 1e9;  // above what any film lasts, even in milliseconds
    if (!(passed >= 0 && passed < kLatest)) return at_frame(next_);
    // No frame is shorter than a millisecond.
    const auto is_short = [](double time) { return time > 0 && time < 1; };
    if (is_short(passed) || (last_ && is_short(std::abs(passed - *last_)))) seconds_ = true;
    last_ = passed;
    const double time = seconds_ ? passed : passed / 1000;
    const double frame = std::round(time * rate_);
    constexpr double kRounding = 0.0006;  // seconds; many files have whole milliseconds
    if (std::abs(time - frame / rate_) < kRounding) return at_frame(frame);
    if (certain_) return at_frame(next_);
    next_ = frame + 1;
    return time;
  }

 private:
  double at_frame(double frame) {
    next_ = frame + 1;
    return frame / rate_;
  }

  double rate_;
  bool certain_, seconds_;
  std::optional<double> last_;  ///< what was passed before
  double next_ = 0;             ///< the number of the frame after the last one
};

}  // namespace holomorph
