// The settings are kept from one export of a document to the next.
#include "app/dialogs/export_dialog.h"

#include <imgui.h>
// Must follow imgui.h, because it does not include that header itself.
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "app/look/controls.h"
#include "app/panels/panels.h"
#include "edit/content.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

constexpr const char* kRegions[] = {"Everything", "The picture's rectangle",
                                    "What the canvas shows"};

/// A file format: its name, its extension, and whether it is for films.
struct Format {
  std::string label, extension;
  bool film = false;
};

std::vector<Format> formats(bool plays) {
  std::vector<Format> all;
  for (const PictureFormat& format : picture_formats())
    all.push_back({format.label, format.extension, false});
  if (plays)
    for (const FilmFormat& format : film_formats())
      all.push_back({format.label, format.extension, true});
  return all;
}

/// Whether an extension belongs to a known format of pictures or films. Anything else that follows
/// a dot is a part of the name.
bool is_known_extension(const std::string& extension) {
  const auto is = [&](const std::string& each) { return each == extension; };
  return std::ranges::any_of(picture_extensions(), is) ||
         std::ranges::any_of(film_formats(), is, &FilmFormat::extension);
}

bool uses_format(const ExportSettings& settings, const Format& format) {
  return settings.film == format.film && format_extension(settings.path) == format.extension;
}

}  // namespace

PictureOptions as_shown(const Workspace& workspace) {
  PictureOptions options;
  options.view = workspace.shown.own().has_cage() ? workspace.display.view : View::image;
  options.automatic_range = workspace.display.automatic_range;
  options.time = workspace.shown.time_of_layers();
  return options;
}

std::string missing_picture_message(const Workspace& workspace) {
  const Document& document = workspace.document;
  if (as_shown(workspace).view != View::image) return "";
  for (const size_t i : document.layers_without_picture())
    if (const Layer& layer = *document.scene().layers[i]; layer.visible)
      return Path(layer.image->file).filename().string() +
             (document.pictures().withheld().contains(layer.image->file)
                  ? " is not in the scene's folder. Press Show it, or hide its layer."
                  : " could not be read. Press Find it, or hide its layer.");
  return "";
}

void ExportDialog::ask(bool film, const Path& folder) {
  const Document& document = workspace_.document;
  folder_ = folder;
  if (last_) {
    settings_ = *last_;
    folder_ = settings_.path.parent_path();
  } else {
    const Path source = document.path().empty() ? document.first_picture() : document.path();
    const std::string stem = source.empty() ? "picture" : source.stem().string();
    settings_ = {};
    settings_.path = folder / (stem + (film ? ".webp" : "-bent.png"));
  }
  const int last = last_frame_of(document.scene());
  const bool had_all = !last_ || last_all_;
  settings_.last = had_all ? last : std::clamp(settings_.last, 0, last);
  settings_.first = std::clamp(settings_.first, 0, settings_.last);
  if (film != settings_.film) {
    settings_.film = film;
    settings_.path.replace_extension(film ? ".webp" : ".png");
  }
  name_ = settings_.path.string();
  message_.clear();
  confirming_ = false;
  open_ = opening_ = true;
}

void ExportDialog::again(const Path& folder) {
  if (!last_) return ask(false, folder);
  ExportSettings repeated = *last_;
  const int last = last_frame_of(workspace_.document.scene());
  repeated.last = last_all_ ? last : std::min(repeated.last, last);
  repeated.first = std::min(repeated.first, repeated.last);
  workspace_.messages.complain(start(repeated));
}

/// The part of the plane to export, or none if that depends on the maps.
std::optional<Box> ExportDialog::region_box() const {
  if (settings_.region == ExportSettings::Region::canvas) {
    const Viewport& view = workspace_.display.viewport;
    Box box;
    box.include(view.plane_at_px({view.left, view.top}));
    box.include(view.plane_at_px({view.left + view.width, view.top + view.height}));
    return box;
  }
  if (settings_.region != ExportSettings::Region::picture) return {};
  const Document& document = workspace_.document;
  const Box box = PictureMaker(document.scene(), document.image(), document.pictures()).rectangle();
  return box.empty() ? std::nullopt : std::optional(box);
}

std::string ExportDialog::result_text() const {
  const std::optional<Box> box = region_box();
  const Box shown = box ? *box : content_box(workspace_);
  char text[160];
  const int frames = settings_.last - settings_.first + 1;
  int used = std::snprintf(text, sizeof text, "%s%.0f x %.0f pixels",
                           box              ? ""
                           : settings_.film ? "At least "
                                            : "About ",
                           std::ceil(shown.width() * settings_.scale),
                           std::ceil(shown.height() * settings_.scale));
  if (settings_.film) {
    const double rate = workspace_.document.scene().animation.frames_per_second;
    std::snprintf(text + used, sizeof text - static_cast<size_t>(used),
                  ", %d frame%s, %.2f s at %.5g frames per second", frames, frames == 1 ? "" : "s",
                  frames / rate, rate);
  }
  std::string result = text;
  const Background& background =
      settings_.background ? *settings_.background : workspace_.document.scene().background;
  if (format_extension(settings_.path) == ".jpg" &&
      background.fill == Background::Fill::transparent)
    result += "; transparent parts become white";
  return result;
}

