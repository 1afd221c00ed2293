// Next to corners of a basis on the boundary, where derivatives have poles, a few specks always
// turn; they are no fold.
#include "core/injectivity.h"

#include <limits>

namespace holomorph {
namespace {

std::optional<Complex> visible_fold(const Mesh& mesh, const VectorXc& f) {
  constexpr double kVisible = 1e-4;
  double turned = 0, total = 0, largest = 0;
  Complex place;
  for (const auto& [i, j, k] : mesh.triangles) {
    const double twice = cross(f[j] - f[i], f[k] - f[i]);
    total += std::abs(twice);
    if (twice >= 0) continue;
    turned -= twice;
    if (-twice > largest) largest = -twice, place = (f[i] + f[j] + f[k]) / 3.0;
  }
  return turned > kVisible * total ? std::optional(place) : std::nullopt;
}

Complex smallest_place(const Mesh& mesh, const VectorXc& f) {
  double least = std::numeric_limits<double>::infinity();
  Complex place;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Points& z = mesh.vertices;
    const double area = std::abs(cross(f[j] - f[i], f[k] - f[i])) / cross(z[j] - z[i], z[k] - z[i]);
    if (area < least) least = area, place = (f[i] + f[j] + f[k]) / 3.0;
  }
  return place;
}

}  // namespace

Injectivity injectivity_of(const Mesh& mesh, const VectorXc& f) {
  Injectivity found;
  found.fold = visible_fold(mesh, f);
  Points image;
  for (const int v : mesh.boundary) image.push_back(f[v]);
  if (image.empty()) return found;
  found.boundary_turns = turning_number(image);
  if (!found.fold && found.folds()) found.fold = smallest_place(mesh, f);
  if (const auto crossing = self_crossing(image)) found.crossing = crossing->point;
  return found;
}

}  // namespace holomorph
