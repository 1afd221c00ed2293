// A scene's keyframes as a film.
#pragma once

#include <functional>
#include <optional>

#include "film/film_writer.h"
#include "raster/picture.h"

namespace holomorph {

struct FilmOptions {
  PictureOptions picture = {};  ///< of each frame; the time is set here
  int first = 0, last = -1;     ///< frames; the last one of all: -1
  bool loops = true;
};

/// What has been written.
struct WrittenFilm {
  int frames = 0, width = 0, height = 0;  ///< of each frame, in pixels
  Complex corner;                         ///< each frame's lower left one, in the plane
};

/// Draws frames of a scene, as picture_of does, into a file whose extension says the kind. Without
/// `shows` or `crop` each frame has the rectangle that the whole motion needs, so that
/// parts fit together. `progress` is told how many frames are done and how many there are; when it
/// returns false nothing is written. Throws Error for a scene without keyframes and for what cannot
/// be drawn or written. Returns none when nothing is written. Cost: a picture for each frame, on
/// all cores.
std::optional<WrittenFilm> write_film(const Path& out, const Scene& scene, const Image* source,
                                      const FilmOptions& options,
                                      const std::function<bool(int done, int all)>& progress,
                                      const Pictures& others = {});

}  // namespace holomorph
