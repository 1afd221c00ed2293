// Each command reads, asks the library, writes; nothing is computed here.
#include "cli/commands.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iostream>
#include <set>

#include "bench/bench.h"
#include "core/cauchy.h"
#include "core/error.h"
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

LoadedScene load(const Path& path) {
  if (!is_scene_name(path) && std::filesystem::is_regular_file(path) &&
      !read_file(path).starts_with("{"))
    throw Error(ErrorKind::bad_input, path.string() +
                                          ": this is no scene; make one from a picture with "
                                          "'holomorph new PICTURE --out SCENE'");
  LoadedScene loaded = load_scene(path);
  say_warning(loaded);
  return loaded;
}

/// From here on Ctrl-C and a polite kill end what writes films at the next frame, so that nothing
/// half done is left.
volatile std::sig_atomic_t interrupted = 0;
void heed_interrupts() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
}
void stop_if_interrupted() {
  if (interrupted) throw Error(ErrorKind::failed, "interrupted");
}

void check_out(const Path& out, const Path& scene, const LoadedScene& loaded) {
  check_not_a_source(out, sources_of(loaded.scene, scene));
}

void require_cage(const Scene& scene, const Path& path) {
  if (!scene.has_cage())
    throw Error(ErrorKind::bad_input, path.string() +
                                          ": /cage/rest: the scene has no cage yet; draw one in "
                                          "the editor or make one with 'holomorph new'");
}

/// The scene's map at points, in full precision; NaN outside the cage.
SampledMap map_at(const Scene& scene, const Points& points) {
  Rest rest = rest_of(scene, Precision::full);
  rest.samples = points;
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(scene.rest));
  SampledMap map;
  method_named(scene.method).prepare(rest, nullptr)->deform(pose_of(scene), map, {true});
  const Complex nowhere(NAN, NAN);
  for (size_t i = 0; i < points.size(); ++i)
    if (!contains(scene.rest, points[i])) {
      const Index at = static_cast<Index>(i);
      map.f[at] = map.fz[at] = map.fzbar[at] = nowhere;
    }
  return map;
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

void write_or_print(const std::optional<Path>& out, const std::string& text) {
  if (out)
    write_file(*out, text);
  else
    std::cout << text;
}

}  // namespace

void run(const MapCommand& command) {
  const Scene scene = load(command.scene).scene;
  require_cage(scene, command.scene);
  const Points points = points_of_csv(read_file(command.points), command.points.string());
  const SampledMap map = map_at(scene, points);
  std::string out = "u,v,fz_re,fz_im,fzbar_re,fzbar_im\n";
  for (Index i = 0; i < map.f.size(); ++i) {
    out += csv_line("%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", map.f[i].real(), map.f[i].imag(),
                    map.fz[i].real(), map.fz[i].imag(), map.fzbar[i].real(), map.fzbar[i].imag());
  }
  write_or_print(command.out, out);
}

void run(const InverseCommand& command) {
  const Scene scene = load(command.scene).scene;
  require_cage(scene, command.scene);
  const Points points = points_of_csv(read_file(command.points), command.points.string());
  const auto prepared = prepared_map(scene, Precision::full, MeshOptions{});
  SampledMap map;
  prepared->deformer->deform(pose_of(scene), map, {});
  const auto at = prepared->deformer->point_map(pose_of(scene));
  if (!at) throw Error(ErrorKind::bad_input, "method '" + scene.method + "' has no inverse");
  const InverseMap inverse(scene.rest, *prepared->mesh,
                           {map.f.data(), static_cast<size_t>(map.f.size())}, *at);
  std::string out = command.all ? "point,x,y,residual,count\n" : "x,y,residual,count\n";
  for (size_t i = 0; i < points.size(); ++i) {
    std::vector<Preimage> found = inverse.at(points[i]);
    const size_t count = found.size();
    if (found.empty()) found.push_back({Complex(NAN, NAN), NAN});
    for (const Preimage& preimage : found) {
      if (command.all) out += std::to_string(i) + ",";
      out += csv_line("%.17g,%.17g,%.3g,%zu\n", preimage.z.real(), preimage.z.imag(),
                      preimage.residual, count);
      if (!command.all) break;  // the one on top
    }
  }
  write_or_print(command.out, out);
}

