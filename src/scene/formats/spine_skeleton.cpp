// The JSON format of skeletons of Spine 4.1.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "scene/formats/moving_mesh.h"

namespace holomorph {
namespace {

/// The vertices of the longest boundary loop in its order, and then all others: what Spine expects.
struct HullFirst {
  std::vector<int> order;  ///< old numbers
  std::vector<int> place;  ///< new numbers
  size_t hull = 0;
};
HullFirst hull_first(const MovingMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (const Triangle& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
  std::map<int, int> next;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) next[a] = b;
  HullFirst result;
  std::set<int> seen;
  std::vector<int> longest;
  for (const auto& [start, ignored] : next) {
    std::vector<int> loop;
    for (int v = start; next.contains(v) && seen.insert(v).second; v = next[v]) loop.push_back(v);
    if (loop.size() > longest.size()) longest = loop;
  }
  result.order = longest;
  result.hull = longest.size();
  const std::set<int> on_hull(longest.begin(), longest.end());
  for (int v = 0; v < static_cast<int>(mesh.rest.size()); ++v)
    if (!on_hull.contains(v)) result.order.push_back(v);
  result.place.resize(result.order.size());
  for (size_t i = 0; i < result.order.size(); ++i)
    result.place[static_cast<size_t>(result.order[i])] = static_cast<int>(i);
  return result;
}

}  // namespace

std::string spine_of(const MovingMeshes& moving, const std::vector<std::string>& textures) {
  using SpineJson = nlohmann::ordered_json;
  const std::vector<std::string> names = unique_names(moving);
  SpineJson slots = SpineJson::array(), attachments, deform;
  for (size_t i = 0; i < moving.meshes.size(); ++i) {
    const MovingMesh& mesh = moving.meshes[i];
    const HullFirst order = hull_first(mesh);
    const auto listed = [&](const auto& value) {
      std::vector<double> numbers;
      for (const int v : order.order) {
        const Complex z = value(static_cast<size_t>(v));
        numbers.insert(numbers.end(), {z.real(), z.imag()});
      }
      return numbers;
    };
    std::vector<int> triangles;
    for (const Triangle& t : mesh.triangles)
      for (const int v : t) triangles.push_back(order.place[static_cast<size_t>(v)]);
    SpineJson slot{{"name", names[i]}, {"bone", "root"}, {"attachment", names[i]}};
    if (mesh.opacity < 1) {
      char color[12];
      std::snprintf(color, sizeof color, "ffffff%02x",
                    static_cast<unsigned>(std::lround(255 * mesh.opacity)));
      slot["color"] = color;
    }
    slots.push_back(std::move(slot));
    attachments[names[i]][names[i]] = {
        {"type", "mesh"},
        {"path", textures[i].substr(0, textures[i].find_last_of('.'))},
        {"uvs", listed([&](size_t v) {
           const Complex uv = texture_coordinate(mesh, mesh.rest[v]);
           return Complex(uv.real(), 1 - uv.imag());
         })},
        {"triangles", triangles},
        {"vertices", listed([&](size_t v) { return mesh.frames[0][v]; })},
        {"hull", order.hull},
        {"width", mesh.texture.width},
        {"height", mesh.texture.height}};
    if (!moves(mesh)) continue;
    SpineJson keys = SpineJson::array();
    for (size_t k = 0; k < moving.times.size(); ++k)
      keys.push_back(
          {{"time", moving.times[k] - moving.times[0]},
           {"vertices", listed([&](size_t v) { return mesh.frames[k][v] - mesh.frames[0][v]; })}});
    deform[names[i]][names[i]]["deform"] = std::move(keys);
  }
  SpineJson document{
      {"skeleton", {{"spine", "4.1.00"}, {"images", "./"}}},
      {"bones", SpineJson::array({{{"name", "root"}}})},
      {"slots", std::move(slots)},
      {"skins",
       SpineJson::array({{{"name", "default"}, {"attachments", std::move(attachments)}}})}};
  if (!deform.empty())
    document["animations"]["motion"]["attachments"]["default"] = std::move(deform);
  return document.dump(-1, ' ', false, SpineJson::error_handler_t::replace) + "\n";
}

}  // namespace holomorph
