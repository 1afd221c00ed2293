// Loops on all processor cores.
#pragma once

#include <functional>

namespace holomorph {

/// Calls `body` once for each number below `count`, on this thread and others: as many as there are
/// cores, or `threads`. `progress` is called on this thread with how many have been started. What
/// any of them throws ends the loop and is thrown here.
void parallel_for(int count, const std::function<void(int)>& body,
                  const std::function<void(int)>& progress = {}, int threads = 0);

}  // namespace holomorph
