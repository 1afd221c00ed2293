// Each command reads, asks the library, writes; nothing is computed here.
#include "cli/commands.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iostream>
#include <set>

#include "bench/bench.h"
#include "core/cauchy.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/flatten.h"
#include "core/inverse.h"
#include "film/film.h"
#include "film/ordered_tasks.h"
#include "raster/textured.h"
#include "raster/unwarp.h"
#include "scene/auto_cage.h"
#include "scene/document.h"
#include "scene/export.h"
#include "scene/keyframes.h"
#include "scene/outline_import.h"
#include "scene/report.h"
#include "scene/scene_json.h"
#include "scene/svg_path.h"

namespace holomorph {
namespace {

void say_warning(const LoadedScene& loaded) {
  if (!loaded.warning.empty()) std::cerr << "holomorph: " << loaded.warning << "\n";
}

bool is_standard(const Path& path) {
  return path == "-";
}

LoadedScene load(const Path& path) {
  if (!is_standard(path) && !is_scene_name(path) && std::filesystem::is_regular_file(path) &&
      !read_file(path).starts_with("{"))
    throw Error(ErrorKind::bad_input, path.string() +
                                          ": this is not a scene; make one from a picture with "
                                          "'holomorph new PICTURE --out SCENE'");
  LoadedScene loaded =
      is_standard(path) ? scene_of_text(read_standard_input(), "standard input") : load_scene(path);
  say_warning(loaded);
  return loaded;
}

void require_cage(const Scene& scene, const Path& path) {
  if (!scene.has_cage())
    throw Error(ErrorKind::bad_input, path.string() +
                                          ": /cage/rest: the scene has no cage yet; draw one in "
                                          "the editor or make one with 'holomorph new'");
}

/// A scene and the points that a command is about.
struct SceneAndPoints {
  Scene scene;
  Points points;
};
SceneAndPoints scene_and_points(const Path& scene, const Path& points) {
  if (is_standard(points) && is_standard(scene))
    throw Error(ErrorKind::bad_input,
                "standard input is the scene or the points, not both: name a file for one of them");
  SceneAndPoints read{load(scene).scene, {}};
  require_cage(read.scene, scene);
  read.points = is_standard(points) ? points_of_csv(read_standard_input(), "standard input")
                                    : points_of_csv(read_file(points), points.string());
  return read;
}

/// Throws Error for read-only files, unless they are to be replaced.
void check_writable(const Path& out, bool force) {
  if (!force && !is_standard(out) && is_read_only(out))
    throw Error(ErrorKind::failed, out.string() + ": the file is read-only; --force replaces it");
}

void write_result(const Path& out, const std::string& bytes) {
  if (is_standard(out))
    write_standard_output(bytes);
  else
    write_file(out, bytes);
}

/// From here on Ctrl-C and a polite kill end what writes films at the next frame, so that nothing
/// half done is left.
volatile std::sig_atomic_t interrupted = 0;
void heed_interrupts() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
}
void stop_if_interrupted() {
  if (interrupted) throw Interrupted{};
}

void check_out(const Path& out, bool force, const Path& scene, const LoadedScene& loaded) {
  check_not_a_source(out, sources_of(loaded.scene, scene));
  check_writable(out, force);
}

/// printf of numbers, NaN without the sign that some have and no reader expects.
template <class... Numbers>
std::string csv_line(const char* format, Numbers... numbers) {
  char line[200];
  std::snprintf(line, sizeof line, format, numbers...);
  std::string out;
  for (std::string_view rest = line; !rest.empty(); rest.remove_prefix(1)) {
    if (rest.starts_with("-nan")) rest.remove_prefix(1);
    out += rest[0];
  }
  return out;
}

struct FrameRange {
  int first = 0, last = 0;
};

/// "3..17" or "all" of a scene's frames.
FrameRange frames_named(const std::string& text, const Scene& scene) {
  const int last = last_frame_of(scene);
  if (text == "all") return {0, last};
  FrameRange range;
  int end = 0;
  if (std::sscanf(text.c_str(), "%d..%d%n", &range.first, &range.last, &end) != 2 ||
      end != static_cast<int>(text.size()))
    throw Error(ErrorKind::bad_input,
                "--frames: '" + text + "' is not a range of frames; write 0..47, or all");
  if (range.last < range.first)
    throw Error(ErrorKind::bad_input,
                "--frames: " + text + " runs backwards; write the lower frame first");
  if (range.first < 0 || range.last > last)
    throw Error(ErrorKind::bad_input,
                "--frames: the scene has frames 0.." + std::to_string(last) + " at " +
                    csv_line("%g", scene.animation.frames_per_second) + " frames a second");
  return range;
}

/// Throws Error unless a scene has keyframes, for what is about their times.
void require_keyframes(const Scene& scene, const Path& path) {
  if (!has_keyframes(scene))
    throw Error(ErrorKind::bad_input,
                path.string() + ": the scene has no keyframes, so there are no times in it");
}

/// A frame and its time, or the scene as it stands.
struct Moment {
  std::optional<int> frame = {};
  std::optional<double> time = {};
};
std::vector<Moment> moments_named(const Moments& wanted, const Scene& scene, const Path& path) {
  if (wanted.frames.empty() && !wanted.time) return {{}};
  require_keyframes(scene, path);
  if (wanted.frames.empty()) return {{{}, wanted.time}};
  std::vector<Moment> moments;
  const FrameRange range = frames_named(wanted.frames, scene);
  for (int i = range.first; i <= range.last; ++i)
    moments.push_back({i, i / scene.animation.frames_per_second});
  return moments;
}

/// On a terminal, how far a command has come.
class Progress {
 public:
  Progress(const char* what, size_t all) : what_(what), all_(all) {}
  ~Progress() {
    if (shown_) std::fprintf(stderr, "\r\033[K");
  }
  void step(size_t done) {
    stop_if_interrupted();
    if (!::isatty(STDERR_FILENO) || now_ms() - start_ < 1000) return;
    shown_ = true;
    std::fprintf(stderr, "\r%s %zu of %zu", what_, done, all_);
  }

