// A scene's keyframes as a film.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

#include "film/film_writer.h"
#include "raster/picture.h"

namespace holomorph {

struct FilmOptions {
  double scale = 1;   ///< output pixels per image pixel
  bool crop = false;  ///< keep the picture's rectangle; else nothing is cut off in any frame
  View view = View::image;
  bool loops = true;
};

/// Draws all frames of a scene, as picture_of does, into a file whose extension says the kind.
/// `progress` is told how many frames are done and how many there are; when it returns false
/// nothing is written. Throws Error for a scene without keyframes and for what cannot be drawn or
/// written. Returns whether the film is there. Cost: a picture for each frame, on all cores.
bool write_film(const Path& out, const Scene& scene, const Image* source,
                const FilmOptions& options, const std::function<bool(int done, int all)>& progress,
                const Pictures& others = {});

/// The same on a thread of its own.
class FilmJob {
 public:
  FilmJob(Path out, Scene scene, std::shared_ptr<const Image> source, FilmOptions options,
          Pictures others = {});
  ~FilmJob();  ///< cancels

  const Path& out() const { return out_; }
  int done() const { return done_; }
  int all() const { return all_; }
  void cancel() { cancelled_ = true; }
  bool ended() const { return ended_; }
  /// Of an ended job: what went wrong, and whether the film is there.
  std::optional<Error> error() const;
  bool written() const { return written_; }

 private:
  Path out_;
  std::atomic<int> done_ = 0, all_ = 1;
  std::atomic<bool> cancelled_ = false, ended_ = false, written_ = false;
  mutable std::mutex mutex_;
  std::optional<Error> error_;
  std::thread thread_;
};

}  // namespace holomorph
