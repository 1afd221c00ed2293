// The commands render and export, which write a scene as pictures, films and other formats.
#include <algorithm>
#include <cstdio>

#include "cli/commands.h"
#include "cli/meshes.h"
#include "cli/progress.h"
#include "cli/st_maps.h"
#include "cli/streams.h"
#include "core/error.h"
#include "exports/export_formats.h"
#include "film/film.h"
#include "film/ordered_tasks.h"
#include "raster/layered_picture.h"
#include "raster/textured.h"
#include "raster/unwarp.h"
#include "scene/formats/export.h"
#include "scene/formats/svg_path.h"
#include "scene/keyframes.h"
#include "scene/timed_map.h"
#include "system/new_file.h"
#include "system/text.h"

namespace holomorph {
namespace {

/// Text such as "640 x 480 pixels, lower left corner at (0, 0)".
std::string rectangle_text(int width, int height, Complex corner) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels, lower left corner at " +
         point_text(corner);
}

/// The option for rendering other frames with the same rectangle, such as " (--rect 0,0,640,480)".
std::string rectangle_option(int width, int height, Complex corner, double scale) {
  return csv_line(" (--rect %.10g,%.10g,%.10g,%.10g)", corner.real(), corner.imag(), width / scale,
                  height / scale);
}

/// Reads the pictures again with all of their bits.
void read_fine_pixels(LoadedScene& loaded) {
  std::vector<std::string> losses;
  loaded.pictures = loaded.pictures.fine(losses);
  for (const std::string& loss : losses)
    std::fprintf(stderr, "holomorph: %s\n", printable(loss).c_str());
}

/// The value of --rect with which frames show exactly what they show without it.
void print_motion_rectangle(const LoadedScene& loaded) {
  const Progress progress("render");
  PictureMaker maker(loaded.scene, loaded.image(), loaded.pictures);
  const std::optional<Box> box = maker.motion_region([] { return !is_interrupted(); });
  if (!box) return;
  constexpr double kEdge = kRectangleRounding;
  std::printf("%s\n", csv_line("%.17g,%.17g,%.17g,%.17g", box->left - kEdge, box->bottom - kEdge,
                               box->width() + 2 * kEdge, box->height() + 2 * kEdge)
                          .c_str());
}

void check_picture_out(const RenderCommand& command, const Path& out, const LoadedScene& loaded) {
  check_out(out, command.force, command.scene, loaded);
  check_out(out, command.force, command.inputs);
}

void render_frames(const RenderCommand& command, LoadedScene& loaded, PictureOptions options,
                   const PictureFormat& format, int depth) {
  const Scene& scene = loaded.scene;
  const FrameRange range = frames_named(*command.moments.frames, scene, true);
  std::vector<int> wanted;
  for (int i = range.first; i <= range.last; i += range.step)
    if (!command.missing || !path_exists(numbered(command.out, i))) wanted.push_back(i);
  if (wanted.empty()) return;
  for (const int i : wanted) check_picture_out(command, numbered(command.out, i), loaded);
  if (options.fine) read_fine_pixels(loaded);
  const DeferredStop tidy;
  std::string said, shared;
  {
    Progress progress("render", "frame");
    PictureMaker maker(scene, loaded.image(), loaded.pictures);
    if (!command.crop && !options.region)
      options.region = maker.motion_region([] { return !is_interrupted(); });
    // Fine frames are large, so only few of them wait for being written.
    OrderedTasks<Path> files([](const Path&) {}, options.fine ? 2 : 0);
    for (size_t k = 0; k < wanted.size(); ++k) {
      progress.step(k, wanted.size());
      const int i = wanted[k];
      options.time = i / scene.animation.frames_per_second;
      RasterResult frame = maker.picture(options);
      said = rectangle_text(frame.image.width, frame.image.height, frame.corner);
      shared = rectangle_option(frame.image.width, frame.image.height, frame.corner, options.scale);
      files.add([&format, depth, out = numbered(command.out, i), image = std::move(frame.image)] {
        write_file(out, format.encode(image, depth));
        return out;
      });
    }
    files.finish();
  }
  std::fprintf(stderr, "%zu frames of %s: %s to %s%s\n", wanted.size(), said.c_str(),
               numbered(command.out, wanted.front()).c_str(),
               numbered(command.out, wanted.back()).c_str(), shared.c_str());
}

void export_film(const LoadedScene& loaded, const ExportCommand& command) {
  require_keyframes(loaded.scene, command.scene);
  FilmOptions options;
  options.picture.scale = command.scale.value_or(1);
  options.picture.crop = command.crop;
  options.picture.region = command.rectangle;
  options.keeps_sound = command.sound;
  if (command.moments.frames) {
    const FrameRange range = frames_named(*command.moments.frames, loaded.scene);
    options.first = range.first;
    options.last = range.last;
  }
  const DeferredStop tidy;
  std::optional<NewFolder> folder;
  Path out = command.out;
  const bool streams = is_standard(out) || is_stream(out);
  if (streams)  // names of pipes and devices do not end in that of the format
    out = folder.emplace(std::filesystem::temp_directory_path() / "film").path() /
          ("film." + command.format);
  std::optional<WrittenFilm> film;
  {
    Progress progress("export", "frame");
    const auto step = [&](int done, int all) {
      progress.step(static_cast<size_t>(done), static_cast<size_t>(all));
      return true;
    };
    film = command.drawn
               ? write_film_of_pictures(out, loaded.scene, *command.drawn, options, step,
                                        loaded.pictures)
               : write_film(out, loaded.scene, loaded.image(), options, step, loaded.pictures);
  }
  if (streams) write_result(command.out, read_file(out));
  if (command.drawn) {
    std::fprintf(stderr, "%s: %d frames of %d x %d pixels\n", shown_output(command.out).c_str(),
                 film->frames, film->width, film->height);
    return;
  }
  std::fprintf(
      stderr, "%s: %d frames of %s%s\n", shown_output(command.out).c_str(), film->frames,
      rectangle_text(film->width, film->height, film->corner).c_str(),
      rectangle_option(film->width, film->height, film->corner, options.picture.scale).c_str());
}

void export_textured(const LoadedScene& loaded, const ExportCommand& command) {
  require_cage(loaded.scene, command.scene);
  const FlattenedSurface surface = flattened_surface_of(loaded.scene.deformation());
  for (const Path& file : files_of_textured(command.out))
    check_out(file, command.force, command.scene, loaded);
  const Progress progress("export");
  const TexturedSurface on =
      textured(surface, loaded.scene.deformation(), loaded.image(), command.scale.value_or(1));
  const DeferredStop tidy;
  write_textured(command.out, surface, on);
  std::fprintf(stderr, "%s, with a material and a texture of %d x %d pixels\n", command.out.c_str(),
               on.texture.width, on.texture.height);
}

std::string exported(const LoadedScene& loaded, const ExportCommand& command) {
  const std::string& format = command.format;
  require_cage(loaded.scene, command.scene);
  Progress progress("export", "row");
  const std::optional<double>& time = command.moments.time;
  const double scale = command.scale.value_or(1);
  const auto step = [&](int done, int all) {
    progress.step(static_cast<size_t>(done), static_cast<size_t>(all));
  };
  if (format == "unwarp")
    return encode_png(unwarped(loaded.scene, loaded.image(), scale, time, step));
  const auto& image = loaded.scene.layer().image;
  if (format == "svg" && !time) return svg_of(loaded.scene.deformation(), image);
  TimedMap timed(loaded.scene);
  const TimedFrame frame = timed.frame(time);
  if (format == "svg") return svg_of(frame.deformation, image);
  const VectorXc f = timed.on_mesh(frame).f;
  const std::span<const Complex> positions(f.data(), static_cast<size_t>(f.size()));
  if (format == "npy") return npy_of(positions);
  return obj_of(timed.mesh(), positions, image ? image->page() : Box{0, 0, 0, 0});
}

/// Such as "; 2 are drawings"; empty for formats of pixels.
std::string drawings_text(const LayeredPicture& picture, const LayeredFormat& format) {
  if (!format.keeps_drawings) return "";
  const auto is_drawing = [](const DrawnLayer& layer) { return !layer.drawing.empty(); };
  const auto count = std::ranges::count_if(picture.layers, is_drawing) +
                     std::ranges::count_if(picture.originals, is_drawing);
  return "; " + (count == 0 ? "none" : std::to_string(count)) +
         (count == 1 ? " is a drawing" : " are drawings");
}

void export_layers(const LoadedScene& loaded, const ExportCommand& command,
                   const LayeredFormat& format) {
  PictureOptions options;
  options.scale = command.scale.value_or(1);
  options.crop = command.crop;
  options.region = command.rectangle;
  options.time = command.moments.time;
  LayeredPicture picture;
  std::string bytes;
  {
    const Progress progress("export");
    picture = layered_picture_of(loaded.scene, loaded.image(), options, loaded.pictures,
                                 format.keeps_drawings);
    bytes = format.encode(picture);
  }
  write_result(command.out, bytes);
  for (const std::string& loss : picture.losses)
    std::fprintf(stderr, "holomorph: %s\n", printable(loss).c_str());
  const size_t count = picture.originals.size() + picture.layers.size();
  std::fprintf(stderr, "%s: %zu layer%s of %d x %d pixels%s\n", shown_output(command.out).c_str(),
               count, count == 1 ? "" : "s", picture.merged.width, picture.merged.height,
               drawings_text(picture, format).c_str());
}

/// Throws Error if the name of the file says that it has another format.
void check_extension(const ExportFormat& format, const Path& out) {
  if (is_standard(out) || is_stream(out)) return;
  const std::string extension = lower_case(out.extension().string());
  if (std::ranges::find(format.extensions, extension) != format.extensions.end()) return;
  std::string names;
  for (const std::string& each : format.extensions) names += (names.empty() ? "" : " or ") + each;
  throw Error(ErrorKind::bad_input,
              out.string() + ": the name must end in " + names + " for --format " + format.id);
}

/// Throws Error for options that the format does not support.
void check_options(const ExportCommand& command) {
  const ExportFormat& format = export_format_named(command.format);
  const auto throw_unsupported = [&](const std::string& option, const std::string& why) {
    throw Error(ErrorKind::bad_input,
                option + " cannot be used with " + command.format + ": " + why);
  };
  if (command.depth && format.id != "png")
    throw_unsupported("--depth", "only pictures have a choice of bits");
  if (command.scale && !format.scale) throw_unsupported("--scale", "it has no pixels");
  if (command.crop && !format.crop)
    throw_unsupported("--crop", "only pictures and films can be cropped");
  if (command.rectangle && !format.crop)
    throw_unsupported("--rect", "only pictures and films have a rectangle");
  if (command.overscan && !format.st_map)
    throw_unsupported("--overscan", "only stmap and unwarp-map extend beyond the picture");
  if (command.sound && !format.sound) throw_unsupported("--sound", "only mp4 and webm have sound");
  if (command.drawn && !format.film)
    throw_unsupported("--drawn", "only films are made of pictures");
  if (command.drawn && (command.scale || command.crop || command.rectangle))
    throw_unsupported("--scale, --crop or --rect", "the pictures of --drawn are drawn already");
  if (command.half && !format.st_map)
    throw_unsupported("--half", "only stmap and unwarp-map are written as OpenEXR");
  if (command.vertices && !(format.meshes && (format.id != "obj" || command.moments.frames)))
    throw_unsupported("--vertices", format.meshes ? "it needs --frames there"
                                                  : "it is for exports of moving meshes");
  if ((command.rate || command.keys) && !format.all_layers)
    throw_unsupported(command.keys ? "--keys" : "--rate", "it is for glb, Godot and Spine");
  if (command.moments.frames && !format.frames)
    throw_unsupported("--frames", format.time ? "it shows a single moment; use --time"
                                              : "it shows the scene's own pose");
  if (command.moments.time && !format.time)
    throw_unsupported("--time", format.frames ? "it shows many frames; use --frames"
                                              : "it shows the scene's own pose");
  check_extension(format, command.out);
}

}  // namespace

