// Writes ST-maps, in the formats stmap and unwarp-map of the command export.
#pragma once

#include "cli/commands.h"
#include "scene/document.h"

namespace holomorph {

/// Writes one ST-map, or with --frames a numbered file for each frame. The name of the file decides
/// between OpenEXR and NumPy; names without an extension and standard output get NumPy. Throws
/// Error.
void export_st_maps(const LoadedScene& loaded, const ExportCommand& command);

}  // namespace holomorph
