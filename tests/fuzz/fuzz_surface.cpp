// Reads any bytes as an OBJ file: an Error, or a surface whose indices are in range.
#include <cstdlib>

#include "core/error.h"
#include "scene/formats/surface_file.h"

using namespace holomorph;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, size_t size) {
  try {
    const SurfaceFile file =
        surface_of_obj(std::string(reinterpret_cast<const char*>(data), size), "fuzzed");
    if (!file.texture.empty() && file.texture.size() != file.surface.vertices.size()) std::abort();
    const std::vector<int> boundary = disk_boundary(file.surface);
    for (const int v : boundary)
      if (v < 0 || v >= static_cast<int>(file.surface.vertices.size())) std::abort();
    Points texture(file.surface.vertices.size());
    if (surface_of_obj(obj_of(file.surface, texture, "m"), "again").surface.triangles !=
        file.surface.triangles)
      std::abort();
  } catch (const Error&) {
  }
  return 0;
}
