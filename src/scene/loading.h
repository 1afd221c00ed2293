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
  std::string warning;  ///< such as: the picture is not the one that the scene was made with
  std::string sha256;   ///< of the scene's text

  const Image* image() const { return pictures.of(scene.layer()); }  ///< the edited layer's
};
/// How a scene is read.
struct LoadOptions {
  /// A picture that cannot be read is a warning, and one out of reach is withheld; else an error.
  bool pictures_may_be_missing = false;
  Reach reach = {};
  double open_pixels = 0;  ///< of pictures that are there already
  bool recovers = false;   ///< what an autosave says of its origin is kept
};
/// Reads a scene file and the pictures that it names, relative to the file's folder; one that is
/// not where it was is looked for beside the scene. Throws Error.
LoadedScene load_scene(const Path& path, const LoadOptions& options = {});
/// The same from a text that stands for the file.
LoadedScene scene_of_text(const std::string& text, const Path& path,
                          const LoadOptions& options = {});
/// Whether a name is a scene's: .json, or .holomorph, which desktops know.
bool is_scene_name(const Path& path);

/// The scene of a picture that comes from no file: it is kept in pasted_folder(). Saving a scene
/// puts copies of such pictures beside it. Throws Error.
LoadedScene scene_of_pasted(const std::string& png);

/// The scene of a picture alone, without a cage; of an OpenRaster file with all of its layers.
LoadedScene scene_of_image(const Path& image, double open_pixels = 0);

/// A surface that another program or this one textured: its picture, with the boundary of its
/// texture coordinates as the cage. Throws Error, also when the picture is out of reach.
LoadedScene scene_of_surface(const Path& obj, const Reach& reach = {});

/// The files that a scene is made of; empty for what it has not.
struct Sources {
  Path scene;
  std::vector<Path> images, surfaces;
};
/// Of a loaded scene that was read from this file.
Sources sources_of(const Scene& scene, const Path& scene_path);
/// Throws Error when writing to `out` would replace one of them.
void check_not_a_source(const Path& out, const Sources& sources);
/// The same, and for read-only files.
void check_may_write(const Path& out, const Sources& sources);

/// The scene as a file in an absolute folder holds it, with paths relative to there; with absolute
/// ones when the folder is empty.
Scene portable(Scene scene, const Path& folder);

/// The text of a scene file, whose size is checked before it is read. Throws Error.
std::string read_scene_file(const Path& path);

}  // namespace holomorph
