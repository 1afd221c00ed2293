// The settings are kept from one export of a document to the next.
#include "app/dialogs/export_dialog.h"

#include <imgui.h>

#include <cctype>

#include <algorithm>
#include <utility>

#include "app/look/controls.h"
#include "app/look/numbers.h"
#include "app/look/surfaces.h"
#include "app/panels/panels.h"
#include "edit/content.h"
#include "exports/export_formats.h"
#include "scene/clips.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/layered.h"
#include "system/process.h"

namespace holomorph {
namespace {

constexpr const char* kRegions[] = {"Everything", "The picture's rectangle",
                                    "What the canvas shows"};

bool uses_format(const ExportSettings& settings, const ExportChoice& format) {
  return settings.kind == format.kind && format_extension(settings.path) == format.extension &&
         (format.kind != ExportKind::meshes || settings.meshes == format.meshes);
}

}  // namespace

PictureOptions as_shown(const Workspace& workspace) {
  PictureOptions options;
  options.view = workspace.shown.own().has_cage() ? workspace.display.view : View::image;
  options.automatic_range = workspace.display.automatic_range;
  options.time = workspace.shown.time_of_layers();
  return options;
}

std::string missing_picture_message(const Workspace& workspace, ExportKind kind) {
  const Document& document = workspace.document;
  if (is_drawn(kind) && as_shown(workspace).view != View::image) return "";
  for (const size_t i : document.layers_without_picture()) {
    const Layer& layer = *document.scene().layers[i];
    if (is_st_map(kind) ? i == document.scene().edited : layer.visible)
      return Path(layer.image->file).filename().string() +
             (document.pictures().withheld().contains(layer.image->file)
                  ? " is not in the scene's folder. Press Show it, or hide its layer."
                  : " could not be read. Press Find it, or hide its layer.");
  }
  return "";
}

void ExportDialog::ask(std::optional<ExportKind> asked, const Path& folder) {
  const Document& document = workspace_.document;
  // A scene that has begun to move since the last export is proposed as a film.
  const bool moves = plays(document.scene());
  const ExportKind usual = moves ? ExportKind::film : ExportKind::picture;
  const ExportKind kind = asked.value_or(last_ && last_moved_ == moves ? last_->kind : usual);
  const bool keeps_sound =
      has_sound(document.scene(), document.pictures()) && has_program("ffmpeg");
  // Drawings stay drawings, and OpenEXR pictures keep their bright colors.
  const std::string source_kind = format_extension(document.first_picture());
  const bool is_kept = source_kind == ".svg" || source_kind == ".exr";
  const auto extension_of = [&](ExportKind kind) -> std::string {
    if (kind == ExportKind::film) return keeps_sound ? ".mp4" : ".webp";
    return is_kept ? source_kind : ".png";
  };
  folder_ = folder;
  if (last_) {
    settings_ = *last_;
    folder_ = settings_.path.parent_path();
  } else {
    const Path source = document.path().empty() ? document.first_picture() : document.path();
    const std::string stem = source.empty() ? "picture" : source.stem().string();
    settings_ = {};
    settings_.kind = kind;
    // Neither a picture nor a film must replace its source.
    const bool is_source = kind != ExportKind::film || has_clips(document.scene());
    settings_.path = folder / (stem + (is_source ? "-bent" : "") + extension_of(kind));
  }
  const int last = last_frame_of(document.scene());
  const bool had_all = !last_ || last_all_;
  settings_.last = had_all ? last : std::clamp(settings_.last, 0, last);
  settings_.first = std::clamp(settings_.first, 0, settings_.last);
  const auto is_chosen = [&](const ExportChoice& format) { return uses_format(settings_, format); };
  if (kind != settings_.kind || std::ranges::none_of(export_choices(document.scene()), is_chosen)) {
    settings_.kind = kind == ExportKind::film ? kind : ExportKind::picture;
    settings_.path.replace_extension(extension_of(settings_.kind));
  }
  name_ = settings_.path.string();
  message_.clear();
  confirming_ = false;
  open_ = opening_ = true;
}

void ExportDialog::again(const Path& folder) {
  const auto is_last = [&](const ExportChoice& format) { return uses_format(*last_, format); };
  if (!last_ || std::ranges::none_of(export_choices(workspace_.document.scene()), is_last))
    return ask({}, folder);
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

int ExportDialog::frames() const {
  return frames_of_film(workspace_.document.scene(), settings_.first, settings_.last,
                        settings_.loops);
}

std::pair<Scene, PictureOptions> ExportDialog::drawn() const {
  Scene scene = workspace_.document.scene();
  if (settings_.background) scene.background = *settings_.background;
  PictureOptions options = as_shown(workspace_);
  options.scale = settings_.scale;
  options.region = region_box();
  options.crops_to_filled = settings_.crops_to_filled;
  return {std::move(scene), options};
}

std::string ExportDialog::st_map_text() const {
  const Image* picture = workspace_.document.image();
  if (!picture) return "The edited layer has no picture";
  const auto side = [&](double length) {
    return std::to_string(std::lround(length * settings_.scale) + 2 * settings_.overscan);
  };
  const std::string size =
      side(picture->page().width()) + " \u00d7 " + side(picture->page().height()) + " px";
  const size_t count = files().size();
  if (count > 1) return std::to_string(count) + " files, " + size;
  return size + (workspace_.shown.time_of_layers() ? ", at the current time only" : "");
}

std::string ExportDialog::result_text() const {
  const bool film = settings_.kind == ExportKind::film;
  if (settings_.kind == ExportKind::meshes) {
    const std::string measured = estimate_.text();
    return measured.empty() ? "Measuring..." : measured;
  }
  if (is_st_map(settings_.kind)) return st_map_text();
  const std::optional<Box> box = region_box();
  const Box shown = box ? *box : content_box(workspace_);
  const bool crops = settings_.crops_to_filled;
  std::string text;
  char part[120];
  if (film) {
    const double rate = workspace_.document.scene().animation.frames_per_second;
    const int count = frames();
    std::snprintf(part, sizeof part, "%d frame%s, %.2f s, ", count, count == 1 ? "" : "s",
                  count / rate);
    text += part;
  }
  std::snprintf(part, sizeof part, "%s%.0f \u00d7 %.0f px",
                crops  ? "at most "
                : box  ? ""
                : film ? "at least "
                       : "about ",
                std::ceil(shown.width() * settings_.scale),
                std::ceil(shown.height() * settings_.scale));
  text += part;
  if (const std::string size = estimate_.text(); !size.empty()) text += ", about " + size;
  const Background& background =
      settings_.background ? *settings_.background : workspace_.document.scene().background;
  if (format_extension(settings_.path) == ".jpg" &&
      background.fill == Background::Fill::transparent)
    text += "; transparent parts become white";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::vector<Path> ExportDialog::files() const {
  if (settings_.kind == ExportKind::film) return files_of_film(settings_.path, frames());
  const Document& document = workspace_.document;
  if (is_st_map(settings_.kind) && settings_.all_frames && moves(document.scene())) {
    std::vector<Path> all;
    for (int i = settings_.first; i <= settings_.last; ++i)
      all.push_back(numbered(settings_.path, i));
    return all;
  }
  if (settings_.kind != ExportKind::meshes) return {settings_.path};
  return mesh_file_names(document.scene(), document.pictures(),
                         mesh_export_of(settings_, document.scene()));
}

std::string ExportDialog::start(const ExportSettings& settings) {
  settings_ = settings;
  const Document& document = workspace_.document;
  try {
    if (settings.kind == ExportKind::film)
      film_format_of(settings.path);
    else if (settings.kind == ExportKind::picture && !layered_format_of(settings.path))
      picture_format_of(settings.path);
    const Sources sources = document.sources();
    for (const Path& file : files()) check_may_write(file, sources);
    if (const std::string problem = missing_picture_message(workspace_, settings.kind);
        !problem.empty())
      return problem;
  } catch (const Error& error) {
    return error.what();
  }
  auto [scene, options] = drawn();
  struct Work {
    ExportWork work;
    std::string done;
  };
  const auto it =
      std::make_shared<Work>(Work{{std::move(scene), document.pictures(), settings, options}, ""});
  const auto export_it = [it](Job::Progress& progress) {
    it->done = done_export(it->work, progress);
  };
  return jobs_.run("Exporting " + settings.path.filename().string(), export_it, [this, it] {
    last_ = it->work.settings;
    last_all_ = last_->last == last_frame_of(workspace_.document.scene());
    last_moved_ = plays(workspace_.document.scene());
    workspace_.messages.say(it->done);
  });
}

Path ExportDialog::in_folder(const Path& path) const {
  return path.is_relative() ? folder_ / path : path;
}

/// The extensions of all formats. The chosen format's comes first, because it is added to names
/// without an extension.
std::vector<std::string> ExportDialog::extensions() const {
  std::vector<std::string> all{format_extension(settings_.path)};
  for (const ExportChoice& format : export_choices(workspace_.document.scene()))
    if (std::ranges::find(all, format.extension) == all.end()) all.push_back(format.extension);
  return all;
}

/// Sets the path and, from its extension, the format. If several kinds of files have the extension,
/// the current choice between them is kept. Returns false if the extension is unknown.
bool ExportDialog::take_path(const Path& path) {
  const std::vector<ExportChoice> known = export_choices(workspace_.document.scene());
  const std::string extension = format_extension(path);
  const auto is_same = [&](const ExportChoice& format) {
    return format.extension == extension && format.kind == settings_.kind;
  };
  const auto other = std::ranges::find(known, extension, &ExportChoice::extension);
  if (other == known.end()) return false;
  if (std::ranges::none_of(known, is_same)) settings_.kind = other->kind;
  settings_.path = path;
  const auto is_chosen = [&](const ExportChoice& format) { return uses_format(settings_, format); };
  if (std::ranges::none_of(known, is_chosen))
    settings_.meshes = std::ranges::find_if(known, is_same)->meshes;
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
  try {
    const Sources sources = workspace_.document.sources();
    for (const Path& file : files()) check_may_write(file, sources);
  } catch (const Error& problem) {
    message_ = problem.what();
    return;
  }
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

void ExportDialog::draw_file() {
  if (std::exchange(opening_, false)) ImGui::SetKeyboardFocusHere();
  row_label("File");
  const float choose = px(96);
  const bool entered =
      text_field("##name", name_, "File", ImGui::GetContentRegionAvail().x - choose - px(8),
                 ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemEdited()) {
    confirming_ = false;
    take_path(in_folder(name_));  // updates the chosen format
  }
  ImGui::SameLine(0, px(8));
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() - px(2));
  if (button("Choose...", ButtonKind::secondary, choose)) {
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

void ExportDialog::draw_format() {
  std::string preview = format_extension(settings_.path);
  const std::vector<ExportChoice> known = export_choices(workspace_.document.scene());
  for (const ExportChoice& format : known)
    if (uses_format(settings_, format)) preview = format.label;
  row_label("Format");
  if (!begin_dropdown("##Format", preview)) return;
  for (const ExportChoice& format : known)
    if (dropdown_row(format.label, uses_format(settings_, format))) {
      settings_.kind = format.kind;
      settings_.meshes = format.meshes;
      // A skeleton has the extension of scenes, so its name differs.
      const std::string skeleton = "-spine";
      std::string stem = Path(name_).stem().string();
      if (stem.ends_with(skeleton)) stem.resize(stem.size() - skeleton.size());
      if (format.extension == ".json") stem += skeleton;
      settings_.path = Path(name_).replace_filename(stem + format.extension);
      name_ = settings_.path.string();
      confirming_ = false;
    }
  end_dropdown();
}

void ExportDialog::draw_scale() {
  double percent = 100 * settings_.scale;
  if (slider_row("Scale", percent,
                 {.low = 10, .high = 400, .unit = "%", .logarithmic = true, .neutral = 100.0}))
    settings_.scale = std::round(percent) / 100;
}

/// The bits per color, if there is a choice.
void ExportDialog::draw_depth() {
  const PictureFormat* format = picture_format_named(format_extension(settings_.path));
  if (settings_.kind != ExportKind::picture || !format || format->depths.size() < 2) return;
  const int depth = depth_of(*format, settings_.depth);
  const auto text = [](int bits) { return std::to_string(bits) + " bits per color"; };
  row_label("Depth");
  if (!begin_dropdown("##Depth", text(depth))) return;
  for (const int each : format->depths)
    if (dropdown_row(text(each), each == depth)) settings_.depth = each;
  end_dropdown();
}

void ExportDialog::draw_look() {
  draw_depth();
  draw_scale();
  row_label("Region");
  const auto region = static_cast<size_t>(settings_.region);
  if (begin_dropdown("##Region", kRegions[region])) {
    for (size_t i = 0; i < std::size(kRegions); ++i)
      if (dropdown_row(kRegions[i], i == region))
        settings_.region = static_cast<ExportSettings::Region>(i);
    end_dropdown();
  }
  static constexpr const char* kBackgrounds[] = {"As in the scene", "Transparent", "Color",
                                                 "The original"};
  const size_t background =
      settings_.background ? 1 + static_cast<size_t>(settings_.background->fill) : 0;
  row_label("Background");
  if (begin_dropdown("##Background", kBackgrounds[background])) {
    for (size_t i = 0; i < std::size(kBackgrounds); ++i)
      if (dropdown_row(kBackgrounds[i], i == background)) {
        if (i == 0)
          settings_.background.reset();
        else
          settings_.background = {
              static_cast<Background::Fill>(i - 1),
              settings_.background ? settings_.background->color : Background{}.color};
      }
    end_dropdown();
  }
  if (settings_.background && settings_.background->fill == Background::Fill::color) {
    row_label("Color");
    color_field("##Color", settings_.background->color, ImGui::GetContentRegionAvail().x);
  }
  row_label("");
  check_box("Crop to filled area", settings_.crops_to_filled);
}

void ExportDialog::draw_frames() {
  const int last = last_frame_of(workspace_.document.scene());
  row_label("Frames");
  const float gap = px(8), width = std::floor((ImGui::GetContentRegionAvail().x - gap) / 2);
  const Number number{.low = 0, .high = static_cast<double>(std::max(last, 1)), .speed = 0.2};
  double from = settings_.first, to = settings_.last;
  const Change first = number_field("##First", from, number, width, "From");
  ImGui::SameLine(0, gap);
  const Change final = number_field("##Last", to, number, width, "To");
  if (first || final) {
    confirming_ = false;
    settings_.first = std::clamp(static_cast<int>(std::lround(from)), 0, last);
    settings_.last = std::clamp(static_cast<int>(std::lround(to)), settings_.first, last);
  }
  if (settings_.kind != ExportKind::film) return;
  const Document& document = workspace_.document;
  if (film_format_of(settings_.path).can_have_sound &&
      has_sound(document.scene(), document.pictures()) &&
      switch_row("Sound", settings_.keeps_sound, "Keep the sound of films that are pictures"))
    settings_.keeps_sound = !settings_.keeps_sound;
  if (switch_row("Loop", settings_.loops)) settings_.loops = !settings_.loops;
  if (settings_.loops && frames() < settings_.last - settings_.first + 1) {
    ImGui::SameLine(0, px(12));
    ImGui::AlignTextToFramePadding();
    muted_text("Frame " + std::to_string(settings_.last) + " equals frame " +
               std::to_string(settings_.first) + " and is left out");
  }
}

void ExportDialog::draw_meshes() {
  const Scene& scene = workspace_.document.scene();
  const std::string format = mesh_export_of(settings_, scene).format;
  const bool all_layers = export_format_named(format).all_layers;
  bool own = all_layers ? settings_.full_mesh : !settings_.vertices;
  bool fewest = !settings_.vertices && !settings_.full_mesh;
  row_label("Vertices");
  if (all_layers) {
    if (check_box("Fewest vertices", fewest)) {
      settings_.full_mesh = !fewest;
      settings_.vertices.reset();
    }
    ImGui::SameLine(0, px(16));
  }
  if (check_box("Full mesh", own)) {
    settings_.full_mesh = own && all_layers;
    settings_.vertices = own ? std::nullopt : std::optional<size_t>(500);
  }
  if (settings_.vertices) {
    double vertices = static_cast<double>(*settings_.vertices);
    if (slider_row("Per layer", vertices, {.low = 30, .high = 5000, .logarithmic = true}))
      settings_.vertices = static_cast<size_t>(std::lround(vertices));
  }
  if (!moves(scene)) return;
  draw_frames();
  if (!all_layers) return;
  const double usual = scene.animation.frames_per_second;
  row_label("Rate");
  bool chosen = !settings_.rate;
  if (check_box("Fewest frames", chosen))
    settings_.rate = chosen ? std::nullopt : std::optional(usual);
  if (!settings_.rate) return;
  double rate = *settings_.rate;
  if (slider_row("Per second", rate, {.low = 1, .high = 120, .unit = "/s", .neutral = usual}))
    settings_.rate = std::round(rate);
}

void ExportDialog::draw_st_map() {
  draw_scale();
  double overscan = settings_.overscan;
  if (slider_row("Overscan", overscan, {.low = 0, .high = 1000, .unit = "px", .neutral = 0.0}))
    settings_.overscan = static_cast<int>(std::lround(overscan));
  row_label("");
  check_box("Half precision", settings_.half);
  if (!moves(workspace_.document.scene())) return;
  row_label("");
  if (check_box("All frames", settings_.all_frames)) confirming_ = false;
  if (settings_.all_frames) draw_frames();
}

ExportEstimate::Question ExportDialog::question() const {
  if (settings_.kind == ExportKind::meshes) {
    const Scene& scene = workspace_.document.scene();
    return {.scene = scene, .extension = "", .meshes = mesh_export_of(settings_, scene)};
  }
  auto [scene, options] = drawn();
  const bool film = settings_.kind == ExportKind::film;
  return {.scene = std::move(scene),
          .options = options,
          .extension = format_extension(settings_.path),
          .depth = film ? std::nullopt : settings_.depth,
          .film = film,
          .first = settings_.first,
          .frames = film ? frames() : 1};
}

void ExportDialog::draw() {
  if (!open_ || chooser_.open()) {  // hidden while a file is being chosen
    choosing_ = open_;
    return estimate_.stop();
  }
  if (!begin_dialog("Export", "###export", 620)) return;
  {
    const ScopedLabelWidth wide(px(96));
    draw_file();
    draw_format();
    if (is_drawn(settings_.kind)) draw_look();
    if (settings_.kind == ExportKind::film) draw_frames();
    if (settings_.kind == ExportKind::meshes) draw_meshes();
    if (is_st_map(settings_.kind)) draw_st_map();
  }
  if (is_st_map(settings_.kind))
    estimate_.stop();
  else
    estimate_.update(question(), workspace_.document.pictures());
  if (message_.empty())
    caption(result_text());
  else
    wrapped_text(message_);
  const bool replaces = confirming_ && !message_.empty();
  const float width = px(112);
  begin_dialog_buttons(2 * width + px(8));
  // The key that closed the chooser is not for this dialog.
  const bool was_choosing = std::exchange(choosing_, false);
  const DialogKey key = was_choosing ? DialogKey::none : dialog_key();
  if (button("Cancel", ButtonKind::secondary, width) || key == DialogKey::escape) open_ = false;
  ImGui::SameLine(0, px(8));
  if (button(replaces ? "Replace" : "Export", replaces ? ButtonKind::danger : ButtonKind::primary,
             width) ||
      key == DialogKey::enter)
    accept();
  if (!open_ || chooser_.open()) ImGui::CloseCurrentPopup();
  end_dialog();
}

}  // namespace holomorph
