// Parallel loops: each index is visited once, progress is reported on the calling thread, and
// exceptions reach the caller.
#include "core/parallel.h"
#include "support/catch.h"

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace holomorph::parallel_test {

TEST_CASE("A parallel loop visits each index once, with any number of threads") {
  for (const int threads : {0, 1, 2, 7})
    for (const int count : {0, 1, 5, 1000}) {
      INFO(threads << " threads, " << count << " numbers");
      std::vector<std::atomic<int>> visits(static_cast<size_t>(count));
      parallel_for(
          count, [&](int i) { ++visits[static_cast<size_t>(i)]; }, {}, threads);
      for (const auto& visit : visits) CHECK(visit == 1);
    }
}

TEST_CASE("A parallel loop reports its progress on the calling thread, and it never decreases") {
  const auto caller = std::this_thread::get_id();
  int last = 0;
  bool elsewhere = false, backwards = false;
  parallel_for(
      200, [](int) { std::this_thread::yield(); },
      [&](int started) {
        elsewhere = elsewhere || std::this_thread::get_id() != caller;
        backwards = backwards || started < last || started > 200;
        last = started;
      });
  CHECK_FALSE(elsewhere);
  CHECK_FALSE(backwards);
}

TEST_CASE(
    "An exception from a parallel loop's body or progress report ends it and reaches the caller") {
  std::atomic<int> visits = 0;
  const auto body = [&](int i) {
    ++visits;
    if (i == 10) throw std::runtime_error("ten");
  };
  CHECK_THROWS_WITH(parallel_for(1'000'000, body), "ten");
  CHECK(visits < 1'000'000);
  const auto stop = [](int started) {
    if (started > 3) throw std::runtime_error("stopped");
  };
  CHECK_THROWS_WITH(parallel_for(
                        1'000'000, [](int) {}, stop, 1),
                    "stopped");
}

}  // namespace holomorph::parallel_test
