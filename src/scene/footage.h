// An open film whose frames are kept for a while after they have been decoded.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "scene/formats/film_frames.h"

namespace holomorph {

/// The frames of a film or of numbered pictures. Shared by all who show it; safe to use from
/// several threads. Keeps at most about 256 MB of frames.
class Footage {
 public:
  explicit Footage(std::unique_ptr<FrameReader> reader)
      : reader_(std::move(reader)), info_(reader_->info()) {}
  ~Footage();
  Footage(const Footage&) = delete;
  Footage& operator=(const Footage&) = delete;

  const FilmInfo& info() const { return info_; }

  /// A frame, by its number from 0 on; the last one for larger numbers. Waits until it is decoded.
  /// Throws Error.
  std::shared_ptr<const Image> frame(int number);

  /// For a display that must not wait: the frame, or else the nearest one before it that is kept
  /// and at most a second away, or null. Has the missing frame decoded on another thread, which
  /// then calls `wake`, and reads a few frames ahead.
  std::shared_ptr<const Image> frame_now(int number, const std::function<void()>& wake);
  /// The error of the last frame that frame_now() asked for, only once.
  std::optional<Error> take_error();

 private:
  using Frame = std::shared_ptr<const Image>;
  struct Kept {
    Frame image;
    unsigned long used = 0;
  };
  Frame kept(int number);
  void keep(int number, const Frame& image);
  void work();

  std::mutex reading_;  ///< held while a frame is decoded
  std::unique_ptr<FrameReader> reader_;
  const FilmInfo info_;

  std::mutex mutex_;  ///< guards everything below
  std::map<int, Kept> kept_;
  size_t most_ = 0;  ///< number of frames that may be kept, once their size is known
  unsigned long clock_ = 0;
  std::optional<int> wanted_, failed_;
  std::optional<Error> error_;
  std::function<void()> wake_;
  bool ends_ = false;
  std::condition_variable changed_;
  std::thread thread_;  ///< runs work(); started when it is first needed
};

}  // namespace holomorph
