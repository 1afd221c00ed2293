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
      {};  ///< empty until it is drawn, and when the scene cannot be: opening says why
};

/// The samples that are installed or lie in the source tree, drawn one by one as they are posed,
/// beside the window.
class Samples {
 public:
  /// `wake` is called on another thread when one has been drawn.
  explicit Samples(std::function<void()> wake) : wake_(std::move(wake)) {}
  /// Starts drawing them if need be, and takes over what has been drawn. Needs a current OpenGL
  /// context.
  const std::vector<Sample>& shown();
  /// Stops after the one that is being drawn; shown() goes on.
  void pause() {
    if (drawing_) drawing_->cancel();
  }

 private:
  struct Drawn {
    std::mutex mutex;
    std::vector<std::pair<size_t, Image>> images;
  };
  void start();

  std::function<void()> wake_;
  bool listed_ = false;
  std::vector<Sample> samples_;
  std::vector<char> done_;  ///< for each: whether it has been drawn, or cannot be
  std::shared_ptr<Drawn> drawn_;
  std::unique_ptr<Job> drawing_;
};

}  // namespace holomorph