std::vector<Path> ExportDialog::files() const {
  return settings_.film ? files_of_film(settings_.path, settings_.last - settings_.first + 1)
                        : std::vector{settings_.path};
}

std::string ExportDialog::start(const ExportSettings& settings) {
  settings_ = settings;
  const Document& document = workspace_.document;
  try {
    if (settings.film)
      film_format_of(settings.path);
    else
      picture_format_of(settings.path);
    for (const Path& file : files()) check_may_write(file, document.sources());
    if (const std::string problem = missing_picture_message(workspace_); !problem.empty())
      return problem;
  } catch (const Error& error) {
    return error.what();
  }
  Scene scene = document.scene();
  if (settings.background) scene.background = *settings.background;
  PictureOptions options = as_shown(workspace_);
  options.scale = settings.scale;
  options.region = region_box();
  struct Work {
    Scene scene;
    Pictures pictures;
    ExportSettings settings;
    PictureOptions options;
    std::string done;
  };
  const auto work =
      std::make_shared<Work>(Work{std::move(scene), document.pictures(), settings, options, ""});
  const auto export_it = [work](Job::Progress& progress) {
    const Scene& scene = work->scene;
    const Pictures& pictures = work->pictures;
    const ExportSettings& settings = work->settings;
    const PictureOptions& options = work->options;
    const Image* image = pictures.of(scene.layer());
    const std::string name = settings.path.filename().string();
    if (settings.film) {
      FilmOptions film{options, settings.first, settings.last, settings.loops};
      write_film(
          settings.path, scene, image, film,
          [&](int done, int all) { return progress.at(done, all); }, pictures);
      work->done = "Exported " + name + ", " + std::to_string(settings.last - settings.first + 1) +
                   " frames.";
      return;
    }
    const RasterResult result = picture_of(scene, image, options, pictures);
    if (progress.cancelled()) return;
    const std::string bytes = picture_format_of(settings.path).encode(result.image);
    if (progress.cancelled()) return;
    write_file(settings.path, bytes);
    work->done = "Exported " + name + ", " + std::to_string(result.image.width) + " x " +
                 std::to_string(result.image.height) + " pixels.";
  };
  return jobs_.run("Exporting " + settings.path.filename().string(), export_it, [this, work] {
    last_ = work->settings;
    last_all_ = work->settings.last == last_frame_of(workspace_.document.scene());
    workspace_.messages.say(work->done);
  });
}

Path ExportDialog::in_folder(const Path& path) const {
  return path.is_relative() ? folder_ / path : path;
}

/// The extensions of all formats. The chosen format's comes first, because it is added to names
/// without an extension.
std::vector<std::string> ExportDialog::extensions() const {
  std::vector<std::string> all{format_extension(settings_.path)};
  for (const Format& format : formats(plays(workspace_.document.scene())))
    if (std::ranges::find(all, format.extension) == all.end()) all.push_back(format.extension);
  return all;
}

/// Sets the path and, from its extension, the format. If pictures and films share the extension,
/// the current choice between them is kept. Returns false if the extension is unknown.
bool ExportDialog::take_path(const Path& path) {
  const std::vector<Format> known = formats(plays(workspace_.document.scene()));
  const std::string extension = format_extension(path);
  const auto is_same = [&](const Format& format) {
    return format.extension == extension && format.film == settings_.film;
  };
  const auto other = std::ranges::find(known, extension, &Format::extension);
  if (other == known.end()) return false;
  if (std::ranges::none_of(known, is_same)) settings_.film = other->film;
  settings_.path = path;
  return true;
}

void ExportDialog::accept() {
  opening_ = true;  // returns the focus to the name if the dialog stays open
  if (name_.empty()) return;
  Path path = in_folder(name_);
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    message_ = path.string() + " is a folder. Add a file name.";
    return;
  }
  if (!std::filesystem::is_directory(path.parent_path(), error)) {
    message_ = "There is no folder " + path.parent_path().string() + ".";
    return;
  }
  const std::vector<std::string> written = extensions();
  if (!is_known_extension(format_extension(path))) path += settings_.path.extension();
  if (!take_path(path)) {
    message_ = path.extension().string() + " is not a supported format. Choose one of";
    for (const std::string& extension : written) message_ += " " + extension;
    return;
  }
  name_ = path.string();
  if (!confirming_) {
    std::vector<Path> there = files();
    std::erase_if(there, [&](const Path& file) { return !std::filesystem::exists(file, error); });
    if (!there.empty()) {
      confirming_ = true;
      message_ = there[0].filename().string() +
                 (there.size() == 1 ? " already exists. Press Enter or Replace to overwrite it."
                                    : " and " + std::to_string(there.size() - 1) +
                                          " more files already exist. Press Enter or Replace to "
                                          "overwrite them.");
      return;
    }
  }
  confirming_ = false;
  message_ = start(settings_);
  open_ = !message_.empty();
}

