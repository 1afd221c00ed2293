// Runs work on its own thread. The work reports its progress and can be canceled.
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
  /// Passes progress from the work to the owner of the job, and cancellation to the work.
  class Progress {
   public:
    /// Reports that `done` of `all` steps are done. Returns whether to continue.
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

  /// Starts the work. `wake` is called on the job's thread when the work has ended.
  Job(std::string title, Work work, std::function<void()> wake = {});
  ~Job();  ///< cancels the work and waits for its end

  const std::string& title() const { return title_; }
  int done() const { return progress_.done_; }
  int all() const { return progress_.all_; }  ///< 0 while the number of steps is unknown
  void cancel() { progress_.cancelled_ = true; }
  bool cancelled() const { return progress_.cancelled_; }
  bool ended() const { return ended_; }
  /// Waits for at most this long. Returns whether the job has ended.
  bool ended_within(double milliseconds) const;
  /// The error that ended the job, if any.
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
