// Scenes, pictures and surfaces as read from disk, with all the files that they name.
#pragma once

#include "scene/layers.h"
#include "scene/pictures.h"
#include "scene/reach.h"
#include "system/file.h"

namespace holomorph {

/// A scene and its pictures as read from disk.
struct LoadedScene {
  Scene scene;  ///< with absolute paths
  Pictures pictures;
  std::string warning;  ///< for example, that a picture has changed since the scene was saved
  std::string sha256;   ///< of the scene's text

  const Image* image() const { return pictures.of(scene.layer()); }  ///< the edited layer's
};
/// How a scene is read.
struct LoadOptions {
  /// Whether a picture that cannot be read is only a warning and one out of reach is withheld.
  /// Otherwise both are errors.
  bool pictures_may_be_missing = false;
  Reach reach = {};
  double open_pixels = 0;     ///< of pictures that are already open
  bool keeps_origin = false;  ///< keep what an autosave says about its origin
};
/// Reads a scene file and the pictures that it names, relative to the file's folder. A missing
/// picture is looked for next to the scene. Throws Error.
LoadedScene load_scene(const Path& path, const LoadOptions& options = {});
/// The same for a text that stands in for the file's content.
LoadedScene scene_of_text(const std::string& text, const Path& path,
                          const LoadOptions& options = {});
/// Whether a file name is that of a scene: .json, or .holomorph, which desktops recognize.
bool is_scene_name(const Path& path);

/// The scene of a picture that has no file of its own and is kept in pasted_folder(). Saving a
/// scene puts copies of such pictures next to it. Throws Error.
LoadedScene scene_of_pasted(const std::string& png);

/// The scene of a single picture, without a cage. For an OpenRaster file it has all of the file's
/// layers.
LoadedScene scene_of_image(const Path& image, double open_pixels = 0);

/// The scene of a textured surface: its picture, with the boundary of its texture coordinates as
/// the cage. Throws Error, also if the picture is out of reach.
LoadedScene scene_of_surface(const Path& obj, const Reach& reach = {});

/// The files that a scene consists of; empty where it has none.
struct Sources {
  Path scene;
  std::vector<Path> images, surfaces;
};
/// The sources of a loaded scene that was read from this file.
Sources sources_of(const Scene& scene, const Path& scene_path);
/// Throws Error if writing to `out` would replace one of them.
void check_not_a_source(const Path& out, const Sources& sources);
/// The same, and throws Error if `out` is read-only.
void check_may_write(const Path& out, const Sources& sources);

/// The scene as a file in this absolute folder holds it, with paths relative to the folder; with
/// absolute paths if the folder is empty.
Scene portable(Scene scene, const Path& folder);

/// The text of a scene file. Its size is checked before it is read. Throws Error.
std::string read_scene_file(const Path& path);

}  // namespace holomorph
