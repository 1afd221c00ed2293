// Exports a surface with the posed picture as its texture.
#pragma once

#include <array>

#include "scene/flattened_surface.h"
#include "scene/formats/image.h"
#include "system/file.h"

namespace holomorph {

struct TexturedSurface {
  Image texture;
  Points coordinates;  ///< texture coordinates of the surface's vertices: 0 to 1, v up
};

/// The texture is the posed picture inside the cage, cropped to the surface and a narrow margin.
/// Its colors are extended to the surface's edge and a little beyond. `scale` is in texture pixels
/// per plane unit. Throws Error if the scene has no picture or no cage, or if rasterized throws.
TexturedSurface textured(const FlattenedSurface& surface, const Deformation& deformation,
                         const Image* source, double scale = 1);

/// The three files that write_textured writes for a path: surface, material and texture.
std::array<std::filesystem::path, 3> files_of_textured(const std::filesystem::path& path);

/// Writes the surface to `path`, and next to it a material (.mtl) and a texture (.png) with the
/// same name. Throws Error if the extension is not .obj.
void write_textured(const std::filesystem::path& path, const FlattenedSurface& surface,
                    const TexturedSurface& textured);

}  // namespace holomorph
