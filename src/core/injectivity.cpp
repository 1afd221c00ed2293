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

/// |f_z| - |f_zbar| of the linear map of a triangle, z being its place at rest.
double stretch(Complex z1, Complex z2, Complex f1, Complex f2) {
  const Complex twice_area = z1 * std::conj(z2) - z2 * std::conj(z1);
  const Complex fz = (f1 * std::conj(z2) - f2 * std::conj(z1)) / twice_area,
                fzbar = (z1 * f2 - z2 * f1) / twice_area;
  return std::abs(fz) - std::abs(fzbar);
}

struct Place {
  double stretch = std::numeric_limits<double>::infinity();
  Complex at;  ///< posed
};

Place most_shrunken(const Mesh& mesh, const VectorXc& f) {
  Place least;
  const Points& z = mesh.vertices;
  for (const auto& [i, j, k] : mesh.triangles) {
    const double here = stretch(z[j] - z[i], z[k] - z[i], f[j] - f[i], f[k] - f[i]);
    if (here < least.stretch) least = {here, (f[i] + f[j] + f[k]) / 3.0};
  }
  return least;
}

}  // namespace

Injectivity injectivity_of(const Mesh& mesh, const VectorXc& f) {
  Injectivity found;
  found.fold = visible_fold(mesh, f);
  Points image;
  for (const int v : mesh.boundary) image.push_back(f[v]);
  if (image.empty()) return found;
  found.boundary_turns = turning_number(image);
  const Place least = most_shrunken(mesh, f);
  found.least_stretch = least.stretch;
  if (!found.fold && found.folds()) found.fold = least.at;
  if (const auto crossing = self_crossing(image)) found.crossing = crossing->point;
  return found;
}

}  // namespace holomorph
