// The sample scenes of the welcome page.
#pragma once

#include <string>
#include <vector>

#include "render/texture.h"
#include "scene/file.h"

namespace holomorph {

struct Sample {
  Path scene;
  std::string title, text;
  Texture thumbnail;  ///< empty when the scene cannot be drawn; opening it says why
};

/// The samples that are installed or lie in the source tree, drawn as they are posed.
std::vector<Sample> load_samples();

}  // namespace holomorph