void run(const CoordinatesCommand& command) {
  const Scene scene = load(command.scene).scene;
  require_cage(scene, command.scene);
  const Points points = points_of_csv(read_file(command.points), command.points.string());
  if (command.order > 12)
    throw Error(ErrorKind::bad_input, "the order of a derivative is at most 12");
  // Columns are the pose's control points: the rest cage at the pose's degrees.
  for (Index i = 0; i < scene.rest.size(); ++i)
    if (scene.rest.degree(i) > scene.pose.degree(i))
      throw Error(ErrorKind::bad_input, command.scene.string() + ": /cage/rest/" +
                                            std::to_string(i) +
                                            ": the rest segment's degree is above the posed one's");
  write_file(command.out, npy_of(cauchy_coordinates(elevated_to(scene.rest, scene.pose), points,
                                                    command.order)));
}

namespace {

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
                "--frames: '" + text + "' is no range of frames; write 0..47, or all");
  if (range.first < 0 || range.last < range.first || range.last > last)
    throw Error(ErrorKind::bad_input,
                "--frames: the scene has frames 0.." + std::to_string(last) + " at " +
                    csv_line("%g", scene.animation.frames_per_second) + " frames a second");
  return range;
}

void render_frames(const RenderCommand& command, const LoadedScene& loaded,
                   PictureOptions options) {
  const Scene& scene = loaded.scene;
  const FrameRange range = frames_named(command.frames, scene);
  const double rate = scene.animation.frames_per_second;
  PictureMaker maker(scene, loaded.image(), loaded.pictures);
  if (!command.crop) {
    std::vector<double> times;
    for (int i = 0; i <= last_frame_of(scene); ++i) times.push_back(i / rate);
    options.shows = maker.shown_at(times);
  }
  for (int i = range.first; i <= range.last; ++i)
    check_out(numbered(command.out, i), command.scene, loaded);
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

/// Throws Error unless a scene has keyframes, for what is about their times.
void require_keyframes(const Scene& scene, const Path& path) {
  if (!has_keyframes(scene))
    throw Error(ErrorKind::bad_input,
                path.string() + ": the scene has no keyframes, so there are no times in it");
}

}  // namespace

void run(const RenderCommand& command) {
  const LoadedScene loaded = load(command.scene);
  if (command.time || !command.frames.empty()) require_keyframes(loaded.scene, command.scene);
  if (command.frames.empty()) check_out(command.out, command.scene, loaded);
  picture_format_of(command.out);  // said at once if there is none
  PictureOptions options;
  options.view = view_named(command.view);
  options.scale = command.scale;
  options.crop = command.crop;
  options.time = command.time;
  if (!command.frames.empty()) return render_frames(command, loaded, options);
  const RasterResult result = picture_of(loaded.scene, loaded.image(), options, loaded.pictures);
  write_file(command.out, picture_format_of(command.out).encode(result.image));
  std::fprintf(stderr, "%s: %d x %d pixels, lower left corner at %s\n", command.out.c_str(),
               result.image.width, result.image.height, point_text(result.corner).c_str());
}

void run(const InfoCommand& command) {
  const Scene scene = load(command.scene).scene;
  require_cage(scene, command.scene);
  const SceneReport report = report_of(scene);
  std::cout << (command.json ? json_of(report) : text_of(report));
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
  write_file(command.out, text);
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
  if (format == "unwarp") return encode_png(unwarped(loaded.scene, loaded.image(), command.scale));
  if (format == "stmap") {
    const Image none, &picture = loaded.image() ? *loaded.image() : none;
    const StMap map = st_map_of(loaded.scene, picture.width, picture.height, command.scale);
    return npy_of(map.st, static_cast<size_t>(map.height), static_cast<size_t>(map.width), 2);
  }
  if (format == "svg") return svg_of(loaded.scene);
  const auto prepared = prepared_map(loaded.scene, Precision::full, MeshOptions{});
  SampledMap map;
  prepared->deformer->deform(pose_of(loaded.scene), map, {});
  const std::span<const Complex> positions(map.f.data(), static_cast<size_t>(map.f.size()));
  if (format == "npy") return npy_of(positions);
  const auto& image = loaded.scene.image;
  return obj_of(*prepared->mesh, positions, image ? image->width : 0, image ? image->height : 0);
}

void export_textured(const LoadedScene& loaded, const ExportCommand& command) {
  require_cage(loaded.scene, command.scene);
  const LaidSurface surface = laid_surface_of(loaded.scene);
  for (const Path& file : files_of_textured(command.out)) check_out(file, command.scene, loaded);
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
  if (command.format == "png") return run(RenderCommand{command.scene, command.out, command.scale});
  const LoadedScene loaded = load(command.scene);
  check_out(command.out, command.scene, loaded);
  if (command.format == "textured") return export_textured(loaded, command);
  if (is_film(command.format)) return export_film(loaded, command);
  const std::string bytes = exported(loaded, command);
  write_file(command.out, bytes);
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
  if (command.json) std::cout << bench::json_of(results);
}

}  // namespace holomorph
