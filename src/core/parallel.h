// Runs loops on all processor cores.
#pragma once

#include <functional>

namespace holomorph {

/// Calls `body` once for each number from 0 to count - 1, on this thread and others. Uses `threads`
/// threads in total, or one per core if `threads` is 0. `progress` is called on this thread with
/// the number of calls that have been started. An exception in any call ends the loop and is
/// rethrown.
void parallel_for(int count, const std::function<void(int)>& body,
                  const std::function<void(int)>& progress = {}, int threads = 0);

}  // namespace holomorph
