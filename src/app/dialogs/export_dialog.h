// One dialog for pictures and films: what is exported, how large, and into which file.
#pragma once

#include "app/dialogs/file_chooser.h"
#include "app/dialogs/jobs.h"
#include "film/film.h"

namespace holomorph {

/// What is asked for; the same again with "Export again".
struct ExportSettings {
  enum class Region { all, picture, canvas };
  Path path;          ///< its extension says the format
  bool film = false;  ///< .png and .webp are pictures, or with this films
  double scale = 1;   ///< output pixels per image pixel
  Region region = Region::all;
  std::optional<Background> background;  ///< none: the scene's
  int first = 0, last = 0;               ///< frames
  bool loops = true;
};

/// What the canvas shows, as a picture: its view, its range and its time.
PictureOptions as_shown(const Workspace& workspace);
/// Says which picture such a picture would lack; "" for none.
std::string lacking(const Workspace& workspace);

class ExportDialog {
 public:
  ExportDialog(Workspace& workspace, Jobs& jobs, FileChooser& chooser)
      : workspace_(workspace), jobs_(jobs), chooser_(chooser) {}

  /// Opens for a picture or a film, to be written beside `folder` unless one was before.
  void ask(bool film, const Path& folder);
  /// What was exported last once more, or the dialog where there was nothing.
  void again(const Path& folder);
  /// Another document: nothing was exported yet.
  void forget() { last_.reset(); }
  bool has_exported() const { return last_.has_value(); }
  bool open() const { return open_; }
  void draw(double scale);

 private:
  void draw_file(double scale);
  void draw_format(float s);
  void draw_look(float s);
  void draw_frames(float s);
  std::string result_text() const;
  std::optional<Box> region_box() const;
  std::vector<Path> files() const;
  /// Returns what is wrong, or "".
  std::string start(const ExportSettings& settings);
  std::vector<std::string> extensions() const;
  /// What is typed without a folder lies in the one that was last.
  Path in_folder(const Path& path) const;
  bool take_path(const Path& path);
  void accept();

  Workspace& workspace_;
  Jobs& jobs_;
  FileChooser& chooser_;
  ExportSettings settings_;
  std::optional<ExportSettings> last_;  ///< what was exported
  bool last_all_ = true;                ///< with all frames
  Path folder_;
  std::string name_, message_;
  bool open_ = false, opening_ = false, confirming_ = false;
};

}  // namespace holomorph
