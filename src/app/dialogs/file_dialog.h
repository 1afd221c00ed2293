// A file browser in the window.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "system/file.h"

namespace holomorph {

/// A request to choose a file.
struct FileQuestion {
  enum class Mode { open, save } mode = Mode::open;
  std::string title, button;
  /// In lower case, with the dot. When saving, the first one is added to a name that ends in none
  /// of them.
  std::vector<std::string> extensions;
  Path start;               ///< a folder or a file; empty: the last folder
  bool asks_scale = false;  ///< also asks for the scale of pictures
  /// Returns the files that saving to a path writes. If not set, saving writes the path itself.
  std::function<std::vector<Path>(const Path&)> writes = {};
};

/// Shows one question at a time and passes the chosen path to a callback.
class FileDialog {
 public:
  /// Uses the chosen path. Returns "", or an error message, which keeps the dialog open.
  using Answer = std::function<std::string(const Path& path, double scale)>;

  void ask(FileQuestion question, Answer answer);
  /// Sets the folder for questions without `start`.
  void start_in(const Path& folder) { folder_ = folder; }
  const Path& folder() const { return folder_; }
  bool open() const { return open_; }
  /// Shows a message below the name, for example why the last answer was rejected.
  void say(const std::string& message) { message_ = message; }
  /// Draws the dialog while it is open.
  void draw(double scale);

 private:
  void enter(const Path& folder);
  void accept(const Path& path);
  std::vector<Path> existing_files(const Path& path) const;
  bool is_listed(const Path& path) const;

  FileQuestion question_;
  Answer answer_;
  unsigned questions_ = 0;  ///< number of questions asked so far
  bool open_ = false, opening_ = false, confirming_ = false, focus_ = false;
  Path folder_;
  std::string name_, message_;
  double picture_scale_ = 1;
  struct Item {
    Path path;
    bool folder;
  };
  std::vector<Item> items_;
};

}  // namespace holomorph
