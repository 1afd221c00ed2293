// A folder is read when it is entered, not in every frame.
#include "app/dialogs/file_dialog.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <utility>

#include "app/look/controls.h"
#include "app/look/numbers.h"
#include "app/look/surfaces.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"
#include "system/text.h"

namespace holomorph {
namespace fs = std::filesystem;

namespace {

Path home() {
  const char* home = std::getenv("HOME");
  return home && *home ? Path(home) : Path("/");
}

/// "Today 14:05", or the day.
std::string text_of_time(fs::file_time_type time) {
  const auto system = std::chrono::time_point_cast<std::chrono::system_clock::duration>(
      time - fs::file_time_type::clock::now() + std::chrono::system_clock::now());
  const std::time_t seconds = std::chrono::system_clock::to_time_t(system),
                    now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm then{}, today{};
  localtime_r(&seconds, &then);
  localtime_r(&now, &today);
  const bool same_day = then.tm_year == today.tm_year && then.tm_yday == today.tm_yday;
  char text[40];
  std::strftime(text, sizeof text, same_day ? "Today %H:%M" : "%d %b %Y", &then);
  return text;
}

std::string text_of_size(std::uintmax_t bytes) {
  char text[40];
  if (bytes < 1000)
    std::snprintf(text, sizeof text, "%d B", static_cast<int>(bytes));
  else if (bytes < 1000000)
    std::snprintf(text, sizeof text, "%.0f kB", static_cast<double>(bytes) / 1e3);
  else
    std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) / 1e6);
  return text;
}

/// The widths of the columns for time and size.
float time_width() {
  return px(112);
}
float size_width() {
  return px(80);
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
  Path start = question_.start;
  if (start.empty()) start = !scene_folder_.empty() && folder_.empty() ? scene_folder_ : folder_;
  if (start.empty() && !recent_folders_.empty()) start = recent_folders_.front();
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
    if (!is_folder && !is_listed(entry->path())) continue;
    Item item{entry->path(), is_folder};
    item.time = entry->last_write_time(ignored);
    if (!is_folder && !ignored) item.size = entry->file_size(ignored);
    if (ignored) continue;  // a link to nothing, for example
    items.push_back(std::move(item));
  }
  if (error) {
    message_ = folder.string() + " cannot be read: " + error.message();
    return;
  }
  folder_ = absolute_path(folder);
  typed_folder_ = folder_.string();
  items_ = std::move(items);
  sort();
}

/// Sorts the items in the chosen order, folders first.
void FileDialog::sort() {
  const auto is_before = [&](const Item& a, const Item& b) {
    if (order_ == Order::time && a.time != b.time) return a.time < b.time;
    if (order_ == Order::size && a.size != b.size) return a.size < b.size;
    return lower_case(a.path.filename().string()) < lower_case(b.path.filename().string());
  };
  std::ranges::stable_sort(items_, [&](const Item& a, const Item& b) {
    if (a.folder != b.folder) return a.folder;
    return descending_ ? is_before(b, a) : is_before(a, b);
  });
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

void FileDialog::draw_places(Clicked& clicked) {
  const ThemeColors& c = theme_colors();
  const auto place = [&](const char* icon, const std::string& label, const Path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) return;
    const ImVec2 at = ImGui::GetCursorScreenPos(), size(ImGui::GetContentRegionAvail().x, px(28));
    ImGui::PushID(folder.c_str());
    if (ImGui::Selectable("##place", folder == folder_, ImGuiSelectableFlags_DontClosePopups, size))
      clicked.folder = folder;
    ImGui::PopID();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = at.y + size.y / 2;
    draw_icon(list, icon, {at.x + px(14), middle}, c.muted, Type::caption);
    draw_text(list, Type::body, {at.x + px(28), middle - font(Type::body)->FontSize / 2}, c.text,
              shortened_text(label, size.x - px(32)));
    name_item("Place: " + label);
  };
  place(icon_named("folder"), "Home", home());
  for (const char* name : {"Desktop", "Documents", "Pictures", "Downloads"})
    place(icon_named("folder"), name, home() / name);
  if (!scene_folder_.empty()) place(icon_named("picture"), "This scene", scene_folder_);
  for (const Path& folder : recent_folders_)
    place(icon_named("clock"), folder.filename().string(), folder);
  place(icon_named("folder"), "Computer", "/");
}

void FileDialog::draw_path(Clicked& clicked) {
  if (icon_button("Up", icon_named("up"), "The folder above"))
    clicked.folder = folder_.parent_path();
  ImGui::SameLine(0, px(4));
  if (text_field("##folder", typed_folder_, "Folder", -1) && !typed_folder_.empty()) {
    const Path typed(typed_folder_);
    clicked.folder = typed.is_absolute() ? typed : folder_ / typed;
  }
}

/// The titles of the columns. A click sorts by a column; another one reverses the order.
void FileDialog::draw_titles() {
  const ThemeColors& c = theme_colors();
  const float room = ImGui::GetContentRegionAvail().x - px(12), tall = px(24);
  const auto title = [&](const char* label, Order order, float width) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton(label, {width, tall})) {
      descending_ = order_ == order ? !descending_ : order != Order::name;
      order_ = order;
      sort();
    }
    const ImU32 ink = ImGui::IsItemHovered() || order_ == order ? c.text : c.muted;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float y = at.y + (tall - font(Type::caption)->FontSize) / 2;
    draw_text(list, Type::caption, {at.x + px(4), y}, ink, label);
    if (order_ == order)
      draw_icon(list, descending_ ? icon_named("down") : icon_named("up"),
                {at.x + px(16) + text_size(Type::caption, label).x, at.y + tall / 2}, ink,
                Type::caption);
    draw_focus_ring(px(4));
    name_item(std::string("Sort: ") + label);
    ImGui::SameLine(0, 0);
  };
  title("Name", Order::name, room - time_width() - size_width());
  title("Changed", Order::time, time_width());
  title("Size", Order::size, size_width());
  ImGui::NewLine();
}

