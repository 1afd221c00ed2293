#include "scene/formats/moving_mesh.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "system/text.h"

namespace holomorph {

namespace {

constexpr size_t kLongestName = 100;  // bytes; names of files have at most 255

/// The last characters of a text. The end of a layer's name tells more than the names of its
/// groups.
std::string end_of_text(const std::string& text, size_t most) {
  if (text.size() <= most) return text;
  size_t from = text.size() - most;
  while (from < text.size() && (static_cast<unsigned char>(text[from]) & 0xc0) == 0x80) ++from;
  return text.substr(from);
}

/// The same text for names that differ in case alone. It is also the same for other names with
/// letters beyond ASCII, whose case is not known here.
std::string without_case(const std::string& name) {
  std::string same = lower_case(name);
  for (char& c : same)
    if (c < 0) c = '?';
  return same;
}

}  // namespace

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
  // Some systems do not distinguish names by case. Scenes of Godot have a node for the animation.
  std::set<std::string> used{"animationplayer"};
  for (const MovingMesh& mesh : moving.meshes) {
    std::string name;
    for (const char c : mesh.name) {
      const bool is_plain =
          c < 0 || std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == ' ';
      name += is_plain ? c : '_';
    }
    if (name.empty()) name = "layer";
    name = end_of_text(name, kLongestName);
    std::string unique = name;
    for (int k = 2; !used.insert(without_case(unique)).second; ++k)
      unique = name + "-" + std::to_string(k);
    names.push_back(unique);
  }
  return names;
}

}  // namespace holomorph
