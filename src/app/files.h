// The document's life as files: opening, saving, exporting, autosave and recovery, and what they
// ask the user.
#pragma once

#include "app/file_dialog.h"
#include "edit/workspace.h"
#include "scene/preferences.h"

namespace holomorph {

class Files {
 public:
  /// `replaced` is called whenever the workspace has got another document.
  Files(Workspace& workspace, Preferences& preferences, std::function<void()> replaced);

  /// Opens a scene or a picture at once, or after the user has decided about unsaved work.
  void open(const Path& path);
  void ask_open(const Path& path);
  /// Does what an action asked for, if it is about files.
  void answer(Request request);
  /// Recovers or deletes what an earlier session left.
  void ask_recover(const Path& autosave);
  void discard(const Path& autosave);
  const std::vector<Recovery>& recoverable() const { return recoverable_; }

  /// Keeps the autosave true; called once a frame.
  void autosave();
  void keep_preferences();
  /// Draws the dialog or question that is open.
  void draw(double scale);
  bool asking() const { return dialog_.open() || question_; }
  bool has_quit() const { return quit_; }

 private:
  using Then = std::function<void()>;
  void ask_then(Then then);
  void adopt(Document document);
  void recover(const Path& autosave);
  void save_to(const Path& path, const Then& then);
  void save(bool as, const Then& then = {});
  void export_to(const Path& path, double scale);
  void ask_export();
  void draw_question(double scale);

  Workspace& workspace_;
  Preferences& preferences_;
  std::function<void()> replaced_;
  FileDialog dialog_;
  std::vector<Recovery> recoverable_;
  Then after_question_;
  Path export_path_;
  double export_scale_ = 1;
  bool question_ = false, quit_ = false, autosave_failed_ = false;
};

}  // namespace holomorph
