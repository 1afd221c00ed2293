// Runs long work on another thread. A dialog shows its progress and can cancel it.
#pragma once

#include <utility>

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
  /// running.
  std::string run(const std::string& title, Job::Work work, std::function<void()> then);
  /// The same for work that the user did not ask for by name, such as a cage for the first pin. Its
  /// dialog comes only after two seconds. Until then, quiet() is true, and input should wait.
  std::string run_quietly(const std::string& title, Job::Work work, std::function<void()> then);
  bool running() const { return job_ != nullptr; }
  bool quiet() const;
  /// Whether the user has canceled a job since the last call.
  bool take_cancel() { return std::exchange(canceled_, false); }
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
  bool canceled_ = false;
  double quiet_until_ms_ = 0;                    ///< on the clock of now_ms()
  std::vector<std::unique_ptr<Job>> abandoned_;  ///< canceled, but not ended yet
};

}  // namespace holomorph