 private:
  const char* what_;
  size_t all_;
  double start_ = now_ms();
  bool shown_ = false;
};

/// The start of a CSV row: the frame, if there are several.
std::string frame_column(const Moment& moment) {
  return moment.frame ? std::to_string(*moment.frame) + "," : "";
}

}  // namespace

void check_is_file(const Path& path) {
  if (std::filesystem::exists(path)) return;
  const bool command = path.string().find_first_of("./") == std::string::npos;
  throw Error(ErrorKind::bad_input,
              path.string() + (command ? ": there is neither a command nor a file of this name; "
                                         "'holomorph --help' lists the commands"
                                       : ": there is no such file"));
}

void run(const MapCommand& command) {
  check_writable(command.out, command.force);
  const auto [scene, points] = scene_and_points(command.scene, command.points);
  const std::vector<Moment> moments = moments_named(command.moments, scene, command.scene);
  std::vector<char> inside;
  for (const Complex& z : points) inside.push_back(contains(scene.rest, z));
  std::string out =
      std::string(moments[0].frame ? "frame," : "") + "u,v,fz_re,fz_im,fzbar_re,fzbar_im\n";
  TimedMap timed(scene);
  heed_interrupts();
  Progress progress("frame", moments.size());
  for (size_t k = 0; k < moments.size(); ++k) {
    progress.step(k);
    SampledMap map = timed.at(timed.frame(moments[k].time), points);
    size_t lost = 0;
    for (Index i = 0; i < map.f.size(); ++i) {
      if (!inside[static_cast<size_t>(i)])
        map.f[i] = map.fz[i] = map.fzbar[i] = Complex(NAN, NAN);
      else
        lost += !is_finite(map.f[i]);
      out += frame_column(moments[k]) +
             csv_line("%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", map.f[i].real(), map.f[i].imag(),
                      map.fz[i].real(), map.fz[i].imag(), map.fzbar[i].real(), map.fzbar[i].imag());
    }
    if (lost > 0)
      std::cerr << "holomorph: the map is not finite at " << lost << " points inside the cage\n";
  }
  write_result(command.out, out);
}

