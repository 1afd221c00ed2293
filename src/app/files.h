// The document and its files: opening, saving, exporting, autosave and recovery, and the questions
// for the user that these involve.
#pragma once

#include "app/dialogs/layer_question.h"
#include "app/dialogs/question.h"
#include "app/exports.h"
#include "app/imports.h"
#include "app/picture_watch.h"
#include "app/scene_watch.h"
#include "scene/preferences.h"
#include "scene/recovery.h"

namespace holomorph {

/// Owns the dialogs and questions about files, and keeps the list of recent files. Asks the user
/// before it discards unsaved work.
class Files {
 public:
  /// Calls `replaced` whenever the workspace gets another document. Worker threads call `wake` when
  /// they have finished. With `allow_outside`, scenes may show pictures from any folder.
  Files(Workspace& workspace, Preferences& preferences, std::function<void()> replaced,
        const std::function<void()>& wake, bool allow_outside);

  /// Both open a scene or a picture. open() does so immediately and returns an error message, or
  /// "". ask_open() first asks what to do about unsaved work.
  std::string open(const Path& path);
  void ask_open(const Path& path);
  /// Handles a dropped file. If there is a cage, a surface or SVG path becomes the outline. If
  /// there is a picture but no cage, an SVG path becomes the cage and a surface is refused. Any
  /// other file is opened. If another document is open, asks whether to add, replace or open.
  void drop(const Path& path);
  /// Opens a scene as a new document without a file. Asks about unsaved work first.
  void ask_sample(const Path& scene);
  /// Handles an action's request if it concerns files.
  void answer(Request request);
  /// Recovers or deletes the autosave of an earlier session.
  void ask_recover(const Path& autosave);
  void discard(const Path& autosave);
  const std::vector<Recovery>& recoverable() const { return recoverable_; }

  /// Reloads pictures and the scene when another program has changed them. Call this regularly.
  void watch();
  /// Keeps the autosave up to date. Call this once per frame.
  void autosave();
  void keep_preferences();
  /// Draws the open dialog or question, if any.
  void draw(Thumbnails& thumbnails);
  bool asking() const {
    return dialog_.open() || exports_.asking() || questions_.open() || layer_question_.open() ||
           jobs_.running();
  }
  /// The title of the question dialog, or "".
  std::string question() const {
    return layer_question_.open() ? LayerQuestion::kTitle : questions_.title();
  }
  /// Whether a job is running. Frames must then be drawn even without events.
  bool busy() const { return jobs_.running(); }
  Jobs& jobs() { return jobs_; }
  FileChooser& chooser() { return dialog_; }
  bool has_quit() const { return quit_; }
  /// Whether a picture or film of the document was exported.
  bool has_exported() const { return exports_.has_exported(); }

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
  void ask_about_layers(FoundLayers found);
  void show_withheld();
  void reload();
  void watch_scene();
  void ask_about_change(const Path& path, const Then& then);
  enum class Conflict { ask, overwrite };
  std::string save_to(const Path& path, const Then& then, Conflict conflict = Conflict::ask);
  void save(bool as, const Then& then = {});
  void ask_where(const Path& dropped);

  Workspace& workspace_;
  Preferences& preferences_;
  std::function<void()> replaced_;
  bool allow_outside_;
  Jobs jobs_;
  Questions questions_;
  LayerQuestion layer_question_;
  FileChooser dialog_;
  Exports exports_;
  Imports imports_;
  PictureWatch watch_;
  SceneWatch scene_watch_;
  std::vector<Recovery> recoverable_;
  bool quit_ = false, autosave_failed_ = false;
};

}  // namespace holomorph
