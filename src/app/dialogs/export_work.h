// Writes an export on another thread.
#pragma once

#include "app/dialogs/export_choice.h"
#include "exports/mesh_export.h"
#include "raster/picture.h"
#include "scene/loading.h"
#include "system/job.h"

namespace holomorph {

/// Settings of an export. "Export again" reuses them.
struct ExportSettings {
  enum class Region { all, picture, canvas };
  Path path;  ///< its extension determines the format
  ExportKind kind = ExportKind::picture;
  std::string meshes = {};   ///< the id of a format of meshes, of which several have one extension
  std::optional<int> depth;  ///< bits per color of a picture; none: as is usual in the format
  double scale = 1;          ///< output pixels per image pixel
  Region region = Region::all;
  std::optional<Background> background;  ///< none: the scene's
  int first = 0, last = 0;               ///< frames
  bool loops = true;
  bool keeps_sound = true;  ///< if the format can have sound, and there is any
  bool crops_to_filled = false;
  std::optional<size_t> vertices;  ///< of each layer's mesh; none: the fewest
  bool full_mesh = false;          ///< instead of `vertices`: all
  std::optional<double> rate;      ///< frames of meshes per second; none: the fewest
  int overscan = 0;                ///< of ST-maps, pixels
  bool half = false;               ///< ST-maps have half precision
  bool all_frames = false;         ///< an ST-map for each frame, instead of the shown moment
};

/// The same export, as the command `export` describes it.
MeshExport mesh_export_of(const ExportSettings& settings, const Scene& scene);

struct ExportWork {
  Scene scene;
  Pictures pictures;
  ExportSettings settings;
  PictureOptions options;
};
/// Does the work. Returns a message for the user, or "" if it was canceled. Throws Error.
std::string done_export(const ExportWork& work, Job::Progress& progress);

}  // namespace holomorph
