// All frames cover the same rectangle; otherwise the picture would jump.
#include "film/film.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "raster/compose.h"
#include "scene/attachments.h"
#include "scene/budget.h"
#include "scene/clips.h"
#include "scene/keyframes.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

/// The key that a layer shows at a time: the key at this time, or the first or last key before or
/// after all others. Null between two keys.
const Keyframe* key_shown_at(const Deformation& deformation, double time) {
  const std::vector<size_t> playing = playing_keys(deformation);
  if (playing.empty()) return nullptr;
  const Keyframe &first = deformation.keyframes[playing.front()],
                 &last = deformation.keyframes[playing.back()];
  if (time <= first.time) return &first;
  if (time >= last.time - 1e-9) return &last;
  const size_t key = key_at(deformation, time);
  return std::ranges::find(playing, key) == playing.end() ? nullptr : &deformation.keyframes[key];
}

/// Whether two poses show the same picture. Pins may have turned by whole turns.
bool look_alike(const Pose& a, const Pose& b) {
  if (a.cage != b.cage || a.strokes != b.strokes || a.corners != b.corners ||
      a.pins.size() != b.pins.size())
    return false;
  for (size_t i = 0; i < a.pins.size(); ++i) {
    const PosePin &p = a.pins[i], &q = b.pins[i];
    constexpr double kSame = 1e-9;
    if (p.position != q.position || p.scale != q.scale ||
        std::abs(std::remainder(p.angle - q.angle, 2 * kPi)) > kSame)
      return false;
  }
  return true;
}

}  // namespace

int frames_of_film(const Scene& scene, int first, int last, bool loops) {
  const int all = last - first + 1;
  if (!loops || all < 2) return all;
  const double rate = scene.animation.frames_per_second;
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Deformation& deformation = scene.layers[i]->deformation;
    if (const Clip* clip = clip_of(*scene.layers[i]); clip && is_shown(scene, i))
      if (clip_frame_at(*clip, first / rate) != clip_frame_at(*clip, last / rate)) return all;
    const bool shows_motion = scene.layers[i]->visible || carries_others(scene, i);
    if (!shows_motion || playing_keys(deformation).empty()) continue;
    const Keyframe *from = key_shown_at(deformation, first / rate),
                   *to = key_shown_at(deformation, last / rate);
    if (!from || !to || !look_alike(from->pose, to->pose)) return all;
  }
  return all - 1;
}

namespace {

/// The frames of a film: `count` of them from `first` on.
struct FilmFrames {
  int first = 0, count = 0;
};

/// Throws Error if the scene has no such frames.
FilmFrames frames_of(const Scene& scene, const FilmOptions& options) {
  if (!has_time(scene))
    throw Error(ErrorKind::bad_input,
                "a film needs keyframes or a film as a picture, and the scene has neither");
  const int last = options.last < 0 ? last_frame_of(scene) : options.last;
  if (options.first < 0 || last < options.first || last > last_frame_of(scene))
    throw Error(ErrorKind::bad_input,
                "the scene has frames 0 to " + std::to_string(last_frame_of(scene)) + ", not " +
                    std::to_string(options.first) + " to " + std::to_string(last));
  const int frames = frames_of_film(scene, options.first, last, options.loops);
  check_budget(&Budget::frames, frames, "the film has");
  return {options.first, frames};
}

/// The film's properties, without the size of its frames. Throws Error if it should have sound, but
/// there is none.
FilmShape shape_of(const Path& out, const Scene& scene, const FilmFrames& frames,
                   const FilmOptions& options, const Pictures& pictures) {
  const double rate = scene.animation.frames_per_second;
  FilmShape shape{0, 0, rate, options.loops, frames.count / rate};
  if (!options.keeps_sound) return shape;
  if (!film_format_of(out).can_have_sound)
    throw Error(ErrorKind::bad_input,
                out.string() + ": this format has no sound; choose .mp4 or .webm");
  shape.sound = sound_of(scene, pictures, frames.first / rate);
  if (shape.sound.empty())
    throw Error(ErrorKind::bad_input, "none of the visible layers has a film with sound");
  return shape;
}

/// Writes the frames that `frame_at` gives for the numbers from 0 on.
std::optional<WrittenFilm> write_frames(const Path& out, const FilmShape& settings, int frames,
                                        const std::function<RasterResult(int)>& frame_at,
                                        const std::function<bool(int done, int all)>& progress) {
  const FilmFormat& format = film_format_of(out);
  WrittenFilm film{frames, 0, 0, 0};
  std::unique_ptr<FilmWriter> writer;
  for (int i = 0; i < frames; ++i) {
    if (!progress(i, frames)) return {};
    const RasterResult frame = frame_at(i);
    if (!writer) {
      film = {frames, frame.image.width, frame.image.height, frame.corner};
      FilmShape shape = settings;
      shape.width = film.width;
      shape.height = film.height;
      writer = format.open(out, shape);
    }
    if (frame.image.width != film.width || frame.image.height != film.height)
      throw Error(ErrorKind::bad_input,
                  "frame " + std::to_string(i) + " of the film has " +
                      std::to_string(frame.image.width) + " x " +
                      std::to_string(frame.image.height) + " pixels, and the first one " +
                      std::to_string(film.width) + " x " + std::to_string(film.height) +
                      "; draw all of them again with the same options");
    writer->add(frame.image);
  }
  if (!progress(frames, frames)) return {};
  writer->finish();
  return film;
}

}  // namespace

std::optional<WrittenFilm> write_film(const Path& out, const Scene& scene, const Image* source,
                                      const FilmOptions& options,
                                      const std::function<bool(int done, int all)>& progress,
                                      const Pictures& others) {
  film_format_of(out);  // fails early if the format is unknown
  const FilmFrames range = frames_of(scene, options);
  const int frames = range.count;
  const double rate = scene.animation.frames_per_second;
  const FilmShape shape = shape_of(out, scene, range, options, others);
  PictureMaker maker(scene, source, others);
  PictureOptions picture = options.picture;
  if (!picture.crop && !picture.region) {
    picture.region = maker.motion_region([&] { return progress(0, frames); });
    if (!picture.region) return {};
  }
  const auto frame_at = [&](int i) {
    picture.time = (range.first + i) / rate;
    return maker.picture(picture);
  };
  // All frames are cropped to the area that is filled in some of them.
  if (std::exchange(picture.crops_to_filled, false)) {
    Box filled;
    for (int i = 0; i < frames; ++i) {
      if (!progress(0, frames)) return {};
      const Box box = filled_box(frame_at(i), picture.scale);
      if (box.empty()) continue;
      filled.include({box.left, box.bottom});
      filled.include({box.right, box.top});
    }
    if (!filled.empty()) picture.region = filled;
  }
  return write_frames(out, shape, frames, frame_at, progress);
}

std::optional<WrittenFilm> write_film_of_pictures(
    const Path& out, const Scene& scene, const Path& pictures, const FilmOptions& options,
    const std::function<bool(int done, int all)>& progress, const Pictures& films) {
  film_format_of(out);
  const FilmFrames range = frames_of(scene, options);
  const FilmShape shape = shape_of(out, scene, range, options, films);
  const auto frame_at = [&](int i) {
    const Path file = numbered(pictures, range.first + i);
    return RasterResult{decode_image(read_file(file), file.string()), 0};
  };
  return write_frames(out, shape, range.count, frame_at, progress);
}

}  // namespace holomorph
