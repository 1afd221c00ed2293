// Reads any bytes as a material library and as a table of points.
#include "core/error.h"
#include "scene/formats/export.h"
#include "scene/formats/surface_file.h"

using namespace holomorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::string texture = texture_of_materials(text);
  check(texture.find('\n') == std::string::npos, "a picture's name is one line");
  for (const bool takes_nan : {false, true}) try {
      for (const Complex& z : points_of_csv(text, "fuzz", takes_nan))
        check(takes_nan || is_finite(z), "points are finite");
    } catch (const Error&) {
    }
  return 0;
}
