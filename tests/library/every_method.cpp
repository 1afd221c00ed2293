// Runs every method of the installed library on triangles from the mesher and on triangles that it
// builds itself. Each method must give the identity at rest, and follow a translation of all
// handles.
#include <holomorph/deformer.h>
#include <holomorph/flatten.h>
#include <holomorph/mesher.h>
#include <holomorph/method.h>

#include <algorithm>
#include <cstdio>

namespace {

using namespace holomorph;

/// A fan around the cage's center, with subdivided edges: triangles that a caller without a mesher
/// might use.
Mesh fan(const Cage& cage) {
  constexpr int kCuts = 4;
  const Points corners = vertices_of(cage);
  Points vertices;
  for (size_t i = 0; i < corners.size(); ++i)
    for (int k = 0; k < kCuts; ++k)
      vertices.push_back(corners[i] + (corners[(i + 1) % corners.size()] - corners[i]) *
                                          (static_cast<double>(k) / kCuts));
  const int rim = static_cast<int>(vertices.size());
  vertices.push_back(box_of(corners).center());
  std::vector<Triangle> triangles;
  for (int i = 0; i < rim; ++i)
    triangles.push_back({rim, (i + 1) % rim, i});  // clockwise; mesh_of reverses them
  return mesh_of(cage, vertices, triangles);
}

Rest rest_with(Mesh mesh, const Cage& cage) {
  Rest rest;
  rest.cage = cage;
  rest.pins = {{{120, 150}}, {{300, 160}}};
  rest.strokes = {{{100, 100}, {200, 110}, {300, 100}}};
  rest.outline = vertices_of(cage);
  rest.mesh = std::make_shared<const Mesh>(std::move(mesh));
  rest.samples = rest.mesh->vertices;
  rest.derivative_samples = derivative_samples(*rest.mesh);
  rest.precision = Precision::full;
  return rest;
}

Pose pose_of(const Rest& rest, Complex shift) {
  Pose pose{rest.cage, {}, rest.strokes, {}};
  for (Points& segment : pose.cage.segments)
    for (Complex& z : segment) z += shift;
  for (const RestPin& pin : rest.pins) pose.pins.push_back({pin.position + shift});
  for (Points& stroke : pose.strokes)
    for (Complex& z : stroke) z += shift;
  return pose;
}

/// The largest distance between the map and the translation.
double miss(const Method& method, const Rest& full, Complex shift) {
  const Rest rest = used_by(method, full);
  const auto deformer = method.prepare(rest, nullptr);
  SampledMap map = deformer->deform(used_by(method, pose_of(full, shift)), {.derivatives = true});
  double worst = 0;
  for (Index i = 0; i < map.f.size(); ++i)
    worst = std::max(worst, std::abs(map.f[i] - full.samples[static_cast<size_t>(i)] - shift));
  return std::isfinite(worst) && map.fz.size() == map.f.size() ? worst : 1e300;
}

}  // namespace

int main() {
  constexpr double kPixels =
      1.0;  // outlines are matched to a fraction of the cage's size, everything else exactly
  const Cage cage = polygon_cage(Points{{0, 0}, {400, 0}, {420, 280}, {180, 320}, {0, 300}});
  bool good = true;
  for (const Mesh& mesh : {domain_mesh(cage, {600}), fan(cage)})
    for (const Method& method : methods()) {
      const Rest rest = rest_with(mesh, cage);
      // The outline does not move: it has no pose.
      const Complex shift = method.uses_outline ? 0 : Complex(30, -20);
      const double still = miss(method, rest, 0), shifted = miss(method, rest, shift);
      const bool ok = std::max(still, shifted) < kPixels;
      good = good && ok;
      std::printf("%-12s %7zu triangles  %.1e  %.1e  %s\n", method.id.c_str(),
                  mesh.triangles.size(), still, shifted, ok ? "ok" : "WRONG");
    }
  const Surface square{{{0, 0, 1}, {1, 0, 1}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  good = good && flattened(square, Flattening::lscm).size() == 4;
  return good ? 0 : 1;
}
