#include "scene/solving_mesh.h"

#include <algorithm>

#include "core/mesh/mesher.h"
#include "core/mesh/split_chords.h"
#include "core/sheet/half_width.h"

namespace holomorph {

Mesh solving_mesh(const Cage& cage) {
  constexpr int kMeasured = 1000, kMost = 2500;  // vertices
  // Far enough that the corner of a square counts as wide.
  constexpr double kReach = 1.5, kPart = 0.4;
  constexpr double kShortest = 0.005, kLongest = 0.03;  // in units of the size
  const Mesh measured = domain_mesh(cage, {kMeasured});
  const double size = box_of(measured.vertices).diagonal();
  const HalfWidth width(measured);
  const auto length_at = [&](Complex z) {
    return std::clamp(kPart * width.at(z, kReach), kShortest * size, kLongest * size);
  };
  return with_split_chords(graded_mesh(cage, length_at, kMost));
}

}  // namespace holomorph
