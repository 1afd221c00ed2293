// A folder is read when it is entered, not in every frame.
#include "app/dialogs/file_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "app/panels/panels.h"
#include "system/text.h"

namespace holomorph {
namespace fs = std::filesystem;

namespace {

Path home() {
  const char* home = std::getenv("HOME");
  return home && *home ? Path(home) : Path("/");
}

}  // namespace

void FileDialog::ask(FileQuestion question, Answer answer) {
  question_ = std::move(question);
  answer_ = std::move(answer);
  ++questions_;
  open_ = opening_ = true;
  confirming_ = false;
  picture_scale_ = 1;
  name_.clear();
  std::error_code error;
  Path start = question_.start.empty() ? folder_ : question_.start;
  if (!start.empty() && !fs::is_directory(start, error)) {
    name_ = start.filename().string();
    start = start.parent_path();
  }
  if (start.empty() || !fs::is_directory(start, error)) start = fs::current_path(error);
  enter(start);
}

bool FileDialog::is_listed(const Path& path) const {
  const auto is = [&](const std::string& extension) {
    return std::ranges::find(question_.extensions, extension) != question_.extensions.end();
  };
  return is(lower_case(path.extension().string())) || is(format_extension(path));
}

void FileDialog::enter(const Path& folder) {
  confirming_ = false;
  message_.clear();
  std::vector<Item> items;
  std::error_code error;
  for (fs::directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error),
       end;
       !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().string().starts_with(".")) continue;
    std::error_code ignored;
    const bool is_folder = entry->is_directory(ignored);
    if (is_folder || is_listed(entry->path())) items.push_back({entry->path(), is_folder});
  }
  if (error) {
    message_ = folder.string() + " cannot be read: " + error.message();
    return;
  }
  std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    return std::make_pair(!a.folder, lower_case(a.path.filename().string())) <
           std::make_pair(!b.folder, lower_case(b.path.filename().string()));
  });
  folder_ = absolute_path(folder);
  items_ = std::move(items);
}

/// The existing files that saving to this path would replace.
std::vector<Path> FileDialog::existing_files(const Path& path) const {
  std::vector<Path> files = question_.writes ? question_.writes(path) : std::vector{path};
  std::erase_if(files, [](const Path& file) {
    std::error_code error;
    return !fs::exists(file, error);
  });
  return files;
}

void FileDialog::accept(const Path& wanted) {
  Path path = wanted;
  std::error_code error;
  if (fs::is_directory(path, error)) return enter(path);
  if (question_.mode == FileQuestion::Mode::open) {
    if (!fs::exists(path, error)) {
      message_ = "There is no file '" + path.filename().string() + "' in this folder.";
      return;
    }
  } else {
    if (!is_listed(path) && question_.extensions.size() > 1 && path.has_extension()) {
      message_ = path.extension().string() + " is not a supported format. Choose one of";
      for (const std::string& extension : question_.extensions) message_ += " " + extension;
      return;
    }
    if (!is_listed(path)) path += question_.extensions[0];
    if (const std::vector<Path> there = confirming_ ? std::vector<Path>() : existing_files(path);
        !there.empty()) {
      confirming_ = true;
      message_ = there[0].filename().string() +
                 (there.size() == 1 ? " already exists. Press Enter or Replace to overwrite it."
                                    : " and " + std::to_string(there.size() - 1) +
                                          " more files already exist. Press Enter or Replace to "
                                          "overwrite them.");
      focus_ = true;
      return;
    }
  }
  const Answer answer = answer_;
  const unsigned question = questions_;
  const std::string problem = answer(path, picture_scale_);
  if (questions_ != question) return;  // the answer led to another question
  message_ = problem;
  confirming_ = false;
  if (!problem.empty()) return;
  open_ = false;
  ImGui::CloseCurrentPopup();
}

void FileDialog::draw(double scale) {
  if (!open_) return;
  const float s = static_cast<float>(scale);
  const std::string id = question_.title + "###file-dialog";
  if (opening_) ImGui::OpenPopup("###file-dialog");
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize({std::min(680 * s, display.x - 20), std::min(480 * s, display.y - 20)},
                           ImGuiCond_Always);
  ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  bool keep = true;
  if (!ImGui::BeginPopupModal(id.c_str(), &keep,
                              ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) {
    open_ = false;
    return;
  }
  std::optional<Path> go;
  if (ImGui::Button("Up")) go = folder_.parent_path();
  ImGui::SameLine();
  if (ImGui::Button("Home")) go = home();
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(folder_.c_str());

  const float below = ImGui::GetFrameHeightWithSpacing() * (question_.asks_scale ? 3.0f : 2.0f) +
                      std::max(ImGui::GetTextLineHeightWithSpacing(),
                               ImGui::CalcTextSize(message_.c_str(), nullptr, false,
                                                   ImGui::GetContentRegionAvail().x)
                                       .y +
                                   ImGui::GetStyle().ItemSpacing.y);
  std::optional<Path> chosen;
  begin_part("files", {0, -below}, true);
  for (size_t i = 0; i < items_.size(); ++i) {
    const Item& item = items_[i];
    if (text_row(static_cast<int>(i), item.path.filename().string() + (item.folder ? "/" : ""),
                 item.path.filename() == name_, {0, 0},
                 ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups)) {
      confirming_ = false;
      if (!item.folder) name_ = item.path.filename().string();
      const bool by_key = !ImGui::IsMouseClicked(0) && !ImGui::IsMouseReleased(0);
      if (by_key || ImGui::IsMouseDoubleClicked(0)) (item.folder ? go : chosen) = item.path;
    }
  }
  if (items_.empty()) ImGui::TextDisabled("No files of this kind in this folder.");
  ImGui::EndChild();

  if (opening_ || focus_) ImGui::SetKeyboardFocusHere();
  opening_ = focus_ = false;
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputTextWithHint(
      "##name", "File name or path", &name_,
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemEdited()) confirming_ = false;
  if (question_.asks_scale) {
    float value = static_cast<float>(picture_scale_);
    ImGui::SetNextItemWidth(200 * s);
    if (ImGui::SliderFloat("Scale", &value, 0.1f, 4.0f, "%.2f", ImGuiSliderFlags_AlwaysClamp))
      picture_scale_ = value;
  }
  if (!message_.empty())
    ImGui::TextWrapped("%s", message_.c_str());
  else
    ImGui::TextDisabled("%s", question_.mode == FileQuestion::Mode::open
                                  ? "Press Enter or double-click to choose a file."
                                  : "The extension is added if it is missing.");
  const bool pressed =
      ImGui::Button(confirming_ ? "Replace" : question_.button.c_str(), {120 * s, 0});
  ImGui::SameLine();
  const bool cancelled = ImGui::Button("Cancel", {120 * s, 0}) || escape_pressed();
  if ((entered || pressed) && name_.empty()) message_ = "Choose a file, or type its name.";
  if ((entered || pressed) && !name_.empty())
    chosen = Path(name_).is_absolute() ? Path(name_) : folder_ / name_;
  if (go) enter(*go);
  if (chosen) accept(*chosen);
  if (cancelled || !keep) {
    open_ = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace holomorph
