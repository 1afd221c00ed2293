// A scene's keyframes as a film.
#pragma once

#include <functional>

#include "film/film_writer.h"
#include "raster/picture.h"

namespace holomorph {

struct FilmOptions {
  PictureOptions picture = {};  ///< of each frame; the time is set here
  int first = 0, last = -1;     ///< frames; the last one of all: -1
  bool loops = true;
};

/// Draws frames of a scene, as picture_of does, into a file whose extension says the kind.
/// `progress` is told how many frames are done and how many there are; when it returns false
/// nothing is written. Throws Error for a scene without keyframes and for what cannot be drawn or
/// written. Returns whether the film is there. Cost: a picture for each frame, on all cores.
bool write_film(const Path& out, const Scene& scene, const Image* source,
                const FilmOptions& options, const std::function<bool(int done, int all)>& progress,
                const Pictures& others = {});

}  // namespace holomorph
