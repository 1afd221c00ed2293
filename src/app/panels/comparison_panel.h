// The window that compares Holomorph's maps with those of other methods, one row per map.
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
  /// `wake` is called on the worker thread after each row.
  explicit ComparisonPanel(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Opens the window and starts the comparison. See can_be_compared().
  void start(const Deformation& deformation);
  /// The number of finished rows.
  int rows() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(rows_.size());
  }
  /// Draws the window, and draws the chosen row's map over the canvas.
  void draw(const Workspace& workspace, const OverlayStyle& style);

 private:
  void work(const Deformation& deformation, std::stop_token stop);
  /// Returns whether the user asked to compare again.
  bool draw_window(const Workspace& workspace, const OverlayStyle& style);
  void draw_table(double scale);
  void draw_map(const Workspace& workspace, const OverlayStyle& style) const;

  std::function<void()> wake_;
  bool open_ = false;
  int chosen_ = -1;  ///< row; -1: none
  std::optional<Deformation> deformation_;

  mutable std::mutex mutex_;  ///< guards the members below, except worker_
  std::shared_ptr<const Mesh> mesh_;
  std::vector<ComparedMap> rows_;
  std::string failure_;
  bool computing_ = false;
  std::jthread worker_;  ///< declared last, so it ends before the other members are destroyed
};

}  // namespace holomorph
