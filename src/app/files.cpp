// Whatever would lose unsaved work goes through ask_then.
#include "app/files.h"

#include <imgui.h>

#include <utility>

#include "app/clipboard.h"
#include "app/panels.h"
#include "core/error.h"
#include "edit/keymap.h"
#include "edit/tool.h"
#include "raster/picture.h"
#include "raster/textured.h"
#include "scene/export.h"
#include "scene/outline_import.h"
#include "scene/svg_path.h"

namespace holomorph {
Files::Files(Workspace& workspace, Preferences& preferences, std::function<void()> replaced,
             const std::function<void()>& wake)
    : workspace_(workspace),
      preferences_(preferences),
      replaced_(std::move(replaced)),
      jobs_(workspace, wake),
      dialog_(wake),
      export_(workspace, jobs_, dialog_),
      imports_(
          workspace, jobs_, dialog_, [this](const Path& path) { keep_recent(path); }, replaced_),
      watch_(workspace),
      recoverable_(holomorph::recoverable(autosave_folder())) {}

void Files::ask_then(Then then) {
  if (!workspace_.document.modified()) return then();
  after_question_ = std::move(then);
  question_ = true;
}

void Files::adopt(Document document) {
  workspace_.document.remove_autosave(autosave_folder());
  workspace_.open(std::move(document));
  export_.forget();
  dropped_.reset();
  watch_.forget();
  replaced_();
}

std::string Files::open(const Path& path) {
  const auto opened = std::make_shared<std::optional<Document>>();
  const std::string problem = jobs_.run(
      "Opening " + path.filename().string(),
      [opened, path](Job::Progress&) { *opened = Document::open(path); },
      [this, opened, path] {
        adopt(std::move(**opened));
        dialog_.start_in(std::filesystem::absolute(path).parent_path());
        keep_recent(path);
      });
  if (!problem.empty() && !is_there(path) && std::erase(preferences_.recent, path) > 0)
    keep_preferences();
  return problem;
}

void Files::ask_open(const Path& path) {
  ask_then([this, path] { workspace_.complain(open(path)); });
}

void Files::drop(const Path& path) {
  const std::string kind = lower_case(path.extension().string());
  const Document& document = workspace_.document;
  if ((kind == ".obj" || kind == ".svg") && document.scene().has_cage())
    workspace_.complain(imports_.outline(path));
  else if (kind == ".svg" && document.image())
    workspace_.complain(imports_.svg(path, false));
  else if (kind == ".obj" && document.image())
    workspace_.complain(
        path.filename().string() +
        ": the picture needs a cage before it can go onto a surface. Make one and drop the "
        "surface again");
  else if (document.empty() || document.path() == path)
    ask_open(path);
  else
    dropped_ = path;
}

void Files::copy_picture() {
  if (const std::string problem = lacking(workspace_); !problem.empty())
    return workspace_.complain(problem);
  const Document& document = workspace_.document;
  const auto copy = [scene = document.scene(), pictures = document.pictures(),
                     options = as_shown(workspace_)](Job::Progress& progress) {
    const RasterResult result = picture_of(scene, pictures.of(scene), options, pictures);
    if (!progress.cancelled())
      put_on_clipboard(encode_png(result.image), [&] { return !progress.cancelled(); });
  };
  workspace_.complain(jobs_.run("Copying the picture", copy,
                                [this] { workspace_.say("The picture is on the clipboard."); }));
}

Path Files::beside_document(const std::string& name) const {
  const Path& document = workspace_.document.path();
  return (document.empty() ? dialog_.folder() : document.parent_path()) / name;
}

void Files::ask_sample(const Path& scene) {
  ask_then([this, scene] {
    const auto opened = std::make_shared<std::optional<Document>>();
    workspace_.complain(jobs_.run(
        "Opening " + scene.filename().string(),
        [opened, scene](Job::Progress&) { *opened = Document::copy_of(scene); },
        [this, opened] { adopt(std::move(**opened)); }));
  });
}

void Files::ask_recover(const Path& autosave) {
  ask_then([this, autosave] { recover(autosave); });
}

void Files::recover(const Path& autosave) {
  const auto recovered = std::make_shared<std::optional<Document>>();
  workspace_.complain(jobs_.run(
      "Recovering",
      [recovered, autosave](Job::Progress&) { *recovered = Document::recover(autosave); },
      [this, recovered, autosave] {
        adopt(std::move(**recovered));
        if (!workspace_.document.autosave(autosave_folder())) return;
        discard(autosave);  // the document has written its own
        workspace_.say("Recovered. Save it under a name to keep it.");
      }));
}

void Files::discard(const Path& autosave) {
  holomorph::discard(autosave);
  std::erase_if(recoverable_, [&](const Recovery& r) { return r.path == autosave; });
}

std::string Files::save_to(const Path& path, const Then& then) {
  try {
    workspace_.document.save(path);
    workspace_.document.remove_autosave(autosave_folder());
    keep_recent(workspace_.document.path());
    workspace_.say("Saved " + path.filename().string() + ".");
  } catch (const Error& error) {
    return error.what();
  }
  if (then) then();
  return "";
}

void Files::save(bool as, const Then& then) {
  const Document& document = workspace_.document;
  if (!as && !document.path().empty()) return workspace_.complain(save_to(document.path(), then));
  Path start = document.path();
  if (start.empty() && !document.first_picture().empty())
    start = beside_document(document.first_picture().stem().string() + ".json");
  if (start.empty()) start = "scene.json";
  dialog_.ask(
      {FileQuestion::Mode::save, "Save the scene", "Save", {".json", ".holomorph"}, start, false},
      [this, then](const Path& path, double) { return save_to(path, then); });
}

void Files::ask_export_svg() {
  const Document& document = workspace_.document;
  const Path& source = document.path().empty() ? document.image_path() : document.path();
  const Path start = beside_document((source.empty() ? "cage" : source.stem().string()) + ".svg");
  dialog_.ask({FileQuestion::Mode::save, "Export the cage", "Export", {".svg"}, start, false},
              [this](const Path& path, double) -> std::string {
                try {
                  check_may_write(path, workspace_.document.sources());
                  write_file(path, svg_of(workspace_.unedited()));
                  workspace_.say("Exported " + path.filename().string() + ".");
                } catch (const Error& error) {
                  return error.what();
                }
                return "";
              });
}

std::string Files::export_surface(const Path& path, double scale) {
  try {
    const Document& document = workspace_.document;
    const Scene& scene = document.scene();
    const LaidSurface surface = laid_surface_of(scene);
    for (const Path& file : files_of_textured(path)) check_may_write(file, document.sources());
    write_textured(path, surface, textured(surface, scene, document.image(), scale));
    workspace_.say("Exported " + path.filename().string() + " with its material and picture.");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void Files::ask_export_surface() {
  const Document& document = workspace_.document;
  const Path& source = document.path().empty() ? document.image_path() : document.path();
  const Path start = beside_document(source.stem().string() + "-" +
                                     Path(document.scene().surface->file).stem().string() + ".obj");
  dialog_.ask({FileQuestion::Mode::save,
               "Export the surface with the picture on it",
               "Export",
               {".obj"},
               start,
               true},
              [this](const Path& path, double scale) { return export_surface(path, scale); });
}

void Files::autosave() {
  if (workspace_.document.autosave(autosave_folder())) return;
  if (!std::exchange(autosave_failed_, true))
    workspace_.complain(Error(
        ErrorKind::failed,
        autosave_folder().empty()
            ? "Autosave is off: this user has no home folder"
            : "Autosave does not work: nothing can be written to " + autosave_folder().string()));
}

void Files::keep_recent(const Path& path) {
  remember(preferences_, std::filesystem::absolute(path).lexically_normal());
  keep_preferences();
}

void Files::keep_preferences() {
  try {
    save_preferences(preferences_);
  } catch (const Error& error) {
    workspace_.complain(error);
  }
}

void Files::answer(Request request) {
  switch (request) {
    case Request::new_scene:
      ask_then([this] {
        recoverable_ = holomorph::recoverable(autosave_folder());
        adopt(Document());
      });
      break;
    case Request::open:
      ask_then([this] {
        dialog_.ask_open("Open a picture or a scene", "Open",
                         and_pictures({".json", ".holomorph", ".obj"}),
                         [this](const Path& path) { return open(path); });
      });
      break;
    case Request::save:
      save(false);
      break;
    case Request::save_as:
      save(true);
      break;
    case Request::export_picture:
      export_.ask(false, folder());
      break;
    case Request::export_again:
      export_.again(folder());
      break;
    case Request::copy_picture:
      copy_picture();
      break;
    case Request::export_svg:
      ask_export_svg();
      break;
    case Request::export_film:
      export_.ask(true, folder());
      break;
    case Request::export_surface:
      ask_export_surface();
      break;
    case Request::quit:
      ask_then([this] {
        workspace_.document.remove_autosave(autosave_folder());
        quit_ = true;
      });
      break;
    case Request::import_cage:
    case Request::import_pose:
    case Request::import_outline:
    case Request::add_layer:
    case Request::replace_picture:
    case Request::find_picture:
    case Request::paste_picture:
      imports_.answer(request);
      break;
    case Request::none:
    case Request::help:
    case Request::palette:
    case Request::menu:
    case Request::next_panel:
    case Request::rename_layer:
    case Request::context_menu:
    case Request::compare:
      break;
  }
}

void Files::draw(double scale) {
  dialog_.draw(scale);
  draw_question(scale);
  draw_drop_question(scale);
  export_.draw(scale);
  jobs_.draw(scale);
}

void Files::draw_drop_question(double scale) {
  if (!dropped_) return;
  ImGui::OpenPopup("A dropped picture");
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal("A dropped picture", nullptr,
                              ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
    return;
  const Path path = *dropped_;
  ImGui::TextUnformatted(path.filename().c_str());
  ImGui::Dummy({0, 6});
  const ImVec2 size(330 * static_cast<float>(scale), 0);
  bool decided = false;
  const auto choice = [&](const char* label, auto act) {
    if (!ImGui::Button(label, size)) return;
    decided = true;
    act();
  };
  choice("Add it as a layer", [&] { workspace_.complain(imports_.add_layer(path)); });
  if (!is_scene_name(path))
    choice("Put it in place of this layer's picture",
           [&] { workspace_.complain(imports_.replace_picture(path)); });
  choice("Open it instead", [&] { ask_open(path); });
  choice("Cancel", [] {});
  if (decided || escape_pressed()) {
    dropped_.reset();
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

void Files::draw_question(double scale) {
  if (question_) ImGui::OpenPopup("Unsaved changes");
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal("Unsaved changes", nullptr,
                              ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
    return;
  ImGui::TextUnformatted("There are changes that are not saved.");
  ImGui::Dummy({0, 6});
  const float width = 130 * static_cast<float>(scale);
  const auto close = [&] {
    question_ = false;
    ImGui::CloseCurrentPopup();
  };
  if (ImGui::Button("Save", {width, 0}) ||
      (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter)) && !ImGui::IsAnyItemFocused())) {
    close();
    save(false, std::exchange(after_question_, {}));
  }
  ImGui::SameLine();
  if (ImGui::Button("Do not save", {width, 0})) {
    close();
    if (const auto then = std::exchange(after_question_, {})) then();
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {width, 0}) || escape_pressed()) {
    close();
    after_question_ = {};
  }
  ImGui::EndPopup();
}

}  // namespace holomorph
