// The desktop's dialog is a separate program (zenity or kdialog). Therefore, Holomorph needs no GUI
// toolkit and survives a crash of the dialog.
#include "app/dialogs/file_chooser.h"

#include <imgui.h>

#include <utility>

#include "app/look/controls.h"
#include "app/look/surfaces.h"
#include "scene/formats/image.h"
#include "system/process.h"

namespace holomorph {
namespace {

/// File name patterns for the extensions, such as "*.png *.PNG".
std::string patterns(const std::vector<std::string>& extensions) {
  std::string text;
  for (const std::string& extension : extensions) {
    std::string upper = extension;
    for (char& c : upper)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    text += (text.empty() ? "*" : " *") + extension + " *" + upper;
  }
  return text;
}

/// The command that opens the desktop's dialog, or nothing if there is no such dialog.
std::vector<std::string> native_command(const FileQuestion& question, const Path& start) {
  const bool saves = question.mode == FileQuestion::Mode::save;
  if (has_program("zenity")) {
    std::vector<std::string> words{
        "zenity",
        "--file-selection",
        "--title=" + question.title,
        "--filename=" + start.string(),
        "--file-filter=Supported files | " + patterns(question.extensions),
        "--file-filter=All files | *"};
    if (saves) words.insert(words.end(), {"--save", "--confirm-overwrite"});
    return words;
  }
  if (has_program("kdialog"))
    return {"kdialog",      "--title",
            question.title, saves ? "--getsavefilename" : "--getopenfilename",
            start.string(), patterns(question.extensions)};
  return {};
}

}  // namespace

void FileChooser::ask(FileQuestion question, Answer answer) {
  Path start = question.start.empty() ? folder() / "" : question.start;
  const std::vector<std::string> command = uses_native_ && !question.asks_scale
                                               ? native_command(question, start)
                                               : std::vector<std::string>();
  if (command.empty()) return browser_.ask(std::move(question), std::move(answer));
  question_ = std::move(question);
  answer_ = std::move(answer);
  chosen_ = std::make_shared<std::string>();
  native_ = std::make_unique<Job>(
      question_.title,
      [command, chosen = chosen_](Job::Progress& progress) {
        const auto finished =
            run_program(command, "", {.keep_running = [&] { return !progress.cancelled(); }});
        if (!finished || finished->status != 0) return;
        *chosen = finished->output.substr(0, finished->output.find('\n'));
      },
      wake_);
}

/// Uses the answer of the desktop's dialog. Opens the browser if a question remains: whether to
/// replace files that the desktop's dialog did not ask about, or which file to use instead if the
/// answer was rejected.
void FileChooser::use_native_answer() {
  native_.reset();
  if (chosen_->empty()) return;
  // Move the members into locals, because the answer may ask another question.
  FileQuestion question = std::move(question_);
  const Answer answer = std::move(answer_);
  Path path = *chosen_;
  std::error_code error;
  const bool saves = question.mode == FileQuestion::Mode::save;
  const std::string kind = format_extension(path);
  const bool known = std::find(question.extensions.begin(), question.extensions.end(), kind) !=
                     question.extensions.end();
  bool asks = false;
  if (saves && !known) {
    path += question.extensions[0];
    asks = std::filesystem::exists(path, error);
  }
  if (saves && question.writes && question.writes(path) != std::vector{path}) asks = true;
  std::string problem;
  if (!asks) {
    browser_.start_in(path.parent_path());
    problem = answer(path, 1);
    if (problem.empty() || open()) return;
  }
  question.start = path;
  browser_.ask(question, answer);
  browser_.say(problem);
}

void FileChooser::draw() {
  if (!native_) return browser_.draw();
  // The window is still drawn but accepts no input until the desktop's dialog is closed.
  if (!begin_dialog("Choose a file in the other window", "###native", 400)) return;
  ImGui::TextUnformatted(question_.title.c_str());
  begin_dialog_buttons(px(96));
  const bool cancelled = button("Cancel", ButtonKind::secondary, px(96)) ||
                         ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)),
             ended = native_->ended();
  if (cancelled || ended) ImGui::CloseCurrentPopup();
  end_dialog();
  if (cancelled)
    native_.reset();
  else if (ended)
    use_native_answer();
}

}  // namespace holomorph
