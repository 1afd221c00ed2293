// All frames cover the same rectangle; otherwise the picture would jump.
#include "film/film.h"

#include "core/error.h"
#include "scene/budget.h"
#include "scene/keyframes.h"

namespace holomorph {

std::optional<WrittenFilm> write_film(const Path& out, const Scene& scene, const Image* source,
                                      const FilmOptions& options,
                                      const std::function<bool(int done, int all)>& progress,
                                      const Pictures& others) {
  const FilmFormat& format = film_format_of(out);
  if (!has_keyframes(scene))
    throw Error(ErrorKind::bad_input, "a film needs keyframes, and the scene has none");
  const int last = options.last < 0 ? last_frame_of(scene) : options.last,
            frames = last - options.first + 1;
  if (options.first < 0 || frames < 1 || last > last_frame_of(scene))
    throw Error(ErrorKind::bad_input,
                "the scene has frames 0 to " + std::to_string(last_frame_of(scene)) + ", not " +
                    std::to_string(options.first) + " to " + std::to_string(last));
  check_budget(&Budget::frames, frames, "the film has");
  const double rate = scene.animation.frames_per_second;
  PictureMaker maker(scene, source, others);
  PictureOptions picture = options.picture;
  if (!picture.crop && !picture.region) {
    picture.region = maker.motion_region([&] { return progress(0, frames); });
    if (!picture.region) return {};
  }
  WrittenFilm film{frames, 0, 0, 0};
  std::unique_ptr<FilmWriter> writer;
  for (int i = 0; i < frames; ++i) {
    if (!progress(i, frames)) return {};
    picture.time = (options.first + i) / rate;
    const RasterResult frame = maker.picture(picture);
    if (!writer) {
      film = {frames, frame.image.width, frame.image.height, frame.corner};
      writer = format.open(out, {film.width, film.height, rate, options.loops});
    }
    writer->add(frame.image);
  }
  if (!progress(frames, frames)) return {};
  writer->finish();
  return film;
}

}  // namespace holomorph
