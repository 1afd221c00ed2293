// Menu File: what the window is asked for.
#include "edit/actions/groups.h"

namespace holomorph {
namespace {

// Glyphs of Font Awesome 4.
constexpr const char *kNew = "\uf016", *kOpen = "\uf07c", *kSave = "\uf0c7", *kExport = "\uf1c5";

}  // namespace

std::vector<Action> file_actions() {
  return {
      {"file.new", "New", kNew, "File", {{'N', kCtrl}}, always, ask<Request::new_scene>},
      {"file.open", "Open...", kOpen, "File", {{'O', kCtrl}}, always, ask<Request::open>},
      {"file.save", "Save", kSave, "File", {{'S', kCtrl}}, has_content, ask<Request::save>},
      {"file.save_as",
       "Save as...",
       "",
       "File",
       {{'S', kCtrlShift}},
       has_content,
       ask<Request::save_as>},
      {"file.export",
       "Export...",
       kExport,
       "File",
       {{'E', kCtrl}},
       has_content,
       ask<Request::export_picture>},
      {"file.export_again",
       "Export again",
       "",
       "File",
       {{'E', kCtrlShift}},
       has_content,
       ask<Request::export_again>},
      {"file.import_cage", "Cage from SVG...", "", "File", {}, always, ask<Request::import_cage>},
      {"file.import_outline",
       "Outline from SVG, picture or OBJ...",
       "",
       "File",
       {},
       has_cage,
       ask<Request::import_outline>},
      {"file.import_pose",
       "Posed cage from SVG...",
       "",
       "File",
       {},
       has_cage,
       ask<Request::import_pose>},
      {"file.export_film",
       "Export film of the keyframes...",
       "",
       "File",
       {},
       plays,
       ask<Request::export_film>},
      {"file.export_svg",
       "Export cage as SVG...",
       "",
       "File",
       {},
       has_cage,
       ask<Request::export_svg>},
      {"file.export_surface",
       "Export textured surface...",
       "",
       "File",
       {},
       has_surface,
       ask<Request::export_surface>},
      {"file.quit", "Quit", "", "File", {{'Q', kCtrl}}, always, ask<Request::quit>},
  };
}

}  // namespace holomorph
