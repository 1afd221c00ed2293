// Work on a thread of its own that says how far it is and can be cancelled.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/error.h"

namespace holomorph {

class Job {
 public:
  /// What work tells of itself, and is asked.
  class Progress {
   public:
    /// So many steps of so many are done. Returns whether to go on.
    bool at(int done, int all) {
      done_ = done;
      all_ = all;
      return !cancelled_;
    }
    bool cancelled() const { return cancelled_; }

   private:
    friend class Job;
    std::atomic<int> done_ = 0, all_ = 0;
    std::atomic<bool> cancelled_ = false;
  };
  using Work = std::function<void(Progress&)>;

  /// Starts. `wake` is called on the job's thread when it has ended.
  Job(std::string title, Work work, std::function<void()> wake = {});
  ~Job();  ///< cancels and waits

  const std::string& title() const { return title_; }
  int done() const { return progress_.done_; }
  int all() const { return progress_.all_; }  ///< 0 before it is known, or where it never is
  void cancel() { progress_.cancelled_ = true; }
  bool cancelled() const { return progress_.cancelled_; }
  bool ended() const { return ended_; }
  /// Whether it has ended, after waiting for at most so long.
  bool ends_within(double milliseconds) const;
  /// Of an ended job: what went wrong.
  std::optional<Error> error() const;

 private:
  std::string title_;
  Progress progress_;
  std::atomic<bool> ended_ = false;
  mutable std::mutex mutex_;
  std::optional<Error> error_;
  std::thread thread_;
};

}  // namespace holomorph
