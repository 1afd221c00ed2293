// Every operation that would discard unsaved work goes through ask_about_changes_then.
#include "app/files.h"

#include <imgui.h>

#include <utility>

#include "core/error.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/svg_path.h"
#include "system/memory.h"
#include "system/new_file.h"
#include "system/text.h"

namespace holomorph {
namespace {

/// A path as printable text on one line, shortened if it is long.
std::string short_name(const Path& path) {
  constexpr size_t kMost = 120;
  std::string text = printable(path.string());
  std::ranges::replace(text, '\n', '?');
  return text.size() <= kMost ? text : "..." + text.substr(text.size() - kMost);
}

}  // namespace

Files::Files(Workspace& workspace, Preferences& preferences, std::function<void()> replaced,
             const std::function<void()>& wake, bool allow_outside)
    : workspace_(workspace),
      preferences_(preferences),
      replaced_(std::move(replaced)),
      allow_outside_(allow_outside),
      jobs_(workspace, wake),
      dialog_(wake),
      exports_(workspace, jobs_, dialog_, wake),
      imports_(
          workspace, jobs_, dialog_, [this] { return reach(); },
          [this](const Path& path) { keep_recent(path); },
          [this](const Path& path) { trust_folder_of(path); }, replaced_),
      watch_(workspace, [this](FoundLayers found) { ask_about_layers(std::move(found)); }),
      recoverable_(holomorph::recoverable(autosave_folder())) {}

void Files::trust_folder_of(const Path& path) {
  constexpr size_t kMost = 200;
  const Path folder = absolute_path(path).parent_path();
  std::vector<Path>& trusted = preferences_.trusted;
  if (std::ranges::find(trusted, folder) != trusted.end()) return;
  trusted.insert(trusted.begin(), folder);
  if (trusted.size() > kMost) trusted.resize(kMost);
  keep_preferences();
}

void Files::ask_about_changes_then(Then then) {
  if (!workspace_.document.modified()) return then();
  questions_.ask(
      {"Unsaved changes",
       "Save changes to \"" + short_name(workspace_.document.name()) + "\" before closing?",
       {{"Save", [this, then] { save(false, then); }},
        {"Don't save", then, true},
        {"Cancel", {}}}});
}

void Files::adopt(Document document) {
  workspace_.document.remove_autosave(autosave_folder());
  workspace_.open(std::move(document));
  exports_.forget();
  questions_.withdraw();
  layer_question_.withdraw();
  watch_.forget();
  scene_watch_ = {};
  replaced_();
}

std::string Files::open(const Path& path) {
  const auto opened = std::make_shared<std::optional<Document>>();
  const auto left = std::make_shared<std::vector<Recovery>>();
  const auto read = [opened, left, path, reach = reach()](Job::Progress&) {
    *opened = Document::open(path, reach);
    return_freed_memory();
    if ((*opened)->path().empty()) return;
    *left = holomorph::recoverable(autosave_folder());
    std::erase_if(*left, [&](const Recovery& each) { return each.origin != (*opened)->path(); });
  };
  const std::string problem =
      jobs_.run("Opening " + path.filename().string(), read, [this, opened, left, path] {
        adopt(std::move(**opened));
        dialog_.start_in(absolute_path(path).parent_path());
        trust_folder_of(path);
        keep_recent(path);
        ask_about_unsaved(*left);
      });
  if (!problem.empty() && !path_exists(path) && std::erase(preferences_.recent, path) > 0)
    keep_preferences();
  return problem;
}

void Files::ask_about_unsaved(const std::vector<Recovery>& left) {
  if (left.empty()) return ask_about_withheld();
  const Path autosave = left.front().path;
  const auto discard_it = [this, autosave] {
    discard(autosave);
    ask_about_withheld();
  };
  const auto ask_again = [this, discard_it] {
    questions_.ask({"Unsaved work",
                    "Discard it permanently?",
                    {{"Discard", discard_it, true}, {"Keep", [this] { ask_about_withheld(); }}},
                    1});
  };
  questions_.ask({"Unsaved work",
                  "An earlier session left unsaved work on this scene:\n" + left.front().label +
                      "\nRecover it?",
                  {{"Recover", [this, autosave] { ask_recover(autosave); }},
                   {"Leave it for later", [this] { ask_about_withheld(); }},
                   {"Discard...", ask_again}},
                  0,
                  1});
}

void Files::ask_about_withheld() {
  constexpr size_t kShown = 12;
  const std::vector<Path> withheld = workspace_.document.withheld();
  if (withheld.empty()) return;
  std::string text = "This scene uses files from outside its folder:\n";
  for (size_t i = 0; i < std::min(kShown, withheld.size()); ++i)
    text += "    " + short_name(withheld[i]) + "\n";
  if (withheld.size() > kShown)
    text += "    and " + std::to_string(withheld.size() - kShown) + " more\n";
  text +=
      "Show them only if you trust the source of this scene. After that, scenes may show files "
      "from these folders without asking.";
  questions_.ask({"Files from other folders",
                  text,
                  {{"Show them", [this] { show_withheld(); }}, {"Leave them out", {}}},
                  1});
}

void Files::show_withheld() {
  Document& document = workspace_.document;
  for (const Path& file : document.withheld()) trust_folder_of(file);
  std::vector<ImageReference> wanted;
  for (const size_t i : document.layers_without_picture())
    wanted.push_back(*document.scene().layers[i]->image);
  document.allow_withheld();
  const auto found = std::make_shared<std::vector<std::pair<ImageReference, Picture>>>();
  const auto read = [found, wanted, open = document.pictures().pixels()](Job::Progress&) {
    PictureFiles files(open);
    std::optional<Error> wrong;
    for (const ImageReference& each : wanted) try {
        found->emplace_back(each, files.picture(each));
      } catch (const Error& error) {
        wrong = error;
      }
    if (found->empty() && wrong) throw Error(*wrong);
  };
  workspace_.messages.complain(jobs_.run("Reading pictures", read, [this, found] {
    for (auto& [reference, picture] : *found)
      workspace_.document.put_picture(reference, std::move(picture));
    workspace_.document.describe_films();
  }));
}

/// Reloads the scene from its file. The user can undo this step.
void Files::reload() {
  const auto opened = std::make_shared<std::optional<Document>>();
  const Path path = workspace_.document.path();
  const std::string problem = jobs_.run(
      "Reloading " + path.filename().string(),
      [opened, path, reach = reach()](Job::Progress&) { *opened = Document::open(path, reach); },
      [this, opened] {
        Document& document = workspace_.document;
        document.add_pictures((*opened)->pictures());
        workspace_.commit_layers("Reload", (*opened)->scene());
        document.mark_saved(**opened);
        workspace_.messages.say(document.title() +
                                " was changed by another program and has been reloaded.");
        ask_about_withheld();
      });
  workspace_.messages.complain(problem);
}

void Files::watch() {
  watch_.look();
  watch_scene();
}

void Files::watch_scene() {
  Document& document = workspace_.document;
  if (asking() || workspace_.shown.preview) return;
  const SceneWatch::Change change = scene_watch_.look(document);
  if (change == SceneWatch::Change::none) return;
  const bool saved = !document.modified();
  document.mark_unsaved();  // the file no longer contains this version
  if (change == SceneWatch::Change::gone)
    workspace_.messages.complain(
        document.title() +
        " has been moved or deleted by another program. Save to keep your work.");
  else if (saved)
    reload();
  else
    workspace_.messages.say("Another program has changed " + document.title() +
                            ". When you save, choose which version to keep.");
}

void Files::ask_open(const Path& path) {
  ask_about_changes_then([this, path] { workspace_.messages.complain(open(path)); });
}

void Files::drop(const Path& path) {
  const bool is_surface = is_named_as(path, FileContent::surface);
  const Document& document = workspace_.document;
  if (is_surface && document.scene().deformation().has_cage())
    workspace_.messages.complain(imports_.outline(path));
  else if (is_surface && document.image())
    workspace_.messages.complain(
        path.filename().string() +
        ": a surface needs a picture with a cage. Make a cage, then drop the surface again.");
  else if (document.empty() || document.path() == path)
    ask_open(path);
  else
    ask_where(path);
}

/// Asks what to do with a dropped picture, drawing or scene.
void Files::ask_where(const Path& path) {
  Question question{"Dropped file", short_name(path.filename()), {}};
  const auto offer = [&](const std::string& label, const std::function<std::string()>& take) {
    question.answers.push_back({label, [this, take] { workspace_.messages.complain(take()); }});
  };
  offer("Add as a layer", [this, path] { return imports_.add_layer(path); });
  if (!is_named_as(path, FileContent::scene))
    offer("Replace this layer's picture", [this, path] { return imports_.replace_picture(path); });
  if (is_named_as(path, FileContent::path)) {
    if (workspace_.document.scene().deformation().has_cage())
      offer("Use as the outline", [this, path] { return imports_.outline(path); });
    else
      offer("Use as the cage", [this, path] { return imports_.svg(path, false); });
  }
  question.answers.push_back({"Open as a new scene", [this, path] { ask_open(path); }});
  question.answers.push_back({"Cancel", {}});
  questions_.ask(std::move(question));
}

void Files::ask_sample(const Path& scene) {
  ask_about_changes_then([this, scene] {
    const auto opened = std::make_shared<std::optional<Document>>();
    workspace_.messages.complain(jobs_.run(
        "Opening " + scene.filename().string(),
        [opened, scene](Job::Progress&) {
          *opened = Document::copy_of(scene);
          return_freed_memory();
        },
        [this, opened] { adopt(std::move(**opened)); }));
  });
}

void Files::ask_recover(const Path& autosave) {
  ask_about_changes_then([this, autosave] { recover(autosave); });
}

void Files::recover(const Path& autosave) {
  if (!path_exists(autosave)) {
    recoverable_ = holomorph::recoverable(autosave_folder());
    return workspace_.messages.complain(
        "This work has already been recovered or discarded in another window.");
  }
  const auto recovered = std::make_shared<std::optional<Document>>();
  workspace_.messages.complain(jobs_.run(
      "Recovering",
      [recovered, autosave](Job::Progress&) { *recovered = Document::recover(autosave); },
      [this, recovered, autosave] {
        adopt(std::move(**recovered));
        if (!workspace_.document.autosave(autosave_folder())) return;
        discard(autosave);  // the document now has an autosave of its own
        workspace_.messages.say(workspace_.document.path().empty()
                                    ? "Recovered. Save it under a name to keep it."
                                    : "Recovered. Save to keep it.");
      }));
}

void Files::discard(const Path& autosave) {
  holomorph::discard(autosave);
  std::erase_if(recoverable_, [&](const Recovery& r) { return r.path == autosave; });
}

std::string Files::save_to(const Path& path, const Then& then, Conflict conflict) {
  Document& document = workspace_.document;
  const Path target = absolute_path(path);
  if (conflict == Conflict::ask && target == document.path() && document.changed_on_disk()) {
    ask_about_change(path, then);
    return "";
  }
  try {
    document.save(path);
    document.remove_autosave(autosave_folder());
    trust_folder_of(path);
    keep_recent(document.path());
    workspace_.messages.say("Saved " + path.filename().string() + ".");
  } catch (const Error& error) {
    return error.what();
  }
  if (then) then();
  return "";
}

void Files::ask_about_change(const Path& path, const Then& then) {
  questions_.ask(
      {"Changed by another program",
       short_name(path.filename()) +
           " has been changed by another program, or in another window, since it was opened here. "
           "Which version do you want to keep?",
       {{"Save under another name", [this, then] { save(true, then); }},
        {"Overwrite with this version",
         [this, path, then] {
           workspace_.messages.complain(save_to(path, then, Conflict::overwrite));
         }},
        {"Reload the file", [this] { reload(); }},
        {"Cancel", {}}},
       3});
}

void Files::save(bool as, const Then& then) {
  const Document& document = workspace_.document;
  if (!as && !document.path().empty())
    return workspace_.messages.complain(save_to(document.path(), then));
  Path start = document.path();
  if (start.empty() && !document.first_picture().empty())
    start =
        in_document_folder(document, dialog_, document.first_picture().stem().string() + ".json");
  if (start.empty()) start = "scene.json";
  dialog_.ask({FileQuestion::Mode::save, "Save scene", "Save", extensions_of({FileContent::scene}),
               start, false},
              [this, then](const Path& path, double) { return save_to(path, then); });
}

void Files::autosave() {
  if (workspace_.document.autosave(autosave_folder())) return;
  if (!std::exchange(autosave_failed_, true))
    workspace_.messages.complain(Error(
        ErrorKind::failed, autosave_folder().empty()
                               ? "Autosave is off: there is no home folder. Save often."
                               : "Autosave failed: cannot write to " + autosave_folder().string()));
}

void Files::keep_recent(const Path& path) {
  remember(preferences_, absolute_path(path));
  keep_preferences();
}

void Files::keep_preferences() {
  try {
    save_preferences(preferences_);
  } catch (const Error& error) {
    workspace_.messages.complain(error);
  }
}

void Files::answer(Request request) {
  switch (request) {
    case Request::new_scene:
      ask_about_changes_then([this] {
        recoverable_ = holomorph::recoverable(autosave_folder());
        adopt(Document());
      });
      break;
    case Request::open:
      ask_about_changes_then([this] {
        dialog_.ask_open("Open a picture, film or scene", "Open",
                         extensions_of({FileContent::scene, FileContent::picture, FileContent::film,
                                        FileContent::surface}),
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
    case Request::export_again:
    case Request::copy_picture:
    case Request::export_svg:
    case Request::export_film:
    case Request::export_surface:
      exports_.answer(request);
      break;
    case Request::quit:
      ask_about_changes_then([this] {
        workspace_.document.remove_autosave(autosave_folder());
        quit_ = true;
      });
      break;
    case Request::show_withheld:
      ask_about_withheld();
      break;
    case Request::find_layers: {
      const Document& document = workspace_.document;
      if (const auto missing = document.layers_without_picture(); !missing.empty())
        watch_.find_layers(document.scene().layers[missing[0]]->image->file, {});
      break;
    }
    case Request::import_cage:
    case Request::import_pose:
    case Request::import_outline:
    case Request::add_layer:
    case Request::replace_picture:
    case Request::play_numbered:
    case Request::add_new_layers:
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

void Files::ask_about_layers(FoundLayers found) {
  const std::string file = found.update.file;
  layer_question_.ask(std::move(found), [this, file](const LayerChoices& choices) {
    watch_.find_layers(file, choices);
  });
}

void Files::draw(Thumbnails& thumbnails) {
  const Path& scene = workspace_.document.path();
  std::vector<Path> folders;
  constexpr size_t kMostFolders = 4;
  for (const Path& file : preferences_.recent)
    if (const Path folder = file.parent_path();
        folders.size() < kMostFolders && std::ranges::find(folders, folder) == folders.end())
      folders.push_back(folder);
  dialog_.set_places(scene.empty() ? Path() : scene.parent_path(), std::move(folders));
  dialog_.draw();
  questions_.draw();
  layer_question_.draw(thumbnails);
  exports_.draw();
  jobs_.draw();
}

}  // namespace holomorph
