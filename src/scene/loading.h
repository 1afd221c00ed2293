// Loads scenes, pictures and surfaces from disk, along with all files that they refer to.
#pragma once

#include "scene/layer_update.h"
#include "scene/layers.h"
#include "scene/reach.h"
#include "system/file.h"

namespace holomorph {

/// A scene and its pictures as read from disk.
struct LoadedScene {
  Scene scene;  ///< with absolute paths
  Pictures pictures;
  std::string warning;  ///< for example, that a picture has changed since the scene was saved
  ImportReport report;  ///< what opening a picture has changed
  /// How the layers of changed files were found again.
  std::vector<LayerUpdate> updates;
  std::string sha256;  ///< hash of the scene's text

  /// The warning and the first lines of the report, for people; empty if there is nothing to say.
  std::string message(size_t lines = ~size_t{0}) const;
  static constexpr size_t kFewLines = 5;  ///< of the report, for the window
  /// The picture of the edited layer; null if it has none.
  const Image* image() const { return pictures.of(scene.layer()); }
};
/// Options for reading a scene.
struct LoadOptions {
  /// If true, a picture that cannot be read causes a warning, and files out of reach are withheld.
  /// If false, both are errors. The window can ask the user for the picture; the command line
  /// cannot.
  bool pictures_may_be_missing = false;
  Reach reach = {};
  double open_pixels = 0;         ///< number of pixels in pictures that are already open
  bool keeps_origin = false;      ///< keep the origin recorded in an autosave
  LayerChoices choices = {};      ///< for layers of changed files that may be one of several
  bool looks_for_layers = false;  ///< also in files with layers that have not changed
};
/// Reads a scene file and the pictures that it names by paths relative to the file's folder. Looks
/// for missing pictures next to the scene file, and for the layers of files that have changed.
/// Throws Error, also for layers that may be one of several, unless pictures may be missing.
LoadedScene load_scene(const Path& path, const LoadOptions& options = {});
/// Reads a scene from the given text instead of the file's content.
LoadedScene scene_of_text(const std::string& text, const Path& path,
                          const LoadOptions& options = {});

/// The scene of a pasted picture, which is stored in pasted_folder(). Saving a scene places copies
/// of such pictures next to the scene file. Throws Error.
LoadedScene scene_of_pasted(const std::string& png);

/// What opening a picture changes: the report of scene_of_image(). Empty for films. Throws Error.
ImportReport import_report(const Path& image);

/// The scene of a single picture file, without a cage. Each layer of a PSD or OpenRaster
/// file becomes a layer of the scene.
LoadedScene scene_of_image(const Path& image, double open_pixels = 0);

/// The scene of a textured surface: the texture picture, with the boundary of the texture
/// coordinates as the cage. Throws Error, for example if the picture is out of reach.
LoadedScene scene_of_surface(const Path& obj, const Reach& reach = {});

/// The files that a scene consists of. `scene` is empty if the scene has no file.
struct Sources {
  Path scene;
  std::vector<Path> images, surfaces;
};
/// The files of a loaded scene that was read from `scene_path`.
Sources sources_of(const Scene& scene, const Path& scene_path);
/// The files that a scene's file names, which are not read. Throws Error.
Sources sources_in(const Path& scene);
/// Throws Error if writing to `out` would replace one of the sources.
void check_not_a_source(const Path& out, const Sources& sources);
/// Like check_not_a_source(), but also throws Error if `out` is read-only.
void check_may_write(const Path& out, const Sources& sources);

/// The scene with its paths made relative to this absolute folder, for saving there. If the folder
/// is empty, the paths remain absolute.
Scene portable(Scene scene, const Path& folder);

/// The text of a scene file. Checks the file's size before reading it. Throws Error.
std::string read_scene_file(const Path& path);

}  // namespace holomorph