void FileDialog::draw_item(size_t number, Clicked& clicked) {
  const ThemeColors& c = theme_colors();
  const Item& item = items_[number];
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = px(36), side = px(28);
  ImGui::PushID(static_cast<int>(number));
  const bool pressed = ImGui::Selectable(
      "##file", item.path.filename() == name_,
      ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups,
      {width, height});
  ImGui::PopID();
  if (pressed) {
    confirming_ = false;
    if (!item.folder) name_ = item.path.filename().string();
    const bool by_key = !ImGui::IsMouseClicked(0) && !ImGui::IsMouseReleased(0);
    if (by_key || ImGui::IsMouseDoubleClicked(0))
      (item.folder ? clicked.folder : clicked.file) = item.path;
  }
  name_item("File: " + item.path.filename().string());
  if (!ImGui::IsItemVisible()) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = at.y + height / 2, x = at.x + px(4) + side + px(8),
              columns = time_width() + size_width();
  const Texture* texture = item.folder ? nullptr : thumbnails_.of_file(item.path);
  if (texture)
    draw_thumbnail(list, texture, {at.x + px(4), middle - side / 2}, side, px(4));
  else
    draw_icon(list, item.folder ? icon_named("folder") : icon_named("picture"),
              {at.x + px(4) + side / 2, middle}, c.muted);
  const float y = middle - font(Type::body)->FontSize / 2;
  draw_text(list, Type::body, {x, y}, c.text,
            shortened_text(item.path.filename().string(), at.x + width - columns - x - px(8)));
  const float small = middle - font(Type::caption)->FontSize / 2;
  draw_text(list, Type::caption, {at.x + width - columns, small}, c.muted, text_of_time(item.time));
  if (!item.folder)
    draw_text(list, Type::caption, {at.x + width - size_width(), small}, c.muted,
              text_of_size(item.size));
}

void FileDialog::draw_list(Clicked& clicked, float below) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(4), px(4)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  begin_part("places", {px(168), -below});
  draw_places(clicked);
  ImGui::EndChild();
  ImGui::SameLine(0, px(16));
  ImGui::BeginGroup();
  draw_path(clicked);
  draw_titles();
  ImGui::PushStyleColor(ImGuiCol_ChildBg, color_of(theme_colors().field));
  begin_part("files", {0, -below}, true);
  for (size_t i = 0; i < items_.size(); ++i) draw_item(i, clicked);
  if (items_.empty()) muted_text("No files of this kind in this folder.");
  ImGui::EndChild();
  ImGui::PopStyleColor();
  ImGui::EndGroup();
  ImGui::PopStyleVar(2);
}

void FileDialog::draw() {
  if (!open_) return;
  const bool opens = std::exchange(opening_, false);
  if (!begin_dialog(question_.title, "###file-dialog", 840, 600)) {
    open_ = false;
    return;
  }
  const float message_height = std::max(
      ImGui::GetTextLineHeight(),
      ImGui::CalcTextSize(message_.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x).y);
  Clicked clicked;
  // Below the list: a gap, the name, the scale, the message, and the line with the buttons.
  const float gap = ImGui::GetStyle().ItemSpacing.y, row = px(28) + gap;
  draw_list(clicked, px(8) + row * (question_.asks_scale ? 2 : 1) + message_height + 3 * gap +
                         px(4 + 4 + 32));
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + px(8));
  if (opens || focus_) ImGui::SetKeyboardFocusHere();
  focus_ = false;
  const bool entered =
      text_field("##name", name_, "File name or path", -1, ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemEdited()) confirming_ = false;
  if (question_.asks_scale) {
    double percent = 100 * picture_scale_;
    if (slider_row("Scale", percent, {10, 400, "%", 0, true, 100.0}))
      picture_scale_ = percent / 100;
  }
  if (!message_.empty())
    wrapped_text(message_);
  else
    caption(question_.mode == FileQuestion::Mode::open
                ? "Press Enter or double-click to choose a file."
                : "The extension is added if it is missing.");
  const float width = px(104);
  begin_dialog_buttons(2 * width + px(8));
  const DialogKey key = dialog_key();
  const bool cancelled = button("Cancel", ButtonKind::secondary, width) || key == DialogKey::escape;
  ImGui::SameLine(0, px(8));
  const bool pressed = button(confirming_ ? "Replace" : question_.button,
                              confirming_ ? ButtonKind::danger : ButtonKind::primary, width) ||
                       key == DialogKey::enter;
  if ((entered || pressed) && name_.empty()) message_ = "Choose a file, or type its name.";
  if ((entered || pressed) && !name_.empty())
    clicked.file = Path(name_).is_absolute() ? Path(name_) : folder_ / name_;
  if (clicked.folder) enter(*clicked.folder);
  if (clicked.file) accept(*clicked.file);
  if (cancelled) {
    open_ = false;
    ImGui::CloseCurrentPopup();
  }
  end_dialog();
}

}  // namespace holomorph
