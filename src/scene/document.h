// An open scene with its history, pictures, file and autosave. All edits go through it.
#pragma once

#include <memory>

#include "scene/history.h"
#include "scene/loading.h"

namespace holomorph {

/// A scene being edited. A scene that was read counts as saved, a recovered one as unsaved. Commits
/// make it modified.
class Document {
 public:
  Document();  ///< an empty scene without unsaved changes
  /// Opens a scene (recognized by its name), a textured surface (.obj) or a picture (anything
  /// else). If this fails, throws Error and changes nothing.
  static Document open(const Path& path, const Reach& reach = {});
  /// A copy of a scene to start from. It counts as saved but has no file. Throws Error.
  static Document copy_of(const Path& scene);
  /// The scene that an interrupted session left in an autosave file. Throws Error.
  static Document recover(const Path& autosave);

  const Scene& scene() const { return history_.current(); }
  const Image* image() const { return pictures_.of(scene().layer()); }  ///< the edited layer's
  const Pictures& pictures() const { return pictures_; }
  const History& history() const { return history_; }
  const Path& path() const { return path_; }  ///< empty if the scene was never saved
  /// The absolute path of the edited layer's picture; empty without one.
  Path image_path() const {
    return scene().layer().image ? Path(scene().layer().image->file) : Path();
  }
  /// The picture of the lowest layer that has one. An unsaved document is named after it.
  Path first_picture() const;
  Sources sources() const;
  /// The layers whose picture could not be read, from bottom to top.
  std::vector<size_t> layers_without_picture() const;
  /// The files that the scene names but that are out of its reach. They have not been accessed.
  std::vector<Path> withheld() const;
  const std::string& warning() const { return warning_; }
  /// Whether another program has changed the file since it was read or saved. False if the file is
  /// gone.
  bool changed_on_disk();
  /// The name of its file, or of its lowest picture.
  std::string name() const;
  /// The name, with "(not saved)" if there is no file yet.
  std::string title() const;
  bool modified() const { return unsaved_ || scene() != saved_; }
  bool empty() const {
    return !scene().layer().image && !scene().deformation().has_cage() && !has_layers(scene()) &&
           history_.entries().size() == 1;
  }

  /// Stores the picture of a file that a scene is going to name, or that has changed.
  void put_picture(const ImageReference& reference, Picture picture) {
    pictures_.put(reference, std::move(picture));
  }
  /// Stores all pictures of another scene.
  void add_pictures(const Pictures& pictures) { pictures_.add(pictures); }
  /// Allows the files that are out of reach to be read.
  void allow_withheld() { pictures_.release(); }

  /// Marks the scene as saved, in the state of `read`, a document just read from the same file.
  void mark_saved(const Document& read) {
    saved_ = scene();
    unsaved_ = false;
    stamp_ = read.stamp_;
  }
  /// Marks the scene as unsaved: the file no longer holds it.
  void mark_unsaved() { unsaved_ = true; }

  /// Adds a step to the history, unless nothing has changed. `at` is the displayed time. Returns
  /// whether a step was added.
  bool commit(const std::string& label, Scene scene, std::optional<double> at = {});
  /// Replaces the scene of the current step instead of adding a step. Not for the first entry.
  void amend(Scene scene) { history_.amend(std::move(scene)); }
  bool undo() { return history_.undo(); }
  bool redo() { return history_.redo(); }
  void go_to(size_t entry) { history_.go_to(entry); }

  /// Writes the scene with picture paths relative to its file. On failure, throws Error and stays
  /// modified.
  void save(const Path& path);

  /// Brings the autosave up to date: it holds the current scene while the document is modified, and
  /// is removed when it is not. Returns false if it cannot be written.
  bool autosave(const Path& folder);
  void remove_autosave(const Path& folder);

 private:
  Document(LoadedScene loaded, Path path);

  /// The last known content of the scene's file, and the file time at which it was known.
  struct Stamp {
    std::filesystem::file_time_type time = {};
    std::string sha256;
  };

  std::string id_;  ///< names the autosave file, independent of the document's path
  History history_;
  Pictures pictures_;
  Path path_;
  Scene saved_;
  bool unsaved_ = false;  ///< even if the scene equals saved_
  std::optional<Scene> autosaved_;
  std::shared_ptr<FileLock> lock_;  ///< shows that a running program owns the autosave
  std::string warning_;
  Stamp stamp_;
};

}  // namespace holomorph
