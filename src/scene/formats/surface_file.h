// Surfaces as files: Wavefront OBJ in, OBJ with material and texture out.
#pragma once

#include <string>

#include "core/mesh/surface.h"

namespace holomorph {

/// A surface and, where the file has exactly one for each vertex, its texture coordinates.
struct SurfaceFile {
  Surface surface;
  Points texture;              ///< 0 to 1 each way, v up; empty when there are none
  std::string materials = {};  ///< the file that mtllib names; empty when none
};

/// Reads v, vt and f lines; polygons become fans of triangles, vertices without a face are left
/// out, what else there is does not matter. Throws Error naming file and line for damaged ones, and
/// for more than a million vertices.
SurfaceFile surface_of_obj(const std::string& text, const std::string& name);

/// The picture that a material library shows first (map_Kd), as it is named there; "" for none.
std::string texture_of_materials(const std::string& text);

/// The surface with these texture coordinates and a material of that name in that file.
std::string obj_of(const Surface& surface, const Points& texture, const std::string& material_file);
/// A material that shows a texture file as it is.
std::string material_of(const std::string& texture_file);

}  // namespace holomorph
