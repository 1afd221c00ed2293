// A clock for measuring durations.
#pragma once

#include <chrono>

namespace holomorph {

/// Milliseconds on a clock that never jumps. Only differences are meaningful.
inline double now_ms() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count();
}

}  // namespace holomorph
