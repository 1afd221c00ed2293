// A file browser in the window.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/thumbnails.h"
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

  /// `wake` is called on another thread when a thumbnail is ready.
  explicit FileDialog(std::function<void()> wake) : thumbnails_(std::move(wake)) {}

  void ask(FileQuestion question, Answer answer);
  /// Sets the folder for questions without `start`.
  void start_in(const Path& folder) { folder_ = folder; }
  const Path& folder() const { return folder_; }
  bool open() const { return open_; }
  /// Sets the folders to list as places: that of the scene, and those of the recent files.
  void set_places(const Path& scene_folder, std::vector<Path> recent_folders) {
    scene_folder_ = scene_folder;
    recent_folders_ = std::move(recent_folders);
  }
  /// Shows a message below the name, for example why the last answer was rejected.
  void say(const std::string& message) { message_ = message; }
  /// Draws the dialog while it is open.
  void draw();

 private:
  void enter(const Path& folder);
  void accept(const Path& path);
  std::vector<Path> existing_files(const Path& path) const;
  bool is_listed(const Path& path) const;

  FileQuestion question_;
  Answer answer_;
  unsigned questions_ = 0;  ///< number of questions asked so far
  bool open_ = false, opening_ = false, confirming_ = false, focus_ = false;
  Path folder_, scene_folder_;
  std::vector<Path> recent_folders_;
  std::string name_, message_;
  double picture_scale_ = 1;
  struct Item {
    Path path;
    bool folder = false;
    std::filesystem::file_time_type time{};
    std::uintmax_t size = 0;
  };
  enum class Order { name, time, size };
  void sort();
  /// What a click led to: another folder to list, or a file that was chosen.
  struct Clicked {
    std::optional<Path> folder, file;
  };
  void draw_places(Clicked& clicked);
  void draw_path(Clicked& clicked);
  void draw_titles();
  void draw_item(size_t number, Clicked& clicked);
  void draw_list(Clicked& clicked, float below);

  std::vector<Item> items_;
  Order order_ = Order::name;
  bool descending_ = false;
  std::string typed_folder_;
  Thumbnails thumbnails_;
};

}  // namespace holomorph
