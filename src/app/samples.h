// The sample scenes of the welcome page.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "render/texture.h"
#include "scene/formats/image.h"
#include "system/job.h"

namespace holomorph {

struct Sample {
  Path scene;
  std::string title, text;
  Texture thumbnail =
      {};  ///< empty until it is drawn, or if the scene cannot be; opening it says why
};

/// The samples that are installed or in the source tree. Their poses are drawn one by one on
/// another thread.
class Samples {
 public:
  /// `wake` is called on another thread when one has been drawn.
  explicit Samples(std::function<void()> wake) : wake_(std::move(wake)) {}
  /// The samples, with the thumbnails drawn so far. Starts drawing if there are more to draw. Needs
  /// a current OpenGL context.
  const std::vector<Sample>& shown();
  /// Stops after the thumbnail that is being drawn. shown() continues.
  void pause() {
    if (drawing_) drawing_->cancel();
  }

 private:
  struct DrawnThumbnails {
    std::mutex mutex;
    std::vector<std::pair<size_t, Image>> images;
  };
  void start();

  std::function<void()> wake_;
  bool listed_ = false;
  std::vector<Sample> samples_;
  std::vector<char> done_;  ///< for each: whether it has been drawn, or cannot be
  std::shared_ptr<DrawnThumbnails> drawn_;
  std::unique_ptr<Job> drawing_;
};

}  // namespace holomorph
