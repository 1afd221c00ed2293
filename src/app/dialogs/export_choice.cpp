// Puts the tables of pictures, layers, films and other exports together.
#include "app/dialogs/export_choice.h"

#include <algorithm>

#include "exports/export_formats.h"
#include "film/film_writer.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/image.h"
#include "scene/formats/layered.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

bool has_any_cage(const Scene& scene) {
  return std::ranges::any_of(scene.layers, [](const SharedLayer& layer) {
    return layer->visible && layer->deformation.has_cage();
  });
}

}  // namespace

std::vector<ExportChoice> export_choices(const Scene& scene) {
  std::vector<ExportChoice> all;
  for (const PictureFormat& format : picture_formats())
    all.push_back({format.label, format.extension});
  for (const LayeredFormat& format : layered_formats())
    all.push_back({format.label, format.extension});
  if (plays(scene))
    for (const FilmFormat& format : film_formats())
      all.push_back({format.label, format.extension, ExportKind::film});
  const bool has_cage = scene.deformation().has_cage();
  for (const ExportFormat& format : export_formats()) {
    if (format.label.empty()) continue;
    if (format.meshes && (format.all_layers ? has_any_cage(scene) : has_cage) &&
        (moves(scene) || !format.sequence))
      all.push_back({format.label, format.extensions[0], ExportKind::meshes, format.id});
    if (format.st_map && has_cage)
      all.push_back({format.label, format.extensions[0],
                     format.id == "stmap" ? ExportKind::st_map : ExportKind::unwarp_map});
  }
  return all;
}

bool is_known_extension(const std::string& extension) {
  const auto is = [&](const std::string& each) { return each == extension; };
  return std::ranges::any_of(extensions_of({FileContent::picture}), is) ||
         std::ranges::any_of(film_formats(), is, &FilmFormat::extension) ||
         std::ranges::any_of(export_formats(), [&](const ExportFormat& format) {
           return std::ranges::any_of(format.extensions, is);
         });
}

}  // namespace holomorph
