// Breadth-first order keeps the paths short and away from the boundary, where derivatives change
// fastest. Both keep the accumulated errors small.
#include "core/mesh/antiderivative.h"

#include <algorithm>
#include <utility>

#include "core/arithmetic.h"
#include "core/error.h"

namespace holomorph {

MeshTree::MeshTree(const Mesh& mesh, std::optional<int> root) : mesh_(mesh) {
  const int count = static_cast<int>(mesh.vertices.size());
  check(count > 0, "mesh tree: the mesh has vertices");
  const Complex center = box_of(mesh.vertices).center();
  root_ = root ? *root
               : static_cast<int>(
                     std::ranges::min_element(mesh.vertices, {},
                                              [&](Complex z) { return std::norm(z - center); }) -
                     mesh.vertices.begin());
  std::vector<std::vector<int>> neighbors(static_cast<size_t>(count));
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      neighbors[static_cast<size_t>(t[k])].push_back(t[(k + 1) % 3]);
      neighbors[static_cast<size_t>(t[(k + 1) % 3])].push_back(t[k]);
    }
  const std::vector<char> outer = boundary_marks(mesh);
  std::vector<char> reached(static_cast<size_t>(count), 0);
  // Paths pass through boundary vertices only if necessary.
  std::vector<int> queue{root_}, last;
  reached[static_cast<size_t>(root_)] = 1;
  for (size_t at = 0, end = 0; at < queue.size() || end < last.size();) {
    const int from = at < queue.size() ? queue[at++] : last[end++];
    for (const int next : neighbors[static_cast<size_t>(from)])
      if (!std::exchange(reached[static_cast<size_t>(next)], 1)) {
        edges_.push_back({from, next});
        (outer[static_cast<size_t>(next)] ? last : queue).push_back(next);
      }
  }
}

VectorXd MeshTree::argument(Complex center) const {
  VectorXd argument = VectorXd::Zero(static_cast<Index>(mesh_.vertices.size()));
  for (const auto [a, b] : edges_) {
    const Complex from = mesh_.vertices[static_cast<size_t>(a)] - center,
                  to = mesh_.vertices[static_cast<size_t>(b)] - center;
    argument[b] = argument[a] + std::atan2(cross(from, to), dot(from, to));
  }
  return argument;
}

VectorXc MeshTree::antiderivative(const VectorXc& derivative, const VectorXc& second) const {
  VectorXc f = VectorXc::Zero(derivative.size());
  for (const auto [a, b] : edges_) {
    const Complex h =
        mesh_.vertices[static_cast<size_t>(b)] - mesh_.vertices[static_cast<size_t>(a)];
    f[b] = f[a] +
           times(h, 0.5 * (derivative[a] + derivative[b]) + times(h, second[a] - second[b]) / 12.0);
  }
  return f;
}

}  // namespace holomorph
