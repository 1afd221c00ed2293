// Reads arbitrary bytes as an SVG file. The result must be an Error or a loop; a rest cage must be
// unchanged after it is written and read back.
#include "core/error.h"
#include "scene/formats/scene_json.h"
#include "scene/formats/svg_path.h"

using namespace holomorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const PathUse use : {PathUse::rest, PathUse::pose, PathUse::outline}) try {
      const Cage cage = cage_of_svg(text, "fuzz", 100, use);
      check(cage.size() <= 5000, "a loop has no more segments than a scene may have");
      if (use != PathUse::rest) continue;
      check_rest_cage(cage);
      const Deformation deformation = with_cage({}, cage);
      check(scene_from_json(json_of(scene_of(deformation)), "again").deformation().rest == cage,
            "a cage survives writing");
      cage_of_svg(svg_of(deformation, {}), "again", 100, use);
    } catch (const Error&) {
    }
  return 0;
}
