// Copying a mesh takes longer than comparing depths, so an unchanged order is reused.
#include "scene/posed_map.h"

#include "core/clock.h"

namespace holomorph {

PosedMap posed_map(const PreparedMap& prepared, const Deformation& deformation, EvalOptions options,
                   const PosedMap* before) {
  const double start = now_ms();
  const Solution* from = before ? before->map.solution.get() : nullptr;
  PosedMap posed =
      examined_map(prepared, deformation, options,
                   prepared.deformer->deform(pose_of(deformation), options, from), before);
  posed.milliseconds = now_ms() - start;
  return posed;
}

PosedMap examined_map(const PreparedMap& prepared, const Deformation& deformation,
                      EvalOptions options, SampledMap map, const PosedMap* before) {
  PosedMap posed;
  posed.deformation = deformation;
  posed.options = options;
  posed.options.stop = {};
  posed.map = std::move(map);
  posed.depths = depths_of(deformation);
  const bool same_order = before && before->drawn && before->depths == posed.depths &&
                          before->deformation && before->deformation->method == deformation.method;
  posed.drawn = same_order ? before->drawn : drawn_mesh(prepared.mesh, deformation);
  const Mesh& mesh = *prepared.mesh;
  posed.injectivity = injectivity_of(mesh, posed.map.f);
  for (const Complex& zero : posed.map.zeros)
    if (const auto at = locate(mesh, mesh.vertices, zero))
      posed.zero_images.push_back(at->in(mesh, as_span(posed.map.f)));
  return posed;
}

}  // namespace holomorph
