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
  const int frames = last_frame_of(scene) + 1;
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) times.push_back(i / scene.animation.frames_per_second);
  PictureMaker maker(scene, source, others);
  PictureOptions picture{options.view, options.scale, options.crop};
  if (!options.crop) {
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

FilmJob::FilmJob(Path out, Scene scene, std::shared_ptr<const Image> source, FilmOptions options,
                 Pictures others)
    : out_(std::move(out)),
      thread_([this, scene = std::move(scene), source = std::move(source), options,
               others = std::move(others)] {
        try {
          const auto go_on = [this](int done, int all) {
            done_ = done;
            all_ = all;
            return !cancelled_;
          };
          written_ = write_film(out_, scene, source.get(), options, go_on, others);
        } catch (const Error& error) {
          const std::lock_guard lock(mutex_);
          error_ = error;
        } catch (const std::exception& error) {
          const std::lock_guard lock(mutex_);
          error_ = Error(ErrorKind::failed, std::string("the film failed: ") + error.what());
        }
        ended_ = true;
      }) {}

FilmJob::~FilmJob() {
  cancel();
  thread_.join();
}

std::optional<Error> FilmJob::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

}  // namespace holomorph
