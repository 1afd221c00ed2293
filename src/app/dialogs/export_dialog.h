// One dialog for all that a scene can be exported as: what, at which size, and to which file.
#pragma once

#include "app/dialogs/export_estimate.h"
#include "app/dialogs/file_chooser.h"
#include "app/dialogs/jobs.h"
#include "film/film.h"

namespace holomorph {

/// Options for a picture with the canvas's current view, color range and time.
PictureOptions as_shown(const Workspace& workspace);
/// A message about a picture that would be missing from an export of what is shown, or "".
std::string missing_picture_message(const Workspace& workspace,
                                    ExportKind kind = ExportKind::picture);

class ExportDialog {
 public:
  /// `wake` is called on another thread when the size of the file has been estimated.
  ExportDialog(Workspace& workspace, Jobs& jobs, FileChooser& chooser, std::function<void()> wake)
      : workspace_(workspace), jobs_(jobs), chooser_(chooser), estimate_(std::move(wake)) {}

  /// Opens the dialog for a kind; if it is not set, for what was exported last, or else for a film
  /// if the scene moves and a picture otherwise. Proposes a file in the folder of the last export,
  /// or in `folder` before the first export.
  void ask(std::optional<ExportKind> kind, const Path& folder);
  /// Repeats the last export, or opens the dialog if there was none.
  void again(const Path& folder);
  /// Forgets the last export. Call this when another document is opened.
  void forget() { last_.reset(); }
  bool has_exported() const { return last_.has_value(); }
  bool open() const { return open_; }
  void draw();

 private:
  void draw_file();
  void draw_format();
  void draw_depth();
  void draw_scale();
  void draw_look();
  void draw_frames();
  void draw_meshes();
  void draw_st_map();
  std::string result_text() const;
  std::string st_map_text() const;
  ExportEstimate::Question question() const;
  int frames() const;  ///< of the film
  /// What is to be exported: the scene with the chosen background, and how it is drawn.
  std::pair<Scene, PictureOptions> drawn() const;
  std::optional<Box> region_box() const;
  std::vector<Path> files() const;
  /// Returns an error message, or "".
  std::string start(const ExportSettings& settings);
  std::vector<std::string> extensions() const;
  /// The path for a typed name. Relative names are resolved in the last folder.
  Path in_folder(const Path& path) const;
  bool take_path(const Path& path);
  void accept();

  Workspace& workspace_;
  Jobs& jobs_;
  FileChooser& chooser_;
  ExportSettings settings_;
  std::optional<ExportSettings> last_;  ///< settings of the last export
  bool last_all_ = true;                ///< the last export ended at the scene's last frame
  bool last_moved_ = false;             ///< the scene had a motion then
  Path folder_;
  std::string name_, message_;
  ExportEstimate estimate_;
  bool open_ = false, opening_ = false, confirming_ = false;
  bool choosing_ = false;  ///< a file was being chosen in the last frame
};

}  // namespace holomorph
