// The File menu, and copying and pasting pictures. The window carries out all these requests.
#include "edit/actions/groups.h"
#include "edit/actions/icons.h"

namespace holomorph {
std::vector<Action> file_actions() {
  return {
      {
          .id = "file.new",
          .label = "New",
          .icon = icon_named("add"),
          .keys = {{'N', kCtrl}},
          .enabled = always,
          .run = ask<Request::new_scene>,
      },
      {
          .id = "file.open",
          .label = "Open...",
          .icon = icon_named("folder"),
          .keys = {{'O', kCtrl}},
          .enabled = always,
          .run = ask<Request::open>,
      },
      {
          .id = "file.save",
          .label = "Save",
          .icon = icon_named("picture"),
          .keys = {{'S', kCtrl}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = ask<Request::save>,
      },
      {
          .id = "file.save_as",
          .label = "Save as...",
          .keys = {{'S', kCtrlShift}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = ask<Request::save_as>,
      },
      {
          .id = "file.find_picture",
          .label = "Find missing picture...",
          .hint = "Also finds other missing pictures in the same folder",
          .icon = icon_named("search"),
          .needs = "No picture is missing",
          .enabled =
              [](const Workspace& w) { return !w.document.layers_without_picture().empty(); },
          .run = ask<Request::find_picture>,
      },
      {
          .id = "file.export",
          .label = "Export...",
          .icon = icon_named("export"),
          .keys = {{'E', kCtrl}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = ask<Request::export_picture>,
      },
      {
          .id = "file.export_again",
          .label = "Export again",
          .hint = "Use the settings of the last export",
          .keys = {{'E', kCtrlShift}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = ask<Request::export_again>,
      },
      {
          .id = "file.copy_picture",
          .label = "Copy picture",
          .hint = "Copy the picture as it is shown",
          .keys = {{'C', kCtrlAlt}},
          .needs = kNeedsPicture,
          .enabled = has_content,
          .run = ask<Request::copy_picture>,
      },
      {
          .id = "file.paste_picture",
          .label = "Paste picture",
          .hint = "Add the picture on the clipboard as a layer",
          .keys = {{'V', kCtrlAlt}},
          .enabled = always,
          .run = ask<Request::paste_picture>,
      },
      {
          .id = "file.import_cage",
          .label = "Cage from SVG...",
          .hint = "Use the path with the id \"rest\", or else the first",
          .enabled = always,
          .run = ask<Request::import_cage>,
      },
      {
          .id = "file.import_outline",
          .label = "Outline from file...",
          .hint =
              "Use an SVG path, the opaque part of a picture, or the boundary of an OBJ surface",
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = ask<Request::import_outline>,
      },
      {
          .id = "file.import_pose",
          .label = "Posed cage from SVG...",
          .hint = "Use the path with the id \"pose\", or else the first",
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = ask<Request::import_pose>,
      },
      {
          .id = "file.export_film",
          .label = "Export film...",
          .hint = "Write the animation of the keyframes",
          .needs = "Needs two keyframes, or a film",
          .enabled = plays,
          .run = ask<Request::export_film>,
      },
      {
          .id = "file.export_svg",
          .label = "Export cage as SVG...",
          .hint = "Write the rest shape and the pose",
          .needs = kNeedsCage,
          .enabled = has_cage,
          .run = ask<Request::export_svg>,
      },
      {
          .id = "file.export_surface",
          .label = "Export textured surface...",
          .hint = "Write an OBJ surface with texture coordinates, a material and the picture",
          .needs = kNeedsSurface,
          .enabled = has_surface,
          .run = ask<Request::export_surface>,
      },
      {
          .id = "file.quit",
          .label = "Quit",
          .keys = {{'Q', kCtrl}},
          .enabled = always,
          .run = ask<Request::quit>,
      },
  };
}

}  // namespace holomorph