int checked_depth(const PictureFormat& format, const std::optional<int>& wanted) {
  const int depth = depth_of(format, wanted);
  if (wanted && depth != *wanted)
    throw Error(ErrorKind::bad_input,
                "--depth: " + format.extension + " has " + depths_text(format) + " bits per color");
  return depth;
}

void run(const RenderCommand& command) {
  LoadedScene loaded = read_scene(command);
  const Moments& moments = command.moments;
  if (moments.frames || command.print_rectangle) require_keyframes(loaded.scene, command.scene);
  if (command.print_rectangle) return print_motion_rectangle(loaded);
  if (!moments.frames) check_picture_out(command, command.out, loaded);
  const bool standard = is_standard(command.out);
  if (command.missing && !moments.frames)
    throw Error(ErrorKind::bad_input, "--missing is for frames; use --frames");
  if (standard && moments.frames)
    throw Error(ErrorKind::bad_input,
                "each frame is a file of its own; give a file name with --out");
  // Fails early if the format is unknown. Standard output gets a PNG.
  const PictureFormat& format = picture_format_of(standard ? Path("out.png") : command.out);
  const int depth = checked_depth(format, command.depth);
  PictureOptions options;
  options.view = view_named(command.view);
  options.fine = needs_fine_pixels(depth);
  options.scale = command.scale;
  options.crop = command.crop;
  options.region = command.rectangle;
  options.time = moments.time;
  if (moments.frames) return render_frames(command, loaded, options, format, depth);
  if (options.fine) read_fine_pixels(loaded);
  RasterResult result;
  std::string bytes;
  {
    const Progress progress("render");
    result = picture_of(loaded.scene, loaded.image(), options, loaded.pictures);
    bytes = format.encode(result.image, depth);
  }
  write_result(command.out, bytes);
  std::fprintf(stderr, "%s: %s\n", shown_output(command.out).c_str(),
               rectangle_text(result.image.width, result.image.height, result.corner).c_str());
}

