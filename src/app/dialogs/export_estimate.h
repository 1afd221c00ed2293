// Estimates the size of the file that an export will write.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "raster/picture.h"
#include "system/job.h"

namespace holomorph {

/// Draws a small picture on another thread, encodes it, and extrapolates.
class ExportEstimate {
 public:
  struct Question {
    Scene scene;
    PictureOptions options;
    std::string extension;
    bool film = false;
    int first = 0, frames = 1;
    bool operator==(const Question& other) const;
  };

  /// `wake` is called on another thread when the estimate is ready.
  explicit ExportEstimate(std::function<void()> wake) : wake_(std::move(wake)) {}
  /// Starts a new estimate if the question has changed. Call this in every frame.
  void update(Question question, const Pictures& pictures);
  /// The estimate, such as "3.4 MB"; empty while it is unknown.
  std::string text() const;

 private:
  struct Result {
    std::mutex mutex;
    std::optional<double> bytes;
  };
  std::function<void()> wake_;
  std::optional<Question> asked_;
  std::shared_ptr<Result> result_;
  std::optional<double> bytes_;
  std::unique_ptr<Job> job_;
};

}  // namespace holomorph
