// Distances along the edges of a mesh.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

class EdgeDistances {
 public:
  /// Keeps a copy of the mesh's edges, with their lengths.
  explicit EdgeDistances(const Mesh& mesh);

  /// A vertex from which paths start, and the length that they have there already.
  struct Source {
    int vertex = 0;
    double distance = 0;
  };
  /// For each vertex, the length of the shortest path that reaches it and the index of the source
  /// where that path starts. Infinite and -1 where no path leads.
  struct Reach {
    std::vector<double> distance;
    std::vector<int> source;
  };
  /// Shortest paths from several sources together (Dijkstra). Cost: O(n log n) in the number of
  /// vertices.
  Reach from(std::span<const Source> sources) const;

 private:
  std::vector<std::vector<std::pair<int, double>>> edges_;
};

}  // namespace holomorph
