// An open film whose frames are kept for a while after they have been decoded.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "scene/formats/film_frames.h"

namespace holomorph {

/// The frames of a film or of numbered pictures. Shared by all layers that show it; safe to use
/// from several threads. All open films together keep about 256 MB of frames, but each keeps at
/// least two.
class Footage {
 public:
  explicit Footage(std::unique_ptr<FrameReader> reader);
  ~Footage();  ///< stops decoding
  Footage(const Footage&) = delete;
  Footage& operator=(const Footage&) = delete;

  const FilmInfo& info() const { return info_; }

  /// A frame, by its number from 0 on; the last one for larger numbers. Waits until it is decoded.
  /// Throws Error.
  std::shared_ptr<const Image> frame(int number);

  /// For a display that must not wait: the frame, or else the nearest earlier one that is kept and
  /// at most a second away, or null. Has the missing frame decoded on another thread, which then
  /// calls `wake`, and a few frames after it. `viewer` tells apart those who ask, such as layers.
  std::shared_ptr<const Image> frame_now(int viewer, int number, const std::function<void()>& wake);
  /// An error of a frame that frame_now() asked for. Each frame is reported once.
  std::optional<Error> take_error();

 private:
  using Frame = std::shared_ptr<const Image>;
  struct Kept {
    Frame image;
    unsigned long used = 0;
  };
  /// What a viewer waits for: the frame with this number, and then those from `next` to `end`.
  struct Request {
    int number = 0, next = 0, end = 0;
  };
  int last() const { return info_.frames - 1; }
  Frame kept(int number);
  void keep(int number, const Frame& image);
  size_t capacity() const;
  Request* next_request();
  void work();

  std::mutex reading_;  ///< held while a frame is decoded
  std::unique_ptr<FrameReader> reader_;
  const FilmInfo info_;

  std::mutex mutex_;  ///< guards everything below
  std::map<int, Kept> kept_;
  size_t frame_bytes_ = 0;  ///< 0: not known yet
  unsigned long clock_ = 0;
  std::map<int, Request> requests_;  ///< by viewer
  std::set<int> failed_;
  std::optional<Error> error_;
  std::function<void()> wake_;
  bool ends_ = false;
  std::condition_variable changed_;
  std::thread thread_;  ///< runs work(); started when it is first needed
};

}  // namespace holomorph
