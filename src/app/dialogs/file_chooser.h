// Asks the user for a file: with the desktop's own dialog if there is one, otherwise with the
// browser in this window.
#pragma once

#include <memory>

#include "app/dialogs/file_dialog.h"
#include "system/job.h"

namespace holomorph {

/// Asks one question at a time and passes the chosen path to a callback.
class FileChooser {
 public:
  using Answer = FileDialog::Answer;

  /// `wake` is called on another thread when the desktop's dialog has been answered.
  explicit FileChooser(std::function<void()> wake) : browser_(wake), wake_(std::move(wake)) {}

  /// Questions that ask for more than a file name always use the browser.
  void ask(FileQuestion question, Answer answer);
  /// Asks for a file to read. `answer` uses the file and returns an error message, or "".
  void ask_open(const std::string& title, const std::string& button,
                std::vector<std::string> extensions,
                std::function<std::string(const Path&)> answer) {
    ask({FileQuestion::Mode::open, title, button, std::move(extensions), {}, false},
        [answer = std::move(answer)](const Path& path, double) { return answer(path); });
  }
  void start_in(const Path& folder) { browser_.start_in(folder); }
  const Path& folder() const { return browser_.folder(); }
  void set_places(const Path& scene_folder, std::vector<Path> recent_folders) {
    browser_.set_places(scene_folder, std::move(recent_folders));
  }
  bool open() const { return browser_.open() || native_; }
  void draw();
  /// Whether to use the desktop's dialogs.
  void use_native(bool use) { uses_native_ = use; }

 private:
  void use_native_answer();

  FileDialog browser_;
  std::function<void()> wake_;
  bool uses_native_ = true;
  FileQuestion question_;
  Answer answer_;
  std::shared_ptr<std::string> chosen_;
  std::unique_ptr<Job> native_;
};

}  // namespace holomorph
