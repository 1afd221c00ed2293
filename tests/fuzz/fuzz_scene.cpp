// Reads any bytes as a scene: an Error, or a scene that survives writing and reading.
#include "core/error.h"
#include "scene/formats/scene_json.h"

using namespace holomorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  try {
    const Scene scene =
        scene_from_json(std::string(reinterpret_cast<const char*>(data), size), "fuzz");
    check(scene_from_json(json_of(scene), "again") == scene,
          "a scene survives writing and reading");
  } catch (const Error&) {
  }
  return 0;
}
