// Reads arbitrary bytes as an SVG file. The result must be an Error or a loop; a rest cage must be
// unchanged after it is written and read back. As a drawing, it is bent; what is written must be
// XML, have only finite numbers and contain no scripts.
#include "core/error.h"
#include "scene/formats/bent_drawing.h"
#include "scene/formats/scene_json.h"
#include "scene/formats/svg_path.h"
#include "scene/formats/svg_styles.h"

using namespace holomorph;

namespace {

std::vector<PointMap::Value> bent(std::span<const Complex> points) {
  std::vector<PointMap::Value> values;
  for (const Complex& z : points) {
    const Complex turn = std::polar(1.0, 0.001 * z.real());
    values.push_back({z * turn, turn * (1.0 + 0.0005 * kI * z), turn * 0.0005 * kI * z});
  }
  return values;
}

void check_written(const pugi::xml_node& node) {
  const std::string kind = local_name(node);
  check(kind != "script" && kind != "set" && kind != "foreignObject", "nothing can run");
  const std::string path = node.attribute("d").as_string(),
                    transform = node.attribute("transform").as_string();
  for (const char* word : {"nan", "inf"})
    check((path + transform).find(word) == std::string::npos, "all numbers are finite");
  for (const pugi::xml_node& child : node.children()) check_written(child);
}

}  // namespace

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
  try {
    const BentDrawing drawing = bent_drawing(text, "fuzz", bent, {.prefix = "a-"});
    pugi::xml_document written;
    check(static_cast<bool>(written.load_string(drawing.group.c_str())), "the result is XML");
    check_written(written);
  } catch (const Error&) {
  }
  return 0;
}
