// A few vertices of a mesh that stand for its area.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

struct AreaSample {
  int vertex;
  double area;
};

/// About `count` of the mesh's vertices, spread over the mesh, and the vertices nearest to the
/// `wanted` points. The area of the vertices that are left out is added to the next sample, so the
/// areas add up to the area of the mesh. Cost: linear, plus vertices times wanted points.
std::vector<AreaSample> area_samples(const Mesh& mesh, size_t count, const Points& wanted = {});

}  // namespace holomorph
