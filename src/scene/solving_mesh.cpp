#include "scene/solving_mesh.h"

#include <algorithm>

#include "core/mesh/mesher.h"
#include "core/mesh/split_chords.h"
#include "core/sheet/half_width.h"

namespace holomorph {

namespace {

/// The mesh of a cage with one part.
Mesh mesh_of_part(const Cage& cage, int most) {
  constexpr int kMeasured = 1000;  // vertices
  // Far enough that the corner of a square counts as wide.
  constexpr double kReach = 1.5, kPart = 0.4;
  constexpr double kShortest = 0.005, kLongest = 0.03;  // in units of the size
  const Mesh measured = domain_mesh(cage, {kMeasured});
  const double size = box_of(measured.vertices).diagonal();
  const HalfWidth width(measured);
  const auto length_at = [&](Complex z) {
    return std::clamp(kPart * width.at(z, kReach), kShortest * size, kLongest * size);
  };
  return with_split_chords(graded_mesh(cage, length_at, most));
}

}  // namespace

Mesh solving_mesh(const Cage& cage) {
  constexpr int kMost = 2500;  // vertices
  if (cage.parts.empty()) return mesh_of_part(cage, kMost);
  constexpr double kLeast = 0.1;  // of kMost
  std::vector<Cage> parts;
  std::vector<double> sizes;
  for (Index p = 0; p < cage.part_count(); ++p) {
    parts.push_back(part_of(cage, p));
    sizes.push_back(box_of(outline_of(parts.back()).points).diagonal());
  }
  const double largest = std::ranges::max(sizes);
  std::vector<Mesh> meshes;
  for (size_t p = 0; p < parts.size(); ++p)
    meshes.push_back(
        mesh_of_part(parts[p], static_cast<int>(kMost * std::max(kLeast, sizes[p] / largest))));
  return joined(meshes);
}

}  // namespace holomorph
