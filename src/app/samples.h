// The sample scenes of the welcome page.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "render/texture.h"
#include "scene/formats/image.h"
#include "system/job.h"

namespace holomorph {

struct Sample {
  Path scene;
  std::string title, line, text;  ///< the line stands below the title; the text is a tooltip
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
  /// The picture to show for a sample now: a frame of its motion, its thumbnail, or null.
  const Texture* picture(size_t sample) const;
  /// How far a sample's motion has been played, 0 to 1; -1 if it does not play.
  float progress(size_t sample) const;
  /// Plays the motion of a sample from its rest shape to its pose and back, and stops that of all
  /// others. The first time, another thread draws the frames. Call this in every frame.
  void play(std::optional<size_t> sample);
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
  void start_motion(size_t sample);
  void take_frames();
  std::optional<size_t> frame(size_t sample) const;

  /// The frames of one sample's motion that are drawn so far.
  struct Motion {
    std::vector<Texture> frames;
    bool complete = false;
  };

  std::function<void()> wake_;
  bool listed_ = false;
  std::vector<Sample> samples_;
  std::vector<char> done_;  ///< for each sample: whether drawing it has succeeded or failed
  std::shared_ptr<DrawnThumbnails> drawn_;
  std::unique_ptr<Job> drawing_;
  std::map<size_t, Motion> motions_;
  std::shared_ptr<DrawnThumbnails> drawn_frames_;
  size_t drawn_sample_ = 0;  ///< whose motion is drawn
  std::unique_ptr<Job> drawing_motion_;
  std::optional<size_t> playing_;
  double since_ms_ = 0;  ///< when the pointer arrived
};

}  // namespace holomorph
