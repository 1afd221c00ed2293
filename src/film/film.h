// Exports a scene's keyframes as a film.
#pragma once

#include <functional>
#include <optional>

#include "film/film_writer.h"
#include "raster/picture.h"

namespace holomorph {

struct FilmOptions {
  PictureOptions picture = {};  ///< options of each frame; write_film sets the time
  int first = 0, last = -1;     ///< range of frames; last = -1: up to the scene's last frame
  bool loops = true;
  bool keeps_sound = false;  ///< adds the sound of films that are pictures, in formats with sound
};

/// The number of frames of a film from frame `first` to `last`. A film that loops leaves out its
/// last frame if it equals the first one, because both would be shown one after the other.
int frames_of_film(const Scene& scene, int first, int last, bool loops);

/// The film that was written.
struct WrittenFilm {
  int frames = 0, width = 0, height = 0;  ///< number of frames, and their size in pixels
  Complex corner;                         ///< each frame's lower left corner, in the plane
};

/// Draws frames of a scene, as picture_of does, and writes them to a file whose extension selects
/// the format. Without `region` or `crop`, each frame covers the region of the whole motion, so
/// separately exported parts of a film fit together. Calls `progress` with the number of finished
/// frames and the number of all frames. If it returns false, nothing is written and the result is
/// none. Throws Error if the scene has neither keyframes nor films, or if a frame cannot be drawn,
/// read or written. Cost: one picture per frame, on all cores.
std::optional<WrittenFilm> write_film(const Path& out, const Scene& scene, const Image* source,
                                      const FilmOptions& options,
                                      const std::function<bool(int done, int all)>& progress,
                                      const Pictures& others = {});

/// The same film from frames that were drawn before, to pictures of one size that are named by
/// `numbered`. Only the range of frames, `loops` and `keeps_sound` count among the options.
std::optional<WrittenFilm> write_film_of_pictures(
    const Path& out, const Scene& scene, const Path& pictures, const FilmOptions& options,
    const std::function<bool(int done, int all)>& progress, const Pictures& films = {});

}  // namespace holomorph
