// Autosaves, and the recovery of scenes after an interrupted session.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "system/file.h"

namespace holomorph {

/// The path of a document's autosave in a folder, and the path of its lock file. The program holds
/// the lock while it uses the autosave. A second window therefore does not offer to recover work
/// that is still open in the first.
Path autosave_path(const Path& folder, const std::string& id);
Path lock_path(const Path& autosave);

/// The file of an autosaved document, and the hash of the file's last known content. An autosave
/// stores both among the scene's unknown keys.
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
  Path origin = {};  ///< the scene's own file; empty if the scene was never saved
};
/// The autosaves that can be recovered, newest first.
std::vector<Recovery> recoverable(const Path& folder);
/// Deletes an autosave.
void discard(const Path& autosave);

}  // namespace holomorph