void ExportDialog::draw_file(double scale) {
  const float s = static_cast<float>(scale);
  if (std::exchange(opening_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-110 * s);
  const bool entered = ImGui::InputTextWithHint(
      "##name", "File", &name_,
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemEdited()) {
    confirming_ = false;
    take_path(in_folder(name_));  // updates the chosen format
  }
  ImGui::SameLine();
  if (ImGui::Button("Choose...", {-1, 0})) {
    chooser_.ask(
        {FileQuestion::Mode::save, "Export to", "Choose", extensions(), Path(name_), false},
        [this](const Path& path, double) {
          name_ = path.string();
          take_path(path);
          confirming_ = files() == std::vector{path};  // the chooser has already asked about it
          return std::string();
        });
  }
  if (entered) accept();
}

void ExportDialog::draw_format(float s) {
  std::string preview = settings_.path.extension().string();
  const std::vector<Format> known = formats(plays(workspace_.document.scene()));
  for (const Format& format : known)
    if (uses_format(settings_, format)) preview = format.label;
  ImGui::SetNextItemWidth(300 * s);
  if (!ImGui::BeginCombo("Format", preview.c_str())) return;
  for (const Format& format : known)
    if (ImGui::Selectable(format.label.c_str(), uses_format(settings_, format))) {
      settings_.film = format.film;
      settings_.path = Path(name_).replace_extension(format.extension);
      name_ = settings_.path.string();
      confirming_ = false;
    }
  ImGui::EndCombo();
}

void ExportDialog::draw_look(float s) {
  float percent = static_cast<float>(100 * settings_.scale);
  ImGui::SetNextItemWidth(300 * s);
  if (ImGui::SliderFloat("Scale", &percent, 10, 400, "%.0f %%",
                         ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
    settings_.scale = std::round(percent) / 100;
  int region = static_cast<int>(settings_.region);
  ImGui::SetNextItemWidth(300 * s);
  if (ImGui::Combo("Region", &region, kRegions, 3))
    settings_.region = static_cast<ExportSettings::Region>(region);
  int background = settings_.background ? 1 + static_cast<int>(settings_.background->fill) : 0;
  ImGui::SetNextItemWidth(300 * s);
  if (ImGui::Combo("Background", &background,
                   "As in the scene\0Transparent\0Color\0Original picture\0")) {
    if (background == 0)
      settings_.background.reset();
    else
      settings_.background = {
          static_cast<Background::Fill>(background - 1),
          settings_.background ? settings_.background->color : Background{}.color};
  }
  if (!settings_.background || settings_.background->fill != Background::Fill::color) return;
  float color[3];
  for (size_t k = 0; k < 3; ++k)
    color[k] = static_cast<float>(settings_.background->color[k]) / 255;
  ImGui::SetNextItemWidth(300 * s);
  if (ImGui::ColorEdit3("Color", color, ImGuiColorEditFlags_DisplayHex))
    for (size_t k = 0; k < 3; ++k)
      settings_.background->color[k] =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[k], 0.0f, 1.0f)));
}

void ExportDialog::draw_frames(float s) {
  const int last = last_frame_of(workspace_.document.scene());
  int range[2] = {settings_.first, settings_.last};
  ImGui::SetNextItemWidth(300 * s);
  if (ImGui::DragIntRange2("Frames", &range[0], &range[1], 0.2f, 0, last, "from %d", "to %d",
                           ImGuiSliderFlags_AlwaysClamp)) {
    confirming_ = false;
    settings_.first = std::clamp(range[0], 0, last);
    settings_.last = std::clamp(range[1], settings_.first, last);
  }
  ImGui::Checkbox("Loop", &settings_.loops);
}

void ExportDialog::draw(double scale) {
  if (!open_ || chooser_.open()) return;  // hidden while a file is being chosen
  const float s = static_cast<float>(scale);
  ImGui::OpenPopup("Export###export");
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(620 * s, display.x - 20), 0});
  if (!ImGui::BeginPopupModal("Export###export", nullptr,
                              ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
    return;
  draw_file(scale);
  draw_format(s);
  draw_look(s);
  if (settings_.film) draw_frames(s);
  ImGui::Dummy({0, 4 * s});
  wrapped_text(message_.empty() ? result_text() : message_);
  ImGui::Dummy({0, 4 * s});
  if (ImGui::Button(confirming_ && !message_.empty() ? "Replace" : "Export", {120 * s, 0}))
    accept();
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {120 * s, 0}) || escape_pressed()) open_ = false;
  if (!open_ || chooser_.open()) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace holomorph
