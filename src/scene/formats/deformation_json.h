// Reads and writes the deformation of one layer as JSON.
#pragma once

#include "scene/formats/json_reader.h"

namespace holomorph {

/// Reads the keys of a deformation from a layer, or from the scene if the file has a single layer.
Deformation read_deformation(const Reader& reader);

/// Adds the keys of a deformation to a layer or scene.
void write_deformation(const Deformation& deformation, Json& document);

}  // namespace holomorph
