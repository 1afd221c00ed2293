// A disk with h holes has one component, h + 1 boundary loops and V - E + F = 1 - h.
#include "core/mesh/surface.h"

#include <map>

#include "core/error.h"

namespace holomorph {
namespace {

using VertexPair = std::pair<int, int>;

/// The vertex that represents the component of i.
int root(std::vector<int>& parent, int i) {
  while (parent[static_cast<size_t>(i)] != i)
    i = parent[static_cast<size_t>(i)] =
        parent[static_cast<size_t>(parent[static_cast<size_t>(i)])];
  return i;
}

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
  throw Error(ErrorKind::bad_input, what + " is not a disk: " + why +
                                        "; it must be a single piece with a single boundary");
}

}  // namespace

std::vector<int> disk_boundary(const Surface& surface) {
  const auto loops =
      boundary_loops(static_cast<int>(surface.vertices.size()), surface.triangles, "the surface");
  if (loops.size() > 1) refuse("the surface", "it has a hole");
  return loops[0];
}

std::vector<std::vector<int>> boundary_loops(int count,
                                             std::span<const std::array<int, 3>> triangles,
                                             const std::string& what, int parts) {
  const auto refuse = [&what](const std::string& why) { holomorph::refuse(what, why); };
  if (triangles.empty()) refuse("it has no triangles");
  std::map<VertexPair, int> directed;
  std::vector<int> parent(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) parent[static_cast<size_t>(i)] = i;
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[static_cast<size_t>(k)], b = t[static_cast<size_t>((k + 1) % 3)];
      if (a < 0 || a >= count) refuse("a triangle refers to a vertex that does not exist");
      if (a == b) refuse("a triangle has the same vertex twice");
      if (++directed[{a, b}] > 1)
        refuse("an edge has more than two triangles, or two of opposite orientation");
      parent[static_cast<size_t>(root(parent, a))] = root(parent, b);
    }
  int found = 0;
  for (int i = 0; i < count; ++i) found += root(parent, i) == i;
  if (found != parts)
    refuse(parts == 1 ? "it has several parts"
                      : "its number of parts is " + std::to_string(found) + " instead of " +
                            std::to_string(parts));
  std::map<int, int> next;  // along the boundary
  size_t edges = 0;
  for (const auto& [edge, times] : directed) {
    const bool inner = directed.contains({edge.second, edge.first});
    if (!inner || edge.first < edge.second) ++edges;
    if (!inner && !next.emplace(edge).second) refuse("its boundary touches itself at a vertex");
  }
  if (next.empty()) refuse("it is closed");
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int>& loop = loops.emplace_back();
    for (int at = next.begin()->first; loop.empty() || at != loop.front(); at = next.at(at))
      loop.push_back(at);
    for (const int at : loop) next.erase(at);
  }
  const long euler = count - static_cast<long>(edges) + static_cast<long>(triangles.size());
  if (euler != 2 * parts - static_cast<long>(loops.size())) refuse("it has a handle");
  return loops;
}

}  // namespace holomorph
