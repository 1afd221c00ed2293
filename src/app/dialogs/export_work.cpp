// Each kind of export has one function.
#include "app/dialogs/export_work.h"

#include <algorithm>

#include "exports/st_map_file.h"
#include "film/film.h"
#include "raster/layered_picture.h"
#include "scene/keyframes.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

/// Thrown to end work that the user has canceled.
struct Canceled {};

std::string name_of(const ExportWork& work) {
  return work.settings.path.filename().string();
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " \u00d7 " + std::to_string(height) + " px";
}

/// Ends the work if it was canceled.
void keep_going(const Job::Progress& progress) {
  if (progress.cancelled()) throw Canceled{};
}

/// What is said at the end of the export of a picture.
std::string exported_message(const ExportWork& work, const Image& image,
                             const std::vector<std::string>& losses) {
  std::string message =
      "Exported " + name_of(work) + ", " + size_text(image.width, image.height) + ".";
  for (const std::string& loss : losses) message += " " + loss + ".";
  return message;
}

std::string exported_film(const ExportWork& work, Job::Progress& progress) {
  const ExportSettings& settings = work.settings;
  const FilmOptions film{work.options, settings.first, settings.last, settings.loops,
                         settings.keeps_sound && film_format_of(settings.path).can_have_sound &&
                             has_sound(work.scene, work.pictures)};
  const auto written = write_film(
      settings.path, work.scene, work.pictures.of(work.scene.layer()), film,
      [&](int done, int all) { return progress.at(done, all); }, work.pictures);
  if (!written) return "";
  return "Exported " + name_of(work) + ", " + std::to_string(written->frames) + " frames.";
}

std::string exported_layers(const ExportWork& work, const LayeredFormat& format,
                            Job::Progress& progress) {
  const LayeredPicture picture =
      layered_picture_of(work.scene, work.pictures.of(work.scene.layer()), work.options,
                         work.pictures, format.keeps_drawings, [&] { keep_going(progress); });
  const std::string bytes = format.encode(picture);
  keep_going(progress);
  write_file(work.settings.path, bytes);
  return exported_message(work, picture.merged, picture.losses);
}

std::string exported_picture(const ExportWork& work, Job::Progress& progress) {
  if (const LayeredFormat* layered = layered_format_of(work.settings.path))
    return exported_layers(work, *layered, progress);
  const PictureFormat& format = picture_format_of(work.settings.path);
  const int depth = depth_of(format, work.settings.depth);
  PictureOptions options = work.options;
  options.fine = needs_fine_pixels(depth);
  std::vector<std::string> losses;
  const Pictures pictures =
      options.fine ? work.pictures.fine(losses, [&] { keep_going(progress); }) : work.pictures;
  const Image image =
      picture_of(work.scene, pictures.of(work.scene.layer()), options, pictures).image;
  keep_going(progress);
  const std::string bytes = format.encode(image, depth);
  keep_going(progress);
  write_file(work.settings.path, bytes);
  return exported_message(work, image, losses);
}

std::string exported_meshes(const ExportWork& work, Job::Progress& progress) {
  const MeshExport wanted = mesh_export_of(work.settings, work.scene);
  const MovingMeshes moving =
      moving_meshes_of(work.scene, work.pictures.of(work.scene.layer()), work.pictures,
                       mesh_options_of(work.scene, wanted), [&](size_t done, size_t all) {
                         if (!progress.at(static_cast<int>(done), static_cast<int>(all)))
                           throw Canceled{};
                       });
  const MeshFiles files = mesh_files_of(moving, wanted);
  if (progress.cancelled()) return "";
  // The main file comes last, so that what it refers to is there.
  for (size_t i = files.size(); i-- > 0;) write_file(files[i].first, files[i].second);
  std::string message = "Exported " + name_of(work) + ", " + mesh_counts(moving) + ".";
  if (export_format_named(wanted.format).all_layers)
    for (const std::string& loss : mesh_losses_of(work.scene)) message += " " + loss + ".";
  return message;
}

std::string exported_st_map(const ExportWork& work, Job::Progress& progress) {
  const ExportSettings& settings = work.settings;
  const Image none, *picture = work.pictures.of(work.scene.layer());
  const StMapOptions options{settings.kind == ExportKind::unwarp_map, settings.scale,
                             settings.overscan, work.options.time};
  const FloatBits bits = settings.half ? FloatBits::half : FloatBits::single;
  if (settings.all_frames && moves(work.scene)) {
    const auto size = write_st_maps(work.scene, picture ? *picture : none, options, settings.first,
                                    settings.last, settings.path, bits,
                                    [&](int done, int all) { return progress.at(done, all); });
    if (!size) return "";
    return "Exported " + std::to_string(settings.last - settings.first + 1) + " ST-maps, " +
           size_text(size->width, size->height) + ".";
  }
  TimedMap map(work.scene);
  StMap made = st_map_of(map, picture ? *picture : none, options, [&](int done, int all) {
    if (!progress.at(done, all)) throw Canceled{};
  });
  const std::string size = size_text(made.width, made.height);
  const std::string bytes = st_map_bytes(std::move(made), settings.path, bits);
  if (progress.cancelled()) return "";
  write_file(settings.path, bytes);
  return "Exported " + name_of(work) + ", " + size + ".";
}

}  // namespace

MeshExport mesh_export_of(const ExportSettings& settings, const Scene& scene) {
  MeshExport wanted;
  wanted.format = settings.meshes;
  wanted.out = settings.path;
  wanted.vertices = settings.vertices;
  wanted.full_mesh = settings.full_mesh;
  if (!moves(scene)) return wanted;
  wanted.frames = std::pair(settings.first, settings.last);
  if (!wanted.format.empty() && export_format_named(wanted.format).all_layers)
    wanted.rate = settings.rate;
  return wanted;
}

std::string done_export(const ExportWork& work, Job::Progress& progress) {
  try {
    switch (work.settings.kind) {
      case ExportKind::picture:
        return exported_picture(work, progress);
      case ExportKind::film:
        return exported_film(work, progress);
      case ExportKind::meshes:
        return exported_meshes(work, progress);
      case ExportKind::st_map:
      case ExportKind::unwarp_map:
        return exported_st_map(work, progress);
    }
  } catch (Canceled) {
  }
  return "";
}

}  // namespace holomorph
