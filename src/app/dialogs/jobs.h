// Runs long work on another thread. A dialog shows its progress and can cancel it.
#pragma once

#include "edit/workspace.h"
#include "system/job.h"

namespace holomorph {

/// Runs one job at a time. While it runs, a dialog over the window receives all input.
class Jobs {
 public:
  /// `wake` is called on another thread when a job has ended.
  Jobs(Workspace& workspace, std::function<void()> wake)
      : workspace_(workspace), wake_(std::move(wake)) {}

  /// Runs `work` on another thread. If the work succeeds and is not canceled, calls `then` on this
  /// thread. If the work is short, waits for it and returns its error message, or "". Waiting
  /// avoids flicker. Errors of longer work are shown as toasts. Cancels a job that is already
  /// running. `quietly`: without a dialog, for work that a gesture on the canvas needs. Until it
  /// has ended, quiet() is true, and input should wait.
  std::string run(const std::string& title, Job::Work work, std::function<void()> then,
                  bool quietly = false);
  bool running() const { return job_ != nullptr; }
  bool quiet() const { return job_ && quiet_; }
  /// The title of the running job.
  const std::string& title() const { return job_->title(); }
  /// Ends the running job.
  void cancel();
  /// Draws the running job's dialog, and calls `then` once the work has ended. `then` may start
  /// another job.
  void draw();

 private:
  void abandon();
  std::string finish();

  Workspace& workspace_;
  std::function<void()> wake_;
  std::unique_ptr<Job> job_;
  std::function<void()> then_;
  bool quiet_ = false;
  std::vector<std::unique_ptr<Job>> abandoned_;  ///< canceled, but not ended yet
};

}  // namespace holomorph
