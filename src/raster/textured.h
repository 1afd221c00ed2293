// A surface with the posed picture on it.
#pragma once

#include "raster/picture.h"
#include "scene/laid_surface.h"

namespace holomorph {

struct TexturedSurface {
  Image texture;
  Points coordinates;  ///< of the surface's vertices, 0 to 1, v up
};

/// The posed scene as a picture, and where on it the laid surface's vertices are. Throws Error as
/// picture_of does.
TexturedSurface textured(const LaidSurface& surface, const Scene& scene, const Image* source,
                         double scale = 1);

/// Writes PATH, and beside it a material and a texture of the same name with .mtl and .png.
void write_textured(const std::filesystem::path& path, const LaidSurface& surface,
                    const TexturedSurface& textured);

}  // namespace holomorph
