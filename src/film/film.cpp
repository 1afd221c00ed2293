// One rectangle for all frames, so that nothing jumps.
#include "film/film.h"

#include "core/error.h"
#include "scene/keyframes.h"

namespace holomorph {

bool write_film(const Path& out, const Scene& scene, const Image* source,
                const FilmOptions& options, const std::function<bool(int done, int all)>& progress,
                const Pictures& others) {
  const FilmFormat& format = film_format_of(out);
  if (!has_keyframes(scene))
    throw Error(ErrorKind::bad_input, "the scene has no keyframes, so there is no film in it");
  const int last = options.last < 0 ? last_frame_of(scene) : options.last,
            frames = last - options.first + 1;
  if (options.first < 0 || frames < 1 || last > last_frame_of(scene))
    throw Error(ErrorKind::bad_input,
                "the scene has frames 0 to " + std::to_string(last_frame_of(scene)) + ", and not " +
                    std::to_string(options.first) + " to " + std::to_string(last));
  std::vector<double> times;
  for (int i = options.first; i <= last; ++i)
    times.push_back(i / scene.animation.frames_per_second);
  PictureMaker maker(scene, source, others);
  PictureOptions picture = options.picture;
  if (!picture.crop && !picture.shows) {
    picture.shows = maker.shown_at(times, [&] { return progress(0, frames); });
    if (!picture.shows) return false;
  }
  std::unique_ptr<FilmWriter> writer;
  for (int i = 0; i < frames; ++i) {
    if (!progress(i, frames)) return false;
    picture.time = times[static_cast<size_t>(i)];
    const Image frame = maker.picture(picture).image;
    if (!writer)
      writer = format.open(
          out, {frame.width, frame.height, scene.animation.frames_per_second, options.loops});
    writer->add(frame);
  }
  if (!progress(frames, frames)) return false;
  writer->finish();
  return true;
}

}  // namespace holomorph