void run(const ExportCommand& command) {
  check_options(command);
  const std::string& format = command.format;
  if (format == "png")
    return run(RenderCommand{{command},
                             command.out,
                             command.scale.value_or(1),
                             "image",
                             command.crop,
                             command.rectangle,
                             command.force,
                             command.moments,
                             false,
                             false,
                             command.depth});
  LoadedScene loaded = read_scene(command);
  if (command.moments.frames) require_keyframes(loaded.scene, command.scene);
  if (command.moments.time) loaded.pictures.show_time(loaded.scene, *command.moments.time);
  const ExportFormat& known = export_format_named(format);
  if (known.meshes && (known.id != "obj" || command.moments.frames))
    return export_meshes(loaded, command);
  if (known.st_map) return export_st_maps(loaded, command);
  check_out(command.out, command.force, command.scene, loaded);
  if (format == "textured") return export_textured(loaded, command);
  if (const LayeredFormat* layered = layered_format_named(format))
    return export_layers(loaded, command, *layered);
  if (known.film) return export_film(loaded, command);
  const std::string bytes = exported(loaded, command);
  write_result(command.out, bytes);
  std::fprintf(stderr, "%s: %zu bytes\n", shown_output(command.out).c_str(), bytes.size());
}

}  // namespace holomorph
