// An open scene: its history, its pictures, its file and its autosave. The only owner of edits.
#pragma once

#include <memory>

#include "scene/history.h"
#include "scene/loading.h"

namespace holomorph {

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
  const Image* image() const { return pictures_.of(scene().layer()); }  ///< the edited layer's
  const Pictures& pictures() const { return pictures_; }
  const History& history() const { return history_; }
  const Path& path() const { return path_; }  ///< empty for a scene never saved
  /// The edited layer's picture, absolute; empty without one.
  Path image_path() const {
    return scene().layer().image ? Path(scene().layer().image->file) : Path();
  }
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
    return !scene().layer().image && !scene().deformation().has_cage() && !has_layers(scene()) &&
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

}  // namespace holomorph
