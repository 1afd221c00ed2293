#include "scene/formats/moving_mesh.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace holomorph {

bool moves(const MovingMesh& mesh) {
  return std::ranges::any_of(mesh.frames,
                             [&](const Points& frame) { return frame != mesh.frames[0]; });
}

Complex texture_coordinate(const MovingMesh& mesh, Complex rest) {
  return {(rest.real() - mesh.texture.left) / std::max(1, mesh.texture.width),
          (rest.imag() - mesh.texture.bottom) / std::max(1, mesh.texture.height)};
}

std::vector<std::string> unique_names(const MovingMeshes& moving) {
  std::vector<std::string> names;
  std::set<std::string> used;
  for (const MovingMesh& mesh : moving.meshes) {
    std::string name;
    for (const char c : mesh.name) {
      const bool is_plain =
          c < 0 || std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == ' ';
      name += is_plain ? c : '_';
    }
    if (name.empty()) name = "layer";
    std::string unique = name;
    for (int k = 2; !used.insert(unique).second; ++k) unique = name + "-" + std::to_string(k);
    names.push_back(unique);
  }
  return names;
}

}  // namespace holomorph
