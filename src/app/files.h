// The document's life as files: opening, saving, exporting, autosave and recovery, and what they
// ask the user.
#pragma once

#include "app/dialogs/export_dialog.h"
#include "app/dialogs/question.h"
#include "app/imports.h"
#include "app/picture_watch.h"
#include "scene/preferences.h"
#include "scene/recovery.h"

namespace holomorph {

/// Knows the document's path and picture, the dialogs and the recent files; asks before unsaved
/// work is lost.
class Files {
 public:
  /// `replaced` is called whenever the workspace has got another document, `wake` on other threads
  /// when something has ended there. With `everywhere`, scenes show pictures of any folder.
  Files(Workspace& workspace, Preferences& preferences, std::function<void()> replaced,
        const std::function<void()>& wake, bool everywhere);

  /// Opens a scene or a picture at once, or after the user has decided about unsaved work. Returns
  /// what is wrong, or "".
  std::string open(const Path& path);
  void ask_open(const Path& path);
  /// The same for a dropped file, but surfaces and SVG paths become the outline where there is a
  /// cage, and a path the cage where there is none; where a picture should go is asked.
  void drop(const Path& path);
  /// Opens a copy of a scene, which has no file of its own yet.
  void ask_sample(const Path& scene);
  /// Does what an action asked for, if it is about files.
  void answer(Request request);
  /// Recovers or deletes what an earlier session left.
  void ask_recover(const Path& autosave);
  void discard(const Path& autosave);
  const std::vector<Recovery>& recoverable() const { return recoverable_; }

  /// Reads pictures and the scene again that another program has changed; called now and then.
  void watch();
  /// Keeps the autosave true; called once a frame.
  void autosave();
  void keep_preferences();
  /// Draws the dialog or question that is open.
  void draw(double scale);
  bool asking() const {
    return dialog_.open() || export_.open() || questions_.open() || jobs_.running();
  }
  /// The title of the question that is open, or "".
  std::string question() const { return questions_.title(); }
  /// Whether something goes on that is to be seen though nothing happens.
  bool busy() const { return jobs_.running(); }
  Jobs& jobs() { return jobs_; }
  FileChooser& chooser() { return dialog_; }
  bool has_quit() const { return quit_; }
  /// Whether the document as it is lies in a file, or a picture of it was exported.
  bool has_kept() const {
    const Document& document = workspace_.document;
    return export_.has_exported() || (!document.path().empty() && !document.modified());
  }

 private:
  using Then = std::function<void()>;
  Reach reach() const { return {everywhere_, preferences_.trusted}; }
  void trust_folder_of(const Path& path);
  void ask_then(Then then);
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
  /// A name in the folder of the document, or where files were chosen last.
  Path beside_document(const std::string& name) const;
  Path folder() const { return beside_document("").parent_path(); }
  void ask_where(const Path& dropped);
  void copy_picture();
  void ask_export_svg();
  void ask_export_surface();
  std::string export_surface(const Path& path, double scale);

  Workspace& workspace_;
  Preferences& preferences_;
  std::function<void()> replaced_;
  bool everywhere_;
  Jobs jobs_;
  Questions questions_;
  FileChooser dialog_;
  ExportDialog export_;
  Imports imports_;
  PictureWatch watch_;
  std::vector<Recovery> recoverable_;
  /// When the scene's file was changed last, as two looks find it the same: it may still be being
  /// written. And when it was as it could not be read, or is not to be.
  std::optional<std::filesystem::file_time_type> changing_, left_alone_;
  bool quit_ = false, autosave_failed_ = false;
};

}  // namespace holomorph
