// Pins are picked before points, and points before strokes.
#include "edit/picking.h"

#include <algorithm>

#include "core/cauchy/cauchy.h"
#include "core/geometry/polyline.h"

namespace holomorph {

namespace {

std::span<const Complex> shown_positions(const Workspace& workspace) {
  const LiveMap& map = workspace.map();
  return workspace.at_rest() ? std::span<const Complex>(map.drawn()->vertices)
                             : as_span(map.map().f);
}

/// The picture lies at rest while the first map of a scene without a pose is prepared.
std::optional<Complex> rest_without_map(const Deformation& deformation, Complex z) {
  const bool still = deformation.has_cage() && at_rest(deformation) == deformation;
  return still && contains(deformation.rest, z) ? std::optional(z) : std::nullopt;
}

}  // namespace

std::optional<Complex> rest_at(const Workspace& workspace, Complex z) {
  if (!workspace.map().has_map()) return rest_without_map(workspace.shown.deformation(), z);
  const Mesh& mesh = *workspace.map().drawn();
  const auto found = locate(mesh, shown_positions(workspace), z);
  if (!found) return {};
  return found->in(mesh, mesh.vertices);
}

std::optional<Complex> rest_in_layer(const Workspace& workspace, size_t layer, Complex px) {
  const Scene& scene = workspace.document.scene();
  const Deformation& deformation =
      layer == scene.edited ? workspace.shown.deformation() : scene.layers[layer]->deformation;
  const Complex z = workspace.layer_view(layer).plane_at_px(px);
  if (!deformation.has_cage()) return z;
  const LiveMap& map = workspace.maps.of(scene.layers[layer]->id);
  if (map.has_map()) {
    const Mesh& mesh = *map.drawn();
    if (const auto found = locate(mesh, as_span(map.map().f), z))
      return found->in(mesh, mesh.vertices);
  }
  return encloses(outline_of(deformation.rest), z) ? std::nullopt : std::optional(z);
}

bool is_visible_at(const Image& picture, Complex rest) {
  constexpr int kLeastAlpha = 13;  // 5 % of 255
  const int column = static_cast<int>(std::floor(rest.real())) - picture.left,
            row = picture.top() - 1 - static_cast<int>(std::floor(rest.imag()));
  return column >= 0 && row >= 0 && column < picture.width && row < picture.height &&
         picture.at(column, row)[3] >= kLeastAlpha;
}

bool is_in_hole(const Workspace& workspace, Complex z) {
  if (!workspace.map().has_map() || rest_at(workspace, z)) return false;
  const Mesh& mesh = *workspace.map().prepared()->mesh;
  const std::span<const Complex> positions = shown_positions(workspace);
  const Cage& rest = workspace.map().prepared()->rest.cage;
  const Loops loops = mesh.boundary_loops();
  for (Index l = 0; l < loops.count(); ++l) {
    if (rest.is_hole(l)) continue;
    Points outline;
    for (Index i = loops.first(l); i < loops.end(l); ++i)
      outline.push_back(positions[static_cast<size_t>(mesh.boundary[static_cast<size_t>(i)])]);
    if (encloses(outline, z)) return true;
  }
  return false;
}

Complex posed_at(const LiveMap& map, Complex rest) {
  if (!map.has_map()) return rest;
  const Mesh& mesh = *map.drawn();
  const VectorXc& f = map.map().f;
  const auto found = locate(mesh, mesh.vertices, rest);
  return found ? found->in(mesh, as_span(f)) : rest;
}

double rotation_at(const Workspace& workspace, Index pin) {
  const Deformation& deformation = workspace.shown.deformation();
  const Pin& own = deformation.pins[pin];
  if (own.angle) return *own.angle;
  const double before = own.turn.value_or(0);
  const auto turn = workspace.map().pin_turn(deformation, static_cast<size_t>(pin));
  if (!turn) return before;
  return workspace.map().map().turns.empty()
             ? *turn + 2 * kPi * std::round((before - *turn) / (2 * kPi))
             : *turn;
}

std::optional<CageHit> edge_at(const Workspace& workspace, Complex px) {
  constexpr double kAtVertex = 1e-3;
  if (!has_cage_handles(workspace.shown.deformation(), workspace.mode)) return {};
  const Viewport view = workspace.layer_view();
  const CageHit hit =
      nearest_on_cage(cage_of(workspace.shown.deformation(), workspace.mode), view.plane_at_px(px));
  if (hit.distance * view.zoom > workspace.display.handle_px || hit.t < kAtVertex ||
      hit.t > 1 - kAtVertex)
    return {};
  return hit;
}

bool insert_at(Workspace& workspace, const CageHit& hit) {
  if (!workspace.commit("Insert point",
                        inserted(workspace.shown.deformation(), hit.segment, hit.t)))
    return false;
  workspace.selection = {{Handle::Kind::cage, hit.segment + 1, 0}};
  return true;
}

std::optional<Handle> handle_at(const Workspace& workspace, Complex px) {
  std::optional<Handle> best;
  if (!workspace.display.show_cage || workspace.display.hide_overlays) return best;
  double distance = workspace.display.handle_px;
  const Viewport view = workspace.layer_view();
  const Deformation& deformation = workspace.shown.deformation();
  for (const Handle& handle : handles_of(deformation, workspace.mode)) {
    if (handle.kind == Handle::Kind::stroke) continue;
    const double here =
        std::abs(view.px_at_plane(position_of(deformation, handle, workspace.mode)) - px);
    // A pin at the same position as a cage point is drawn on top and picked first.
    if (here < distance || (here == distance && handle.kind == Handle::Kind::pin)) {
      best = handle;
      distance = here;
    }
  }
  if (best) return best;
  // Points are drawn on top of strokes and picked first.
  for (const Handle& handle : handles_of(deformation, workspace.mode)) {
    if (handle.kind != Handle::Kind::stroke) continue;
    const double here =
        view.zoom *
        Polyline(without_repeats(curve_of(deformation, handle.index, workspace.mode)), false)
            .nearest(view.plane_at_px(px))
            .distance;
    if (here >= distance) continue;
    best = handle;
    distance = here;
  }
  return best;
}

}  // namespace holomorph
