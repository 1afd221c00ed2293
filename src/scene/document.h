// An open scene with its history, pictures, file and autosave. All edits go through it.
#pragma once

#include <memory>

#include "scene/history.h"
#include "scene/loading.h"
#include "system/new_file.h"

namespace holomorph {

/// A scene being edited. A scene that was opened counts as saved, and a recovered scene as unsaved.
/// A commit marks the document as modified.
class Document {
 public:
  Document();  ///< an empty scene without unsaved changes
  /// Opens a scene (recognized by its name), a textured surface (.obj) or a picture (anything
  /// else). If this fails, throws Error and changes nothing.
  static Document open(const Path& path, const Reach& reach = {});
  /// A new document that starts as a copy of a scene. It has no file and no unsaved changes.
  /// Samples are opened this way, so that nobody overwrites them out of habit. Throws Error.
  static Document copy_of(const Path& scene);
  /// The scene from an autosave file that an interrupted session left behind. Throws Error.
  static Document recover(const Path& autosave);

  const Scene& scene() const { return history_.current(); }
  /// The picture of the edited layer; null if it has none.
  const Image* image() const { return pictures_.of(scene().layer()); }
  const Pictures& pictures() const { return pictures_; }
  const History& history() const { return history_; }
  const Path& path() const { return path_; }  ///< empty if the scene was never saved
  /// The absolute path of the edited layer's picture; empty if the layer has none.
  Path image_path() const {
    return scene().layer().image ? Path(scene().layer().image->file) : Path();
  }
  /// The picture of the lowest layer that has one. An unsaved document is named after it.
  Path first_picture() const;
  Sources sources() const;
  /// The layers whose picture could not be read, from bottom to top.
  std::vector<size_t> layers_without_picture() const;
  /// The files that the scene names outside its reach. They have not been accessed.
  std::vector<Path> withheld() const;
  const std::string& warning() const { return warning_; }
  /// Whether another program has changed the file since it was read or saved. False if the file no
  /// longer exists.
  bool changed_on_disk();
  /// The name of the document's file. Without a file: the name of first_picture() without its
  /// extension, or "Untitled".
  std::string name() const;
  /// The name, followed by "(not saved)" if the document has a picture but no file.
  std::string title() const;
  /// Whether there are unsaved changes. Which layer is edited does not count.
  bool modified() const {
    Scene now = scene();
    now.edited = saved_.edited;
    return unsaved_ || now != saved_;
  }
  bool empty() const {
    return !scene().layer().image && !scene().deformation().has_cage() && !has_layers(scene()) &&
           history_.entries().size() == 1;
  }

  /// The hash of the scene file's text, as it was last read or written; empty without a file.
  const std::string& file_hash() const { return stamp_.sha256; }

  /// Stores a picture before a scene refers to it, or after its file has changed.
  void put_picture(const ImageReference& reference, Picture picture) {
    pictures_.put(reference, std::move(picture));
  }
  /// Makes a frame of a layer's film the picture of this layer.
  void show_frame(const Layer& layer, int number, std::shared_ptr<const Image> frame) {
    pictures_.show_frame(layer, number, std::move(frame));
  }
  /// Updates the clips of layers to the films that are stored. This is not a step of the history.
  void describe_films();
  /// The layers of all steps of the history that show a layer of this file.
  std::vector<Layer> layers_of_file(const std::string& file) const;
  /// Finds the layers of a file again in all steps of the history. Their pictures must be stored
  /// already. This is not a step of the history.
  void update_layers(const LayerUpdate& update);
  /// Stores all pictures of another scene.
  void add_pictures(const Pictures& pictures) { pictures_.add(pictures); }
  /// Allows reading the files that are out of reach.
  void allow_withheld() { pictures_.release(); }

  /// Marks the scene as saved. `read` is a document that was just read from the same file.
  void mark_saved(const Document& read) {
    saved_ = scene();
    unsaved_ = false;
    stamp_ = read.stamp_;
  }
  /// Marks the scene as unsaved because the file no longer contains it.
  void mark_unsaved() { unsaved_ = true; }

  /// Adds a step to the history, unless the scene is unchanged. `at` is the displayed time. Returns
  /// whether a step was added.
  bool commit(const std::string& label, Scene scene, std::optional<double> at = {});
  /// Replaces the scene of the current step instead of adding a step. Do not call it on the first
  /// entry.
  void amend(Scene scene) { history_.amend(std::move(scene)); }
  /// Replaces a layer's deformation by an equivalent one in all steps that have it.
  void revise(int layer, const Deformation& from, const Deformation& to) {
    history_.revise(layer, from, to);
  }
  /// Makes another layer the edited one. This is not a step of the history.
  void select_layer(size_t number) {
    Scene selected = scene();
    selected.edited = number;
    history_.replace(std::move(selected));
  }
  bool undo() { return history_.undo(); }
  bool redo() { return history_.redo(); }
  void go_to(size_t entry) { history_.go_to(entry); }

  /// Writes the scene with picture paths relative to its file. On failure, throws Error, and the
  /// document remains modified.
  void save(const Path& path);

  /// Updates the autosave. If the document is modified, writes the current scene; otherwise removes
  /// the autosave. Returns false if the autosave cannot be written.
  bool autosave(const Path& folder);
  void remove_autosave(const Path& folder);

 private:
  Document(LoadedScene loaded, Path path);

  /// The hash of the scene file's last known content, and the file's modification time at that
  /// point.
  struct Stamp {
    std::filesystem::file_time_type time = {};
    std::string sha256;
  };

  std::string id_;  ///< the name of the autosave file; does not depend on the path
  History history_;
  Pictures pictures_;
  Path path_;
  Scene saved_;
  bool unsaved_ = false;  ///< modified even if the scene equals saved_
  std::optional<Scene> autosaved_;
  std::shared_ptr<FileLock> lock_;  ///< shows that a running program owns the autosave
  std::string warning_;
  Stamp stamp_;
};

}  // namespace holomorph
