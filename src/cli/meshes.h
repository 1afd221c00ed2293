// Exports of moving meshes: glTF, vertex caches, Godot, Spine and sequences of OBJ files.
#pragma once

#include "cli/commands.h"
#include "scene/loading.h"

namespace holomorph {

/// Writes the scene's meshes in a format for which ExportFormat::meshes is set, or a sequence of
/// OBJ files. Throws Error.
void export_meshes(const LoadedScene& loaded, const ExportCommand& command);

}  // namespace holomorph
