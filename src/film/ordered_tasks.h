// Runs tasks on all processor cores and delivers their results in order.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <future>
#include <thread>

namespace holomorph {

/// Runs tasks in parallel, one per processor core, and passes on their results in the order in
/// which the tasks were added. add() or finish() rethrows what a task throws.
template <class Result>
class OrderedTasks {
 public:
  explicit OrderedTasks(std::function<void(Result)> take) : take_(std::move(take)) {}

  void add(std::function<Result()> task) {
    if (running_.size() >= std::max(1u, std::thread::hardware_concurrency())) take_first();
    running_.push_back(std::async(std::launch::async, std::move(task)));
  }
  void finish() {
    while (!running_.empty()) take_first();
  }

 private:
  void take_first() {
    std::future<Result> first = std::move(running_.front());
    running_.pop_front();
    take_(first.get());
  }

  std::function<void(Result)> take_;
  std::deque<std::future<Result>> running_;
};

}  // namespace holomorph
