// What takes long happens beside the window, which shows how far it is and can cancel it.
#pragma once

#include "edit/workspace.h"
#include "system/job.h"

namespace holomorph {

/// Runs one job at a time; while it runs a dialog over the window takes all input.
class Jobs {
 public:
  /// `wake` is called on other threads when a job has ended.
  Jobs(Workspace& workspace, std::function<void()> wake)
      : workspace_(workspace), wake_(std::move(wake)) {}

  /// Does work on another thread and `then` on this one, unless it fails or is cancelled. Short
  /// work has ended when this returns. Returns what was wrong with such work, or ""; what goes
  /// wrong later is a toast. A job that is running already is cancelled.
  std::string run(const std::string& title, Job::Work work, std::function<void()> then);
  bool running() const { return job_ != nullptr; }
  /// Draws the running job's dialog, and ends jobs that have ended. `then` may start another one.
  void draw(double scale);

 private:
  void abandon();
  std::string finish();

  Workspace& workspace_;
  std::function<void()> wake_;
  std::unique_ptr<Job> job_;
  std::function<void()> then_;
  std::vector<std::unique_ptr<Job>> abandoned_;  ///< cancelled; they end when they notice
};

}  // namespace holomorph
