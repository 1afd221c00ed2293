// How long things take.
#pragma once

#include <chrono>

namespace holomorph {

/// Milliseconds of a clock that never jumps; only differences mean something.
inline double now_ms() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count();
}

}  // namespace holomorph
