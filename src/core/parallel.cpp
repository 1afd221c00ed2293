// Each free thread takes the next number.
#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace holomorph {

void parallel_for(int count, const std::function<void(int)>& body,
                  const std::function<void(int)>& progress, int threads) {
  if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&](bool reports) {
    try {
      for (int i = next++; i < count; i = next++) {
        body(i);
        if (reports && progress) progress(std::min(next.load(), count));
      }
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (int i = 1; i < std::min(threads, count); ++i) others.emplace_back(work, false);
    } catch (const std::system_error&) {
      // The threads that have been started, or this thread alone, do all the work.
    }
    work(true);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace holomorph