void run(const InverseCommand& command) {
  check_writable(command.out, command.force);
  const auto [scene, points] = scene_and_points(command.scene, command.points);
  const std::vector<Moment> moments = moments_named(command.moments, scene, command.scene);
  std::string out = std::string(moments[0].frame ? "frame," : "") +
                    (command.all ? "point,x,y,residual,count\n" : "x,y,residual,count\n");
  TimedMap timed(scene);
  heed_interrupts();
  Progress progress("point", moments.size() * points.size());
  for (size_t k = 0; k < moments.size(); ++k) {
    const TimedMap::Frame frame = timed.frame(moments[k].time);
    const auto at = timed.point_map(frame);
    if (!at) throw Error(ErrorKind::bad_input, "method '" + scene.method + "' has no inverse");
    const VectorXc& f = frame.map.f;
    const InverseMap inverse(scene.rest, timed.mesh(), {f.data(), static_cast<size_t>(f.size())},
                             *at);
    for (size_t i = 0; i < points.size(); ++i) {
      if (i % 64 == 0) progress.step(k * points.size() + i);
      std::vector<Preimage> found = inverse.at(points[i]);
      const size_t count = found.size();
      if (found.empty()) found.push_back({Complex(NAN, NAN), NAN});
      for (const Preimage& preimage : found) {
        out += frame_column(moments[k]);
        if (command.all) out += std::to_string(i) + ",";
        out += csv_line("%.17g,%.17g,%.3g,%zu\n", preimage.z.real(), preimage.z.imag(),
                        preimage.residual, count);
        if (!command.all) break;  // the one on top
      }
    }
  }
  write_result(command.out, out);
}

void run(const CoordinatesCommand& command) {
  check_writable(command.out, command.force);
  const auto [scene, points] = scene_and_points(command.scene, command.points);
  if (command.order > 12)
    throw Error(ErrorKind::bad_input, "the order of a derivative is at most 12");
  // Columns are the pose's control points: the rest cage at the pose's degrees.
  for (Index i = 0; i < scene.rest.size(); ++i)
    if (scene.rest.degree(i) > scene.pose.degree(i))
      throw Error(ErrorKind::bad_input, command.scene.string() + ": /cage/rest/" +
                                            std::to_string(i) +
                                            ": the rest segment's degree is above the posed one's");
  write_result(command.out, npy_of(cauchy_coordinates(elevated_to(scene.rest, scene.pose), points,
                                                      command.order)));
}

namespace {

void render_frames(const RenderCommand& command, const LoadedScene& loaded,
                   PictureOptions options) {
  const Scene& scene = loaded.scene;
  const FrameRange range = frames_named(command.moments.frames, scene);
  const double rate = scene.animation.frames_per_second;
  PictureMaker maker(scene, loaded.image(), loaded.pictures);
  if (!command.crop) {
    std::vector<double> times;
    for (int i = 0; i <= last_frame_of(scene); ++i) times.push_back(i / rate);
    options.shows = maker.shown_at(times);
  }
  for (int i = range.first; i <= range.last; ++i)
    check_out(numbered(command.out, i), command.force, command.scene, loaded);
  heed_interrupts();
  OrderedTasks<Path> files([](const Path&) {});
  for (int i = range.first; i <= range.last; ++i) {
    stop_if_interrupted();
    options.time = i / rate;
    files.add([out = numbered(command.out, i), image = maker.picture(options).image] {
      write_file(out, picture_format_of(out).encode(image));
      return out;
    });
    if (::isatty(STDERR_FILENO))
      std::fprintf(stderr, "\rframe %d of %d..%d", i, range.first, range.last);
  }
  files.finish();
  std::fprintf(stderr, "%s%d frames, %s to %s\n", ::isatty(STDERR_FILENO) ? "\r" : "",
               range.last - range.first + 1, numbered(command.out, range.first).c_str(),
               numbered(command.out, range.last).c_str());
}

}  // namespace

void run(const RenderCommand& command) {
  const LoadedScene loaded = load(command.scene);
  const Moments& moments = command.moments;
  if (moments.time || !moments.frames.empty()) require_keyframes(loaded.scene, command.scene);
  if (moments.frames.empty()) check_out(command.out, command.force, command.scene, loaded);
  const bool standard = is_standard(command.out);
  if (standard && !moments.frames.empty())
    throw Error(ErrorKind::bad_input, "frames are files of their own: --out must name them");
  // Said immediately if there is no such format; standard output gets a PNG.
  const PictureFormat& format = picture_format_of(standard ? Path("out.png") : command.out);
  PictureOptions options;
  options.view = view_named(command.view);
  options.scale = command.scale;
  options.crop = command.crop;
  options.time = moments.time;
  if (!moments.frames.empty()) return render_frames(command, loaded, options);
  const RasterResult result = picture_of(loaded.scene, loaded.image(), options, loaded.pictures);
  write_result(command.out, format.encode(result.image));
  std::fprintf(stderr, "%s: %d x %d pixels, lower left corner at %s\n", command.out.c_str(),
               result.image.width, result.image.height, point_text(result.corner).c_str());
}

