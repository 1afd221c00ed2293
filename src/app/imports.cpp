// Long work runs as a job. Its result becomes one step of the history.
#include "app/imports.h"

#include <cmath>
#include <map>
#include <utility>

#include "app/clipboard.h"
#include "core/error.h"
#include "edit/tools/layer_drag.h"
#include "edit/tools/tool.h"
#include "scene/clips.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/numbered_frames.h"
#include "scene/formats/outline_import.h"
#include "scene/formats/svg_path.h"
#include "scene/joined_cage.h"

namespace holomorph {

/// A film needs the timeline, in which it plays.
void Imports::show_timeline_of_films() {
  if (!clip_of(workspace_.document.scene().layer())) return;
  workspace_.shown.timeline.visible = workspace_.shown.timeline.active = true;
}

std::string Imports::add_layer(const Path& path) {
  const auto added = std::make_shared<LoadedScene>();
  return jobs_.run(
      "Reading " + path.filename().string(),
      [added, path, reach = reach_(), open = open_pixels()](Job::Progress&) {
        *added = is_named_as(path, FileContent::scene) ? load_scene(path, {true, reach, open})
                                                       : scene_of_image(path, open);
      },
      [this, added, path] {
        chosen_(path);
        if (add_layers_of(*added, "Add " + path.stem().string())) remember_(path);
      });
}

/// Adds the layers of the edited layer's file that the scene does not show yet.
std::string Imports::add_new_layers() {
  const std::string file = workspace_.document.scene().layer().image->file;
  const auto added = std::make_shared<LoadedScene>();
  const auto count = std::make_shared<size_t>(0);
  return jobs_.run(
      "Reading " + Path(file).filename().string(),
      [added, count, file, scene = workspace_.document.scene(),
       open = open_pixels()](Job::Progress&) {
        PictureFiles files(open);
        const LayerUpdate update = layer_update(layers_of(scene), file, files);
        if (!update.unclear.empty())
          throw Error(ErrorKind::bad_input,
                      "First choose which layer '" + update.unclear[0].name + "' is now.");
        *count = update.added.size();
        added->scene = with_added_layers(scene, update, files, added->pictures);
      },
      [this, added, count, file] {
        if (*count == 0)
          return workspace_.messages.say("All layers of " + Path(file).filename().string() +
                                         " are in the scene.");
        workspace_.document.add_pictures(added->pictures);
        workspace_.commit_layers("Add new layers", added->scene);
      });
}

double Imports::open_pixels() const {
  return workspace_.document.pictures().pixels();
}

/// Puts the picture of the edited layer into the middle of the view, with a box around it.
Scene Imports::in_the_middle(Scene scene, const Image& picture) const {
  Deformation boxed = with_box(scene.deformation(), picture);
  const Complex by = workspace_.display.viewport.center - picture.box().center();
  const Complex whole(std::round(by.real()), std::round(by.imag()));  // keeps the pixels sharp
  return with_deformation(std::move(scene), moved_as_whole(std::move(boxed), whole));
}

bool Imports::add_layers_of(const LoadedScene& added, const std::string& label) {
  Document& document = workspace_.document;
  const bool first = document.empty();
  document.add_pictures(added.pictures);
  Scene scene = first ? added.scene : with_layers_added(document.scene(), added.scene);
  const bool placed = !first && added.scene.layers.size() == 1 && !scene.deformation().has_cage() &&
                      document.pictures().of(scene.layer());
  if (placed) scene = in_the_middle(std::move(scene), *document.pictures().of(scene.layer()));
  if (!workspace_.commit_layers(label, std::move(scene))) return false;
  show_timeline_of_films();
  if (placed) {
    workspace_.tools.active = ToolId::select;
    const auto all = handles_of(workspace_.shown.deformation(), EditMode::pose);
    workspace_.selection = Selection(all.begin(), all.end());
  }
  workspace_.messages.complain(added.message(LoadedScene::kFewLines));
  if (!added.pictures.withheld().empty()) workspace_.request = Request::show_withheld;
  if (first)
    first_();
  else
    workspace_.messages.say(
        (added.scene.layers.size() > 1
             ? std::to_string(added.scene.layers.size()) + " layers were"
             : title_of_layer(document.scene(), document.scene().edited) + " was") +
        " added above the current layer. Press " + workspace_.actions.key_of("layer.above") +
        " and " + workspace_.actions.key_of("layer.below") + " to change layers.");
  return true;
}

void Imports::paste_picture() {
  const auto pasted = std::make_shared<LoadedScene>();
  const auto paste = [pasted](Job::Progress& progress) {
    *pasted = scene_of_pasted(picture_on_clipboard([&] { return !progress.cancelled(); }));
  };
  workspace_.messages.complain(jobs_.run(
      "Pasting a picture", paste, [this, pasted] { add_layers_of(*pasted, "Paste picture"); }));
}

std::string Imports::replace_picture(const Path& path) {
  return replace_picture(reference_in(path), "Replace picture");
}

std::string Imports::play_numbered() {
  const Scene& scene = workspace_.document.scene();
  ImageReference reference = reference_in(first_numbered_picture(scene.layer().image->file));
  reference.clip = Clip{scene.animation.frames_per_second};
  return replace_picture(std::move(reference), "Play as film");
}

std::string Imports::replace_picture(ImageReference reference, const std::string& label) {
  const Path path = reference.file;
  const auto picture = std::make_shared<Picture>();
  return jobs_.run(
      "Reading " + path.filename().string(),
      [picture, reference, open = open_pixels()](Job::Progress&) {
        *picture = read_picture(reference, open);
      },
      [this, picture, path, reference, label] {
        chosen_(path);
        Layer layer = workspace_.document.scene().layer();
        const std::optional<ImageReference> before = layer.image;
        ImageReference now = described(reference, *picture);
        workspace_.document.put_picture(now, std::move(*picture));
        if (before) now.extra = before->extra;
        layer.image = now;
        Scene scene = with_layer(workspace_.document.scene(), std::move(layer));
        if (!workspace_.commit_layers(label, std::move(scene))) return;
        show_timeline_of_films();
        if (before && (before->width != now.width || before->height != now.height))
          workspace_.messages.say(
              "The new picture has a different size. Cage, pins and strokes keep their positions.");
      });
}

void Imports::ask_find_picture() {
  const Document& document = workspace_.document;
  const std::vector<size_t> missing = document.layers_without_picture();
  if (missing.empty()) return;
  const std::string asked = document.scene().layers[missing.front()]->image->file;
  chooser_.ask_open("Where is " + Path(asked).filename().string() + "?", "Choose",
                    extensions_of({FileContent::picture, FileContent::film}),
                    [this, asked](const Path& path) { return find_picture(path, asked); });
}

/// Also looks for the other missing pictures in the chosen file's folder, because they may have
/// been moved together.
std::string Imports::find_picture(const Path& path, const std::string& asked) {
  const auto found = std::make_shared<std::map<size_t, std::pair<ImageReference, Picture>>>();
  const auto find = [found, path, asked, open = open_pixels(), scene = workspace_.document.scene(),
                     missing = workspace_.document.layers_without_picture()](Job::Progress&) {
    PictureFiles files(open);
    for (const size_t i : missing) {
      const ImageReference& was = *scene.layers[i]->image;
      const bool chosen = was.file == asked;
      const Path file = chosen ? path : path.parent_path() / Path(was.file).filename();
      ImageReference now = was;
      now.file = absolute_path(file).string();
      try {
        Picture picture = files.picture(now);
        if (chosen || picture.sha256 == was.sha256)
          (*found)[i] = {described(std::move(now), picture), std::move(picture)};
      } catch (const Error&) {
        if (chosen) throw;
      }
    }
  };
  return jobs_.run("Reading " + path.filename().string(), find, [this, found, path] {
    chosen_(path);
    Document& document = workspace_.document;
    std::vector<Layer> layers = layers_of(document.scene());
    bool other = false;
    for (auto& [i, picture] : *found) {
      const std::string& before = layers[i].image->sha256;
      other = other || (!before.empty() && before != picture.second.sha256);
      layers[i].image = picture.first;
      document.put_picture(picture.first, std::move(picture.second));
    }
    Scene scene = document.scene();
    scene.layers = shared(std::move(layers));
    if (!workspace_.commit_layers("Find picture", std::move(scene))) return;
    const size_t still = document.layers_without_picture().size();
    workspace_.messages.say(
        std::string(other ? "Picture found. It differs from the one that the scene was made "
                            "with."
                          : "Picture found.") +
        (still > 0 ? " Still missing: " + std::to_string(still) + "." : ""));
  });
}

void Imports::ask_svg(bool pose) {
  chooser_.ask_open(pose ? "Posed cage from SVG" : "Cage from SVG", "Open",
                    extensions_of({FileContent::path}),
                    [this, pose](const Path& path) { return svg(path, pose); });
}

std::string Imports::svg(const Path& path, bool pose) {
  const Image* image = workspace_.document.image();
  const auto cage = std::make_shared<Cage>();
  return jobs_.run(
      "Reading " + path.filename().string(),
      [cage, path, pose, height = image ? image->page().top : 0.0,
       rest = workspace_.shown.base().rest](Job::Progress&) {
        *cage = pose ? cage_of_svg(read_file(path), path.string(), height, PathUse::pose, &rest)
                     : cage_of_svg(read_file(path), path.string(), height);
      },
      [this, cage, pose, path] {
        chosen_(path);
        take_cage(std::move(*cage), pose);
      });
}

void Imports::take_cage(Cage cage, bool pose) {
  Deformation deformation = pose ? workspace_.shown.base() : workspace_.shown.own();
  if (pose && cage.size() != deformation.rest.size())
    throw Error(ErrorKind::bad_input,
                "The path has " + std::to_string(cage.size()) + " segments, but the cage has " +
                    std::to_string(deformation.rest.size()) + ". Both need the same number.");
  if (pose)
    deformation.pose = std::move(cage);
  else
    deformation = with_cage(std::move(deformation), std::move(cage));
  if (!method_named(deformation.method).allows_parts)
    deformation = with_joined_parts(std::move(deformation));
  if (!workspace_.commit(pose ? "Pose from SVG" : "Cage from SVG", std::move(deformation),
                         pose ? EditBase::shown : EditBase::document))
    return;
  workspace_.mode = EditMode::pose;
  workspace_.tools.active = ToolId::select;
}

std::string Imports::outline(const Path& path) {
  const Image* image = workspace_.document.image();
  const auto outline = std::make_shared<Points>();
  const auto read = [outline, path, height = image ? image->page().top : 0.0,
                     onto = box_of(outline_of(workspace_.shown.own().rest))](Job::Progress&) {
    *outline = outline_of_file(path, height, onto);
  };
  return jobs_.run("Reading " + path.filename().string(), read, [this, outline, path] {
    chosen_(path);
    set_outline(workspace_, "Outline from file", std::move(*outline),
                surface_of_file(path, Flattening::lscm));
  });
}

void Imports::answer(Request request) {
  switch (request) {
    case Request::import_cage:
      ask_svg(false);
      break;
    case Request::import_pose:
      ask_svg(true);
      break;
    case Request::import_outline:
      chooser_.ask_open(
          "Outline from SVG, picture or OBJ", "Open",
          extensions_of({FileContent::path, FileContent::surface, FileContent::picture}),
          [this](const Path& path) { return outline(path); });
      break;
    case Request::add_layer:
      chooser_.ask_open(
          "Add a picture or film, or the layers of a scene", "Add",
          extensions_of({FileContent::scene, FileContent::picture, FileContent::film}),
          [this](const Path& path) { return add_layer(path); });
      break;
    case Request::replace_picture:
      chooser_.ask_open("Replace picture", "Replace",
                        extensions_of({FileContent::picture, FileContent::film}),
                        [this](const Path& path) { return replace_picture(path); });
      break;
    case Request::add_new_layers:
      workspace_.messages.complain(add_new_layers());
      break;
    case Request::play_numbered:
      workspace_.messages.complain(play_numbered());
      break;
    case Request::find_picture:
      ask_find_picture();
      break;
    case Request::paste_picture:
      paste_picture();
      break;
    default:
      break;  // not an import
  }
}

}  // namespace holomorph
