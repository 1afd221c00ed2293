// An open scene: its history, its pictures, its file and its autosave. The only owner of edits.
#pragma once

#include <memory>

#include "scene/history.h"
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

  const Image* image() const { return pictures.of(scene); }  ///< the edited layer's
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

/// The scene as a file in an absolute folder holds it, with paths relative to there; with absolute
/// ones when the folder is empty.
Scene portable(Scene scene, const Path& folder);

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

/// The scene of a picture alone, without a cage; of an OpenRaster file with all of its layers.
LoadedScene scene_of_image(const Path& image, double open_pixels = 0);

/// A surface that another program or this one textured: its picture, with the boundary of its
/// texture coordinates as the cage. Throws Error, also when the picture is out of reach.
LoadedScene scene_of_surface(const Path& obj, const Reach& reach = {});

/// A scene being edited. Scenes read or recovered count as saved or not; commits make it modified.
class Document {
 public:
  Document();  ///< empty, nothing to lose
  /// Opens a scene (by its name), a textured surface (.obj) or a picture (anything else).
  /// Throws Error and leaves nothing behind.
  static Document open(const Path& path, const Reach& reach = {});
  /// A scene to start from: as if drawn just now, it counts as saved but has no file. Throws Error.
  static Document copy_of(const Path& scene);
  /// What an interrupted session left in an autosave file. Throws Error.
  static Document recover(const Path& autosave);

  const Scene& scene() const { return history_.current(); }
  const Image* image() const { return pictures_.of(scene()); }  ///< the edited layer's
  const Pictures& pictures() const { return pictures_; }
  const History& history() const { return history_; }
  const Path& path() const { return path_; }  ///< empty for a scene never saved
  /// The edited layer's picture, absolute; empty without one.
  Path image_path() const { return scene().image ? Path(scene().image->file) : Path(); }
  /// The lowest layer's picture that has one: what the whole is called after.
  Path first_picture() const;
  Sources sources() const;
  /// The layers that name a picture that could not be read, from the bottom to the top.
  std::vector<size_t> without_picture() const;
  /// The files that it names and that are out of its reach: nobody has looked at them.
  std::vector<Path> withheld() const;
  const std::string& warning() const { return warning_; }
  /// Whether another program has changed the file since it was read or saved; not when it is gone.
  bool changed_on_disk();
  std::string title() const;
  bool modified() const { return unsaved_ || scene() != saved_; }
  bool empty() const {
    return !scene().image && !scene().has_cage() && !has_layers(scene()) &&
           history_.entries().size() == 1;
  }

  /// Gives a file that a scene is going to name, or that has changed, its picture.
  void put_picture(const ImageReference& reference, Picture picture) {
    pictures_.put(reference, std::move(picture));
  }
  /// The same for all of another scene's.
  void add_pictures(const Pictures& pictures) { pictures_.add(pictures); }
  /// What is out of reach may be read from now on.
  void release_pictures() { pictures_.release(); }

  /// As another document is, which was just read from the same file.
  void count_as_saved(const Document& read) {
    saved_ = scene();
    unsaved_ = false;
    stamp_ = read.stamp_;
  }
  /// The file does not hold what is here any more.
  void count_as_unsaved() { unsaved_ = true; }

  /// One step of the history; no step when nothing changed. Returns whether there was one.
  bool commit(const std::string& label, Scene scene, std::optional<double> at = {});
  /// The current step, carried further: no step of its own. Not for the first entry.
  void amend(Scene scene) { history_.amend(std::move(scene)); }
  bool undo() { return history_.undo(); }
  bool redo() { return history_.redo(); }
  void go_to(size_t entry) { history_.go_to(entry); }

  /// Writes the scene; the picture's path is made relative to it. Throws Error and stays modified.
  void save(const Path& path);

  /// Keeps the autosave true: the current scene under the document's id while it is modified,
  /// nothing when it is not. Returns false when it cannot be written.
  bool autosave(const Path& folder);
  void remove_autosave(const Path& folder);

 private:
  Document(LoadedScene loaded, Path path);

  /// What the scene's file holds as far as is known here, and when it was found to.
  struct Stamp {
    std::filesystem::file_time_type time = {};
    std::string sha256;
  };

  std::string id_;  ///< names the autosave file, whatever the document's path is
  History history_;
  Pictures pictures_;
  Path path_;
  Scene saved_;
  bool unsaved_ = false;  ///< whatever was saved
  std::optional<Scene> autosaved_;
  std::shared_ptr<FileLock> lock_;  ///< says that the autosave has a running owner
  std::string warning_;
  Stamp stamp_;
};

/// An autosave that no running program owns, and how to name it to the user.
struct Recovery {
  Path path;
  std::string label;
  Path origin = {};  ///< the scene's own file; empty for one never saved
};
/// What can be recovered, newest first.
std::vector<Recovery> recoverable(const Path& folder);
/// Deletes an autosave.
void discard(const Path& autosave);

}  // namespace holomorph