void run(const InfoCommand& command) {
  const Scene scene = load(command.scene).scene;
  require_cage(scene, command.scene);
  const std::vector<Moment> moments = moments_named(command.moments, scene, command.scene);
  TimedMap timed(scene);
  heed_interrupts();
  Progress progress("frame", moments.size());
  std::vector<SceneReport> reports;
  for (size_t k = 0; k < moments.size(); ++k) {
    progress.step(k);
    reports.push_back(report_of(timed, timed.frame(moments[k].time)));
    reports.back().frame = moments[k].frame;
    reports.back().time = moments[k].time.value_or(0);
  }
  if (command.json) return write_standard_output(json_of(reports));
  for (const SceneReport& report : reports) write_standard_output(text_of(report));
}

namespace {

/// A path of an SVG file, or the boundary of a surface's texture coordinates.
Cage cage_of_file(const Path& path, const Image& picture) {
  const std::string text = read_file(path);
  if (lower_case(path.extension().string()) != ".obj")
    return cage_of_svg(text, path.string(), picture.height, PathUse::rest);
  try {
    return polygon_cage(
        texture_boundary(surface_of_obj(text, path.string()), picture.width, picture.height));
  } catch (const Error& error) {
    throw about(path, error);
  }
}

}  // namespace

void run(const NewCommand& command) {
  if (!command.force && !is_standard(command.out) && std::filesystem::is_regular_file(command.out))
    throw Error(ErrorKind::failed,
                command.out.string() + ": there is such a file; --force replaces it");
  const LoadedScene loaded = scene_of_image(command.image);
  say_warning(loaded);
  const Image& picture = *loaded.image();
  const double height = picture.height;
  Scene scene = with_cage(
      loaded.scene, command.cage
                        ? cage_of_file(*command.cage, picture)
                        : auto_cage(picture, {command.vertices, command.margin, command.curved}));
  check_rest_cage(scene.rest);
  if (command.pose)
    scene.pose =
        cage_of_svg(read_file(*command.pose), command.pose->string(), height, PathUse::pose);
  if (scene.pose.size() != scene.rest.size())
    throw Error(ErrorKind::bad_input, command.pose->string() + ": the posed cage has " +
                                          std::to_string(scene.pose.size()) +
                                          " segments and the cage " +
                                          std::to_string(scene.rest.size()) + "; they must agree");
  if (command.outline) {
    const Flattening flattening = flattening_named(command.flattening);
    scene.outline =
        outline_of_file(*command.outline, height, box_of(outline_of(scene.rest)), flattening);
    scene.surface = surface_of_file(*command.outline, flattening);
    scene.method = "outline";
  }
  const auto absolute = [](const Path& path) {
    return std::filesystem::absolute(path).lexically_normal();
  };
  const std::string text = json_of(portable(scene, absolute(command.out).parent_path()));
  scene_from_json(text, command.out.string());  // what could not be read again is not written
  write_result(command.out, text);
  std::fprintf(stderr, "%s: a cage with %zu vertices\n", command.out.c_str(),
               static_cast<size_t>(scene.rest.size()));
}

