// Sound is cut, repeated and moved by filters of ffmpeg, sample by sample.
#include "film/sound.h"

#include <algorithm>
#include <cmath>

#include "scene/clips.h"
#include "scene/layers.h"
#include "system/text.h"

namespace holomorph {
namespace {

constexpr int kRate = 48000;  ///< samples per second

std::string number(double value) {
  return decimal(value, 9);
}

/// The filter that plays sound faster or slower at the same pitch.
std::string tempo(double speed) {
  constexpr double kLeast = 0.5, kMost = 100;
  std::string filters;
  for (; speed < kLeast; speed /= kLeast) filters += "atempo=" + number(kLeast) + ",";
  for (; speed > kMost; speed /= kMost) filters += "atempo=" + number(kMost) + ",";
  if (speed != 1) filters += "atempo=" + number(speed) + ",";
  return filters;
}

std::string filters_of(const SoundTrack& track) {
  const double heard = track.length / track.speed;
  // Time stamps count from the start of the part. Sound that begins later begins with silence.
  std::string filters = "atrim=start=" + number(track.from) +
                        ":end=" + number(track.from + track.length) + ",asetpts=PTS-" +
                        number(track.from) + "/TB,aresample=" + std::to_string(kRate) +
                        ":async=1:first_pts=0," + tempo(track.speed);
  double start = track.start;
  if (track.loops) {
    const std::string samples = std::to_string(std::lround(heard * kRate));
    filters += "apad=whole_len=" + samples + ",atrim=end_sample=" + samples +
               ",aloop=loop=-1:size=" + samples + ",";
    start -= std::ceil(start / heard) * heard;
  }
  if (start < 0) return filters + "atrim=start=" + number(-start) + ",asetpts=PTS-STARTPTS";
  return filters + "adelay=delays=" + std::to_string(std::lround(start * kRate)) + "S:all=1";
}

}  // namespace

std::vector<SoundTrack> sound_of(const Scene& scene, const Pictures& pictures, double zero) {
  std::vector<SoundTrack> tracks;
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    const std::shared_ptr<Footage> footage = pictures.footage(layer);
    if (!footage || !footage->info().has_sound || !is_shown(scene, i)) continue;
    const Clip& clip = *clip_of(layer);
    const FilmInfo& film = footage->info();
    SoundTrack track;
    track.file = layer.image->file;
    track.from = film.start + first_played_frame(clip) / film.frames_per_second;
    track.length = played_frames(clip) / film.frames_per_second;
    track.speed = clip.frames_per_second / film.frames_per_second;
    track.start = clip.start - zero;
    track.loops = clip.loops;
    // A film in several layers is heard once.
    if (std::ranges::find(tracks, track) == tracks.end()) tracks.push_back(std::move(track));
  }
  return tracks;
}

bool has_sound(const Scene& scene, const Pictures& pictures) {
  return !sound_of(scene, pictures, 0).empty();
}

SoundArguments sound_arguments(const std::vector<SoundTrack>& tracks, double seconds) {
  SoundArguments arguments;
  if (tracks.empty()) return arguments;
  const auto add = [](std::vector<std::string>& to, const std::vector<std::string>& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  std::string graph, all;
  for (size_t i = 0; i < tracks.size(); ++i) {
    const std::string name = std::to_string(i + 1);  // input 0 has the frames
    add(arguments.inputs, film_reading_options());
    add(arguments.inputs, {"-copyts", "-i", "file:" + tracks[i].file.string()});
    graph += "[" + name + ":a:0]" + filters_of(tracks[i]) + "[s" + name + "];";
    all += "[s" + name + "]";
  }
  graph += all + "amix=inputs=" + std::to_string(tracks.size()) +
           ":normalize=0,apad,atrim=end=" + number(seconds) + "[sound]";
  add(arguments.filters, {"-filter_complex", graph, "-map", "0:v:0", "-map", "[sound]"});
  return arguments;
}

}  // namespace holomorph
