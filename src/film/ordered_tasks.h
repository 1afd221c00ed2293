// Runs tasks on all processor cores and delivers their results in order.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <future>
#include <thread>

namespace holomorph {

/// Runs tasks in parallel and delivers their results in the order in which the tasks were added. If
/// a task throws, add() or finish() rethrows the exception.
template <class Result>
class OrderedTasks {
 public:
  /// Runs at most `most` tasks at once; 0: one per processor core.
  explicit OrderedTasks(std::function<void(Result)> take, size_t most = 0)
      : deliver_(std::move(take)),
        most_(most > 0 ? most : std::max(1u, std::thread::hardware_concurrency())) {}

  void add(std::function<Result()> task) {
    if (running_.size() >= most_) deliver_first();
    running_.push_back(std::async(std::launch::async, std::move(task)));
  }
  void finish() {
    while (!running_.empty()) deliver_first();
  }

 private:
  void deliver_first() {
    std::future<Result> first = std::move(running_.front());
    running_.pop_front();
    deliver_(first.get());
  }

  std::function<void(Result)> deliver_;
  size_t most_;
  std::deque<std::future<Result>> running_;
};

}  // namespace holomorph
