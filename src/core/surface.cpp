// A disk: one part, one boundary loop, V - E + F = 1.
#include "core/surface.h"

#include <map>

#include "core/error.h"

namespace holomorph {
namespace {

using Edge = std::pair<int, int>;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorKind::bad_input,
              "the surface is no disk: " + why + "; it must be one piece with one boundary");
}

/// The representative of i's part.
int root(std::vector<int>& parent, int i) {
  while (parent[static_cast<size_t>(i)] != i)
    i = parent[static_cast<size_t>(i)] =
        parent[static_cast<size_t>(parent[static_cast<size_t>(i)])];
  return i;
}

}  // namespace

std::string name_of(Flattening flattening) {
  return flattening == Flattening::circle ? "circle" : "lscm";
}

Flattening flattening_named(const std::string& name) {
  for (const Flattening flattening : {Flattening::lscm, Flattening::circle})
    if (name == name_of(flattening)) return flattening;
  throw Error(ErrorKind::bad_input,
              "flattening '" + name + "' does not exist; choose one of: lscm, circle");
}

std::vector<int> disk_boundary(const Surface& surface) {
  const int count = static_cast<int>(surface.vertices.size());
  if (surface.triangles.empty()) refuse("it has no triangles");
  std::map<Edge, int> directed;
  std::vector<int> parent(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) parent[static_cast<size_t>(i)] = i;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[static_cast<size_t>(k)], b = t[static_cast<size_t>((k + 1) % 3)];
      check(a >= 0 && a < count, "surface: a triangle's vertex exists");
      if (a == b) refuse("a triangle has the same vertex twice");
      if (++directed[{a, b}] > 1)
        refuse("an edge has more than two triangles, or two of opposite orientation");
      parent[static_cast<size_t>(root(parent, a))] = root(parent, b);
    }
  for (int i = 1; i < count; ++i)
    if (root(parent, i) != root(parent, 0)) refuse("it is in several parts");
  std::map<int, int> next;  // along the boundary
  size_t edges = 0;
  for (const auto& [edge, times] : directed) {
    const bool inner = directed.contains({edge.second, edge.first});
    if (!inner || edge.first < edge.second) ++edges;
    if (!inner && !next.emplace(edge).second) refuse("its boundary touches itself at a vertex");
  }
  if (next.empty()) refuse("it is closed");
  std::vector<int> loop;
  for (int at = next.begin()->first; loop.empty() || at != loop.front(); at = next.at(at))
    loop.push_back(at);
  if (loop.size() < next.size()) refuse("it has a hole");
  const long euler = static_cast<long>(surface.vertices.size()) - static_cast<long>(edges) +
                     static_cast<long>(surface.triangles.size());
  if (euler != 1) refuse("it has a handle");
  return loop;
}

}  // namespace holomorph
