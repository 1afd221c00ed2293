// Autosaves: what an interrupted session leaves behind.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "system/file.h"

namespace holomorph {

/// The path of a document's autosave in a folder, and of the file that is locked while its program
/// runs.
Path autosave_path(const Path& folder, const std::string& id);
Path lock_path(const Path& autosave);

/// The file that an autosave's scene was opened from, and the hash of its content at that time. An
/// autosave keeps both among the scene's unknown keys.
struct Origin {
  Path file;  ///< empty if the scene was never saved
  std::string sha256;
};
Scene with_origin(Scene scene, const Origin& origin);
Scene without_origin(Scene scene);
Origin origin_of(const Scene& scene);

/// An autosave that no running program owns, and its description for the user.
struct Recovery {
  Path path;
  std::string label;
  Path origin = {};  ///< the scene's own file; empty if it was never saved
};
/// The autosaves that can be recovered, newest first.
std::vector<Recovery> recoverable(const Path& folder);
/// Deletes an autosave.
void discard(const Path& autosave);

}  // namespace holomorph
