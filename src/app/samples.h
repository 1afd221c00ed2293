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
      {};  ///< empty until drawn, or if drawing failed; opening the scene then shows the error
};

/// The sample scenes of the installed program or of the source tree. Another thread draws their
/// thumbnails one by one.
class Samples {
 public:
  /// `wake` is called on another thread after each thumbnail.
  explicit Samples(std::function<void()> wake) : wake_(std::move(wake)) {}
  /// The samples, with the thumbnails drawn so far. Starts drawing the missing thumbnails. Needs a
  /// current OpenGL context.
  const std::vector<Sample>& shown();
  /// Stops drawing after the current thumbnail. The next call of shown() resumes it.
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
  std::vector<char> done_;  ///< for each sample: whether drawing it has succeeded or failed
  std::shared_ptr<DrawnThumbnails> drawn_;
  std::unique_ptr<Job> drawing_;
};

}  // namespace holomorph
