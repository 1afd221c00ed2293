// The window that compares this program's projection with others', row by row.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "app/canvas/overlay.h"
#include "core/compared/comparison.h"

namespace holomorph {

class ComparisonPanel {
 public:
  /// `wake` is called by the worker for each row.
  explicit ComparisonPanel(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Opens the window and starts comparing for a deformation of method `bounded`.
  void start(const Deformation& deformation);
  /// How many rows are done.
  int rows() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(rows_.size());
  }
  /// Draws the window, and the chosen row's map over the canvas.
  void draw(const Workspace& workspace, const OverlayStyle& style);

 private:
  void work(const Deformation& deformation, std::stop_token stop);
  /// Returns whether to compare again.
  bool draw_window(const Workspace& workspace, const OverlayStyle& style);
  void draw_table(double scale);
  void draw_map(const Workspace& workspace, const OverlayStyle& style) const;

  std::function<void()> wake_;
  bool open_ = false;
  int chosen_ = -1;  ///< row
  std::optional<Deformation> deformation_;

  mutable std::mutex mutex_;  ///< guards what follows
  std::shared_ptr<const Mesh> mesh_;
  std::vector<ComparedMap> rows_;
  std::string failure_;
  bool working_ = false;
  std::jthread worker_;  ///< last, so that it ends before what it uses
};

}  // namespace holomorph
