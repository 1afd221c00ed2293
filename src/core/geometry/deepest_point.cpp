#include "core/geometry/deepest_point.h"

#include <algorithm>

#include "core/arithmetic.h"
#include "core/error.h"
#include "core/geometry/polygon.h"

namespace holomorph {
namespace {

/// The interior point that maximizes a function of the point and its distance from the outline.
/// Searches successively finer grids.
template <class Merit>
Complex best_inside(const Polyline& outline, const Merit& merit) {
  const Box box = box_of(outline.points());
  const Complex corner(box.left, box.bottom), size(box.width(), box.height());
  constexpr int kFirstCells = 24, kCells = 12;
  Complex best;
  double most = -1;
  for (double reach = 1; reach > 1e-13; reach /= kCells / 4.0) {
    const int cells = reach == 1 ? kFirstCells : kCells;
    const Complex from = most < 0 ? corner : best - 0.5 * reach * size, step = reach / cells * size;
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) {
        const Complex z = from + Complex((i + 0.5) * step.real(), (j + 0.5) * step.imag());
        const double here = merit(z, outline.nearest(z).distance);
        if (here > most && winding_number(outline.points(), z) != 0) most = here, best = z;
      }
  }
  if (most < 0) throw Error(ErrorKind::bad_input, "the outline encloses no area");
  return best;
}

/// The centroid of a polygon's area.
Complex centroid(const Points& polygon) {
  Complex sum = 0;
  double area = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Complex a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    sum += cross(a, b) * (a + b) / 3.0;
    area += cross(a, b);
  }
  return polygon[0] + sum / area;
}

}  // namespace

Complex middle_point(const Polyline& outline) {
  constexpr double kCentral = 0.2;
  const Complex center = centroid(outline.points());
  return best_inside(outline, [&](Complex z, double depth) {
    return depth * std::max(1 - kCentral * std::abs(z - center) / outline.length(), 0.0);
  });
}

Complex deepest_point(const Polyline& outline) {
  return best_inside(outline, [](Complex, double depth) { return depth; });
}

}  // namespace holomorph
