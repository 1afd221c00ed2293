// Surface files: reads Wavefront OBJ, and writes OBJ with a material and a texture.
#pragma once

#include <string>

#include "core/mesh/surface.h"

namespace holomorph {

/// A surface and its texture coordinates, if the file has exactly one for each vertex.
struct SurfaceFile {
  Surface surface;
  Points texture;              ///< 0 to 1 in both directions, v up; empty if there are none
  std::string materials = {};  ///< the file that mtllib names; empty if there is none
};

/// Reads v, vt, f and mtllib lines and ignores all others. Polygons are split into fans of
/// triangles. Vertices without a face are left out. Throws Error, with the file and the line, for
/// damaged data and for more than a million vertices.
SurfaceFile surface_of_obj(const std::string& text, const std::string& name);

/// The name of the first picture (map_Kd) in a material library; "" if there is none.
std::string texture_of_materials(const std::string& text);

/// The OBJ text of a surface with these texture coordinates. It refers to the material library in
/// the given file.
std::string obj_of(const Surface& surface, const Points& texture, const std::string& material_file);
/// A material library with one material that displays a texture file unchanged; white if the name
/// is empty.
std::string material_of(const std::string& texture_file);

}  // namespace holomorph
