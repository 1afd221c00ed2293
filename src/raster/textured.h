// A surface with the posed picture on it.
#pragma once

#include <array>

#include "scene/formats/image.h"
#include "scene/laid_surface.h"
#include "system/file.h"

namespace holomorph {

struct TexturedSurface {
  Image texture;
  Points coordinates;  ///< of the surface's vertices, 0 to 1, v up
};

/// The posed cage's part of the picture around the surface, its colours carried to the surface's
/// edge and a little beyond, and where on it the surface's vertices are. Throws Error for a scene
/// without picture or cage and for what rasterized refuses.
TexturedSurface textured(const LaidSurface& surface, const Deformation& deformation,
                         const Image* source, double scale = 1);

/// The three files that write_textured writes for a path.
std::array<std::filesystem::path, 3> files_of_textured(const std::filesystem::path& path);

/// Writes PATH.obj, and beside it a material and a texture of the same name with .mtl and .png.
/// Throws Error for another extension.
void write_textured(const std::filesystem::path& path, const LaidSurface& surface,
                    const TexturedSurface& textured);

}  // namespace holomorph
