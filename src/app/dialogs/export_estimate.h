// Estimates the size of the file that an export will write, and measures the error of meshes.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "app/dialogs/export_work.h"

namespace holomorph {

/// Draws a small picture on another thread, encodes it, and extrapolates. Meshes are made as they
/// will be exported.
class ExportEstimate {
 public:
  struct Question {
    Scene scene;
    PictureOptions options = {};
    std::string extension;
    std::optional<int> depth = {};  ///< of a picture, as in ExportSettings
    bool film = false;
    int first = 0, frames = 1;
    std::optional<MeshExport> meshes = {};  ///< if meshes are exported
    bool operator==(const Question& other) const;
  };

  /// `wake` is called on another thread when the estimate is ready.
  explicit ExportEstimate(std::function<void()> wake) : wake_(std::move(wake)) {}
  /// Starts a new estimate if the question has changed. Call this in every frame.
  void update(Question question, const Pictures& pictures);
  /// Cancels the estimate. Call this while there is no question.
  void stop();
  /// The estimate, such as "3.4 MB", or for meshes "3 meshes, ... at most 0.2 px off"; empty while
  /// it is unknown.
  const std::string& text() const { return text_; }

 private:
  struct Result {
    std::mutex mutex;
    std::string text;
  };
  std::function<void()> wake_;
  std::optional<Question> asked_;
  std::shared_ptr<Result> result_;
  std::string text_;
  std::unique_ptr<Job> job_;
};

}  // namespace holomorph
