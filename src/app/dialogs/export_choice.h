// The list of formats in the export dialog.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// What a file contains. Pictures may have layers.
enum class ExportKind { picture, film, meshes, st_map, unwarp_map };

inline bool is_drawn(ExportKind kind) {
  return kind == ExportKind::picture || kind == ExportKind::film;
}
inline bool is_st_map(ExportKind kind) {
  return kind == ExportKind::st_map || kind == ExportKind::unwarp_map;
}

/// A row of the list.
struct ExportChoice {
  std::string label, extension;
  ExportKind kind = ExportKind::picture;
  std::string meshes = {};  ///< the id of a format of meshes
};

/// What a scene can be exported as.
std::vector<ExportChoice> export_choices(const Scene& scene);

/// Whether an extension belongs to a known format. Anything else that follows a dot is a part of
/// the name.
bool is_known_extension(const std::string& extension);

}  // namespace holomorph
