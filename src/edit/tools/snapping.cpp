// The two coordinates snap independently: a handle can line up with one thing along x and another
// along y.
#include "edit/tools/snapping.h"

namespace holomorph {

Complex snapped(const Deformation& deformation, const Selection& dragged, Handle pressed,
                Complex by, EditMode mode, const Snapping& snapping, std::vector<Guide>& guides) {
  Points candidates{position_of(deformation, pressed, EditMode::rest)};
  for (const Handle& handle : handles_of(deformation, mode))
    if (!dragged.contains(handle) && handle.control == 0)
      candidates.push_back(position_of(deformation, handle, mode));
  if (snapping.picture) {
    const Box& box = *snapping.picture;
    candidates.insert(candidates.end(),
                      {{box.left, box.bottom}, {box.right, box.top}, box.center()});
  }
  const Complex start = position_of(deformation, pressed, mode), free = start + by;
  const auto nearest = [&](auto coordinate) {
    const Complex* found = nullptr;
    double least = snapping.distance;
    for (const Complex& z : candidates) {
      const double off = std::abs(coordinate(z) - coordinate(free));
      if (off >= least) continue;
      found = &z;
      least = off;
    }
    return found;
  };
  const Complex* column = nearest([](Complex z) { return z.real(); });
  const Complex* row = nearest([](Complex z) { return z.imag(); });
  const Complex at(column ? column->real() : free.real(), row ? row->imag() : free.imag());
  if (column) guides.push_back({*column, at});
  if (row) guides.push_back({*row, at});
  return at - start;
}

}  // namespace holomorph