namespace {

std::string exported(const LoadedScene& loaded, const ExportCommand& command) {
  const std::string& format = command.format;
  const std::set<std::string> known{"svg", "obj", "npy", "stmap", "unwarp"};
  if (!known.contains(format))
    throw Error(ErrorKind::bad_input, "format '" + format +
                                          "' is not available in this version; choose one of: obj, "
                                          "svg, npy, png, stmap, unwarp, textured, webp, gif, "
                                          "apng, mp4, webm");
  require_cage(loaded.scene, command.scene);
  const std::optional<double>& time = command.moments.time;
  if (format == "unwarp")
    return encode_png(unwarped(loaded.scene, loaded.image(), command.scale, time));
  if (format == "stmap") {
    const Image none, &picture = loaded.image() ? *loaded.image() : none;
    const StMap map = st_map_of(loaded.scene, picture.width, picture.height, command.scale, time);
    return npy_of(map.st, static_cast<size_t>(map.height), static_cast<size_t>(map.width), 2);
  }
  if (format == "svg" && !time) return svg_of(loaded.scene);
  TimedMap timed(loaded.scene);
  const TimedMap::Frame frame = timed.frame(time);
  if (format == "svg") return svg_of(frame.scene);
  const VectorXc& f = frame.map.f;
  const std::span<const Complex> positions(f.data(), static_cast<size_t>(f.size()));
  if (format == "npy") return npy_of(positions);
  const auto& image = loaded.scene.image;
  return obj_of(timed.mesh(), positions, image ? image->width : 0, image ? image->height : 0);
}

void export_textured(const LoadedScene& loaded, const ExportCommand& command) {
  require_cage(loaded.scene, command.scene);
  const LaidSurface surface = laid_surface_of(loaded.scene);
  for (const Path& file : files_of_textured(command.out))
    check_out(file, command.force, command.scene, loaded);
  const TexturedSurface on = textured(surface, loaded.scene, loaded.image(), command.scale);
  write_textured(command.out, surface, on);
  std::fprintf(stderr, "%s, with material and a picture of %d x %d pixels\n", command.out.c_str(),
               on.texture.width, on.texture.height);
}

}  // namespace

namespace {

bool is_film(const std::string& format) {
  return format != "png" && std::ranges::any_of(film_formats(), [&](const FilmFormat& known) {
           return known.extension == "." + format;
         });
}

void export_film(const LoadedScene& loaded, const ExportCommand& command) {
  require_keyframes(loaded.scene, command.scene);
  if (lower_case(command.out.extension().string()) != "." + command.format)
    throw Error(ErrorKind::bad_input,
                command.out.string() + ": the name must end in ." + command.format);
  const bool shows_progress = ::isatty(STDERR_FILENO);
  int frames = 0;
  heed_interrupts();
  FilmOptions options;
  options.picture.scale = command.scale;
  options.picture.crop = command.crop;
  if (!command.moments.frames.empty()) {
    const FrameRange range = frames_named(command.moments.frames, loaded.scene);
    options.first = range.first;
    options.last = range.last;
  }
  write_film(
      command.out, loaded.scene, loaded.image(), options,
      [&](int done, int all) {
        if (shows_progress) std::fprintf(stderr, "\rframe %d of %d ", done, all);
        frames = all;
        return !interrupted;
      },
      loaded.pictures);
  stop_if_interrupted();
  std::fprintf(stderr, "%s%s: %d frames\n", shows_progress ? "\r" : "", command.out.c_str(),
               frames);
}

}  // namespace

void run(const ExportCommand& command) {
  const std::string& format = command.format;
  const Moments& moments = command.moments;
  if (format == "png")
    return run(RenderCommand{command.scene, command.out, command.scale, "image", command.crop,
                             command.force, moments});
  if (!moments.frames.empty() && !is_film(format))
    throw Error(ErrorKind::bad_input,
                "--frames is for png and films; " + format + " is of one --time");
  if (moments.time && (is_film(format) || format == "textured"))
    throw Error(ErrorKind::bad_input, "--time is not for " + format);
  const LoadedScene loaded = load(command.scene);
  if (moments.time) require_keyframes(loaded.scene, command.scene);
  check_out(command.out, command.force, command.scene, loaded);
  if (format == "textured") return export_textured(loaded, command);
  if (is_film(format)) return export_film(loaded, command);
  const std::string bytes = exported(loaded, command);
  write_result(command.out, bytes);
  std::fprintf(stderr, "%s: %zu bytes\n", command.out.c_str(), bytes.size());
}

void run(const BenchCommand& command) {
  // Where the table itself is not read as it grows, each line is shown on the way.
  const bool shows_progress = ::isatty(STDERR_FILENO) && !::isatty(STDOUT_FILENO);
  const std::vector<bench::Result> results =
      bench::measured(command.filter, [&](const bench::Result& result) {
        const std::string line = bench::line_of(result) + "\n";
        if (!command.json) std::cout << line << std::flush;
        if (shows_progress) std::cerr << line;
      });
  if (results.empty())
    throw Error(ErrorKind::bad_input, "--filter: no benchmark's name contains '" + command.filter +
                                          "'; 'holomorph bench' alone lists all of them");
  if (command.json) std::cout << bench::json_of(results);
}

}  // namespace holomorph
