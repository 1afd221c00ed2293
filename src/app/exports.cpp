// Every export checks that it does not overwrite a file that the document uses.
#include "app/exports.h"

#include "app/clipboard.h"
#include "core/error.h"
#include "raster/picture.h"
#include "raster/textured.h"
#include "scene/formats/svg_path.h"
#include "scene/preferences.h"
#include "system/new_file.h"

namespace holomorph {

Path in_document_folder(const Document& document, const FileChooser& chooser,
                        const std::string& name) {
  // A scene without a file that was recovered has only its pictures, if any.
  for (const Path& folder :
       {document.path().parent_path(), chooser.folder(), document.first_picture().parent_path()}) {
    std::error_code ignored;
    if (folder != pasted_folder() && std::filesystem::is_directory(folder, ignored))
      return folder / name;
  }
  return absolute_path(name);
}

void Exports::answer(Request request) {
  const Path folder = in_folder("").parent_path();
  if (request == Request::export_picture) dialog_.ask({}, folder);
  if (request == Request::export_film) dialog_.ask(ExportKind::film, folder);
  if (request == Request::export_again) dialog_.again(folder);
  if (request == Request::copy_picture) copy_picture();
  if (request == Request::export_svg) ask_cage();
  if (request == Request::export_surface) ask_surface();
}

Path Exports::in_folder(const std::string& name) const {
  return in_document_folder(workspace_.document, chooser_, name);
}

void Exports::copy_picture() {
  if (const std::string problem = missing_picture_message(workspace_); !problem.empty())
    return workspace_.messages.complain(problem);
  const Document& document = workspace_.document;
  const auto copy = [scene = document.scene(), pictures = document.pictures(),
                     options = as_shown(workspace_)](Job::Progress& progress) {
    const RasterResult result = picture_of(scene, pictures.of(scene.layer()), options, pictures);
    if (!progress.cancelled())
      put_on_clipboard(encode_png(result.image), [&] { return !progress.cancelled(); });
  };
  workspace_.messages.complain(jobs_.run("Copying the picture", copy, [this] {
    workspace_.messages.say("Copied the picture to the clipboard.");
  }));
}

void Exports::ask_cage() {
  const Document& document = workspace_.document;
  const Path& source = document.path().empty() ? document.image_path() : document.path();
  const Path start = in_folder((source.empty() ? "cage" : source.stem().string()) + ".svg");
  chooser_.ask({FileQuestion::Mode::save, "Export cage", "Export", {".svg"}, start, false},
               [this](const Path& path, double) -> std::string {
                 try {
                   check_may_write(path, workspace_.document.sources());
                   write_file(path, svg_of(workspace_.shown.base(),
                                           workspace_.document.scene().layer().image));
                   workspace_.messages.say("Exported " + path.filename().string() + ".");
                 } catch (const Error& error) {
                   return error.what();
                 }
                 return "";
               });
}

std::string Exports::surface(const Path& path, double scale) {
  try {
    const Document& document = workspace_.document;
    const Deformation& deformation = workspace_.shown.own();
    if (document.pictures().withheld().contains(deformation.surface->file))
      return Path(deformation.surface->file).filename().string() +
             " is not in the scene's folder and was not read. Press Show it first.";
    const FlattenedSurface surface = flattened_surface_of(deformation);
    for (const Path& file : files_of_textured(path)) check_may_write(file, document.sources());
    write_textured(path, surface, textured(surface, deformation, document.image(), scale));
    workspace_.messages.say("Exported " + path.filename().string() +
                            " with its material and picture.");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void Exports::ask_surface() {
  const Document& document = workspace_.document;
  const Path& source = document.path().empty() ? document.image_path() : document.path();
  const Path start =
      in_folder(source.stem().string() + "-" +
                Path(document.scene().deformation().surface->file).stem().string() + ".obj");
  chooser_.ask(
      {FileQuestion::Mode::save, "Export textured surface", "Export", {".obj"}, start, true},
      [this](const Path& path, double scale) { return surface(path, scale); });
}

}  // namespace holomorph
