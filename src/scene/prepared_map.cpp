// Where possible, the mesh and the method's precomputation are reused from the last preparation.
#include "scene/prepared_map.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "core/mesh/subdivided.h"
#include "scene/budget.h"
#include "scene/solving_mesh.h"

namespace holomorph {
namespace {

/// The number of control points. Control points of curves count twice, because their coordinates
/// take much longer to compute.
double cost_of(const Cage& cage) {
  double cost = 0;
  for (Index i = 0; i < cage.size(); ++i) cost += cage.degree(i) > 1 ? 2.0 * cage.degree(i) : 1.0;
  return cost;
}

/// Checks the budget before the coordinates are computed.
void check_coordinates(const Rest& rest, Index places) {
  check_budget(&Budget::coordinates, cost_of(rest.cage) * static_cast<double>(places),
               "the cage with " + std::to_string(rest.cage.control_count()) +
                   " control points and its mesh with " + std::to_string(places) +
                   " vertices need");
}

/// Whether two cages describe the same curve, regardless of the degrees of straight segments.
bool is_same_curve(const Cage& a, const Cage& b) {
  return a == b || (a.starts == b.starts && vertices_of(a) == vertices_of(b) && is_straight(a) &&
                    is_straight(b));
}

bool differ(const std::vector<Depth>& depths) {
  return std::ranges::any_of(depths, [&](const Depth& d) { return d.depth != depths[0].depth; });
}

/// A solving mesh, subdivided until it has at least half of options.vertices. In a small piece of
/// its triangles, a map without folds is nearly linear, so drawn triangles hardly ever flip.
std::shared_ptr<const Mesh> subdivided_for(const std::shared_ptr<const Mesh>& mesh,
                                           const MeshOptions& options) {
  const double finer = options.vertices / static_cast<double>(mesh->vertices.size());
  const int pieces = static_cast<int>(std::ceil(std::sqrt(finer) - 0.3));
  return pieces <= 1 ? mesh : std::make_shared<const Mesh>(subdivided(*mesh, pieces));
}

}  // namespace

void check_affordable(std::span<const Layer> layers) {
  const double vertices = MeshOptions{}.vertices;
  double controls = 0, keys = 0;
  for (const Layer& layer : layers) {
    const Deformation& deformation = layer.deformation;
    controls += cost_of(deformation.rest);
    keys += deformation.has_cage() ? static_cast<double>(deformation.keyframes.size()) : 0;
  }
  check_budget(&Budget::coordinates, controls * vertices,
               "the cages with " + std::to_string(static_cast<long>(controls)) +
                   " control points and their meshes with about " +
                   std::to_string(static_cast<long>(vertices)) + " vertices need");
  check_budget(&Budget::operators, keys * vertices * sizeof(Complex),
               "the maps at " + std::to_string(static_cast<long>(keys)) + " keyframes need");
}

std::shared_ptr<const Inbetween> inbetween_of(PreparedMap& prepared) {
  std::shared_ptr<const Inbetween> between = prepared.between.load();
  if (between) return between;
  between = std::make_shared<const Inbetween>(prepared.mesh);
  prepared.between.store(between);
  return between;
}

std::vector<Depth> depths_of(const Deformation& deformation) {
  std::vector<Depth> depths;
  if (!method_named(deformation.method).uses_pins) return depths;
  for (const Pin& pin : deformation.pins) depths.push_back({pin.rest, pin.depth});
  if (!differ(depths)) depths.clear();
  return depths;
}

std::shared_ptr<const Mesh> drawn_mesh(std::shared_ptr<const Mesh> mesh,
                                       const Deformation& deformation) {
  const EqualHeights equals = method_named(deformation.method).limbs_in_front
                                  ? EqualHeights::outward
                                  : EqualHeights::as_in_mesh;
  const std::vector<Depth> depths = depths_of(deformation);
  if (depths.empty() && equals == EqualHeights::as_in_mesh) return mesh;
  auto drawn = std::make_shared<Mesh>(*mesh);
  drawn->triangles = draw_order(*mesh, depths, equals);
  return drawn;
}

bool same_rest(const Deformation& a, const Deformation& b) {
  if (a.method != b.method || a.has_cage() != b.has_cage()) return false;
  return !a.has_cage() || rest_of(a, Precision::single) == rest_of(b, Precision::single);
}

std::unique_ptr<PreparedMap> prepared_map(const Deformation& deformation, Precision precision,
                                          const MeshOptions& options, const PreparedMap* previous) {
  const double start = now_ms();
  auto prepared = std::make_unique<PreparedMap>();
  prepared->rest = rest_of(deformation, precision);
  prepared->method = deformation.method;
  const bool smooths = method_named(deformation.method).smooths_mesh;
  const bool same_mesh = previous && previous->mesh &&
                         is_same_curve(previous->rest.cage, prepared->rest.cage) &&
                         method_named(previous->method).smooths_mesh == smooths;
  check_coordinates(prepared->rest, options.vertices);
  if (same_mesh) {
    prepared->mesh = previous->mesh;
    prepared->rest.mesh = previous->rest.mesh;
  } else if (smooths) {
    prepared->rest.mesh = std::make_shared<const Mesh>(solving_mesh(deformation.rest));
    prepared->mesh = subdivided_for(prepared->rest.mesh, options);
  } else {
    prepared->mesh = std::make_shared<const Mesh>(domain_mesh(deformation.rest, options));
    prepared->rest.mesh = prepared->mesh;
  }
  check_coordinates(prepared->rest, static_cast<Index>(prepared->mesh->vertices.size()));
  prepared->rest.samples = prepared->mesh->vertices;
  if (smooths) prepared->rest.drawn = prepared->mesh;
  if (same_mesh) prepared->between.store(previous->between.load());
  prepared->rest.derivative_samples =
      same_mesh ? previous->rest.derivative_samples : derivative_samples(*prepared->mesh);
  const bool same_method = previous && previous->method == deformation.method;
  prepared->deformer =
      method_named(deformation.method)
          .prepare(prepared->rest, same_method ? previous->deformer.get() : nullptr);
  for (const RestPin& pin : prepared->rest.pins)
    prepared->pins.push_back(locate(*prepared->mesh, prepared->mesh->vertices, pin.position));
  prepared->milliseconds = now_ms() - start;
  return prepared;
}

}  // namespace holomorph
