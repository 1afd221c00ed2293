// What an elastic sheet's mesh determines, whatever its handles are.
#pragma once

#include "core/mesh/locator.h"
#include "core/sheet/half_width.h"
#include "core/sheet/vertex_gradients.h"

namespace holomorph {

struct SheetDomain {
  std::shared_ptr<const Mesh> mesh;
  /// The vertices of a frame, whose sides are images of themselves; empty: none.
  std::vector<char> framed;
  MeshLocator locator;
  HalfWidth width;
  VertexGradients gradients;
  double size;  ///< the diagonal of the bounding box

  SheetDomain(std::shared_ptr<const Mesh> shared, std::vector<char> frame)
      : mesh(std::move(shared)),
        framed(std::move(frame)),
        locator(*mesh),
        width(*mesh),
        gradients(*mesh, framed),
        size(box_of(mesh->vertices).diagonal()) {}
};

}  // namespace holomorph
