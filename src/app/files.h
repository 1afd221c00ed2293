// The document and its files: opening, saving, exporting, autosave and recovery, and the questions
// that they ask the user.
#pragma once

#include "app/dialogs/export_dialog.h"
#include "app/dialogs/question.h"
#include "app/imports.h"
#include "app/picture_watch.h"
#include "scene/preferences.h"
#include "scene/recovery.h"

namespace holomorph {

/// Owns the dialogs and questions about files, and keeps the list of recent files. Asks before
/// unsaved work is lost.
class Files {
 public:
  /// `replaced` is called whenever the workspace gets another document; `wake` is called on
  /// other threads when their work has ended. With `allow_outside`, scenes show pictures from any
  /// folder.
  Files(Workspace& workspace, Preferences& preferences, std::function<void()> replaced,
        const std::function<void()>& wake, bool allow_outside);

  /// Opens a scene or a picture: open() immediately, ask_open() after the user has decided about
  /// unsaved work. Returns what is wrong, or "".
  std::string open(const Path& path);
  void ask_open(const Path& path);
  /// Takes a dropped file. With a cage, surfaces and SVG paths become its outline. With a picture
  /// but no cage, an SVG path becomes the cage and a surface is refused. Any other file is opened;
  /// if a document is open, asks whether to add, replace or open.
  void drop(const Path& path);
  /// Opens a copy of a scene, which has no file yet. Asks about unsaved work first.
  void ask_sample(const Path& scene);
  /// Does what an action requests, if that is about files.
  void answer(Request request);
  /// Recovers or deletes the autosave of an earlier session.
  void ask_recover(const Path& autosave);
  void discard(const Path& autosave);
  const std::vector<Recovery>& recoverable() const { return recoverable_; }

  /// Reads pictures and the scene again if another program has changed them. To be called
  /// regularly.
  void watch();
  /// Keeps the autosave up to date. To be called once per frame.
  void autosave();
  void keep_preferences();
  /// Draws the dialog or question that is open.
  void draw(double scale);
  bool asking() const {
    return dialog_.open() || export_.open() || questions_.open() || jobs_.running();
  }
  /// The title of the question that is open, or "".
  std::string question() const { return questions_.title(); }
  /// Whether frames have to be drawn even without events, because a job is running.
  bool busy() const { return jobs_.running(); }
  Jobs& jobs() { return jobs_; }
  FileChooser& chooser() { return dialog_; }
  bool has_quit() const { return quit_; }
  /// Whether the document is saved in its present state, or was exported.
  bool has_kept() const {
    const Document& document = workspace_.document;
    return export_.has_exported() || (!document.path().empty() && !document.modified());
  }

 private:
  using Then = std::function<void()>;
  Reach reach() const { return {allow_outside_, preferences_.trusted}; }
  void trust_folder_of(const Path& path);
  void ask_about_changes_then(Then then);
  void keep_recent(const Path& path);
  void adopt(Document document);
  void recover(const Path& autosave);
  void ask_about_unsaved(const std::vector<Recovery>& left);
  void ask_about_withheld();
  void show_withheld();
  void reload();
  void watch_scene();
  void ask_about_change(const Path& path, const Then& then);
  enum class Conflict { ask, overwrite };
  std::string save_to(const Path& path, const Then& then, Conflict conflict = Conflict::ask);
  void save(bool as, const Then& then = {});
  /// A file name in the document's folder or, if it has none, in the folder of the last dialog.
  Path in_document_folder(const std::string& name) const;
  Path folder() const { return in_document_folder("").parent_path(); }
  void ask_where(const Path& dropped);
  void copy_picture();
  void ask_export_svg();
  void ask_export_surface();
  std::string export_surface(const Path& path, double scale);

  Workspace& workspace_;
  Preferences& preferences_;
  std::function<void()> replaced_;
  bool allow_outside_;
  Jobs jobs_;
  Questions questions_;
  FileChooser dialog_;
  ExportDialog export_;
  Imports imports_;
  PictureWatch watch_;
  std::vector<Recovery> recoverable_;
  /// Change times of the scene's file. `last_seen_change_` is the one found last: the file is read
  /// when two consecutive checks find the same time, because until then it may still be written.
  /// `handled_change_` is that of the version that has been dealt with.
  std::optional<std::filesystem::file_time_type> last_seen_change_, handled_change_;
  bool quit_ = false, autosave_failed_ = false;
};

}  // namespace holomorph
